#pragma once
#include "avi/autodiff/program.hpp"
#include "avi/core/bracketed_root.hpp"
#include "src/autodiff/node_values.hpp"
#include "src/choice/candidates.hpp"
#include "src/core/lowest.hpp"
#include "src/features/kinks.hpp"
#include "src/features/separable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

/// @file
/// Features of H that a step may jump over: walls and narrow bumps thinner than the way between two stages.

namespace avi::detail {

/// The arguments of all functions in H that change only within a narrow range of their argument, such as exp,
/// tanh, cosh and erf, and what the conditions of its branches compare, if they are left out of Kinks. Along
/// the orbit, the arguments are smooth where the functions are not, so they show a peak or a passage through
/// zero that lies between two points.
class SharpFeatures {
 public:
  /// A function that tells whether, at a state inside the last step, something is felt that the energy of the
  /// step does not show.
  using Felt = std::function<bool(const State<dynamic>&)>;

  /// Takes H as a node of a graph. @param sketch of the beginning of the orbit @param timed whether the last
  /// coordinate is time; conditions on time alone are left out, as steps end at them, see Switches
  SharpFeatures(const ExpressionGraph& graph, int energy, const Sketch& sketch, bool timed = false)
      : n_(graph.inputs() / 2) {
    const std::vector<char> part = graph.parts(energy);
    const std::vector<unsigned char> on = dependences(graph, energy);
    const std::vector<char> singular = Kinks::singular(graph, part);
    std::vector<int> nodes;
    for (int i = 0; i <= energy; ++i) {
      using enum Operation;
      if (!part[i]) continue;
      const Operation what = graph[i].operation;
      const bool moves = (on[i] & (on_q | on_last)) != 0, known = timed && on[i] == on_last;
      const bool peak = what == exp, condition = what == less || what == less_equal,
                 passage = has(what, shapes::abrupt);
      kinks_ = kinks_ || (!known && (condition || has(what, shapes::kinked)));
      const bool quotient = what == divide && (on[graph[i].b] & (on_q | on_last)) != 0;
      hides_ =
          hides_ || quotient || (moves && (is_function(what) || what == power || condition || what == sign));
      if (!(peak || passage || (condition && !known && singular[i]))) continue;
      arguments_.push_back({peak ? Kind::peak : passage ? Kind::passage : Kind::condition, nodes.size()});
      nodes.push_back(graph[i].a);
      if (condition) nodes.push_back(graph[i].b);
    }
    if (none()) return;
    nodes_.emplace(graph, nodes);
    for (const Sketch::Sample& sample : sketch.samples) {
      nodes_->at(sample.z.data(), sample.z.data() + n_, n_);
      take_in();
    }
  }

  /// Returns true if H has no such function.
  [[nodiscard]] bool none() const { return arguments_.empty(); }
  /// Returns true if H has a kink or a branch, where errors of a step do not fall by its order.
  [[nodiscard]] bool has_kinks() const { return kinks_; }
  /// Returns true if H is no polynomial in q: then there may be a feature that is felt nowhere else.
  [[nodiscard]] bool hides() const { return hides_; }

  /// Returns true if a feature lies inside the last step of `method`, between points that do not show it. A
  /// feature of a condition has to be felt, too.
  bool jumped(OrbitSteps& method, const State<dynamic>& before, const State<dynamic>& after,
              const Felt& felt) {
    if (none()) return false;
    run(after);
    if (!take_in()) return false;
    for (int k = 0; k <= parts; ++k) {
      if (k == 0 || k == parts)
        run(k == 0 ? before : after);
      else
        run(method, static_cast<double>(k) / parts);
      for (std::size_t i = 0; i < arguments_.size(); ++i)
        arguments_[i].at[k] = value(i);
    }
    if (has_narrow_gap(method, felt)) return true;
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
      const Argument& argument = arguments_[i];
      if (!argument.moves()) continue;
      const std::array<double, parts + 1>& at = argument.at;
      if (argument.kind == Kind::condition) {
        if (flips(method, i, felt)) return true;
        continue;
      }
      const auto [least, most] = std::ranges::minmax_element(at);
      if (!(*most - *least > wide)) continue;
      if (argument.kind == Kind::peak) {
        const auto k = static_cast<int>(most - at.begin());
        // A peak may be felt from e^-40 on. A smooth maximum lies hardly further above three points than they
        // differ.
        const int first = std::clamp(k - 1, 0, parts - 2);
        const double low = std::min({at[first], at[first + 1], at[first + 2]});
        if (*most + 2.0 * (*most - low) < -40.0) continue;
        const double place = highest(method, i, 1.0, std::max(k - 1, 0) / static_cast<double>(parts),
                                     std::min(k + 1, parts) / static_cast<double>(parts));
        const double top = on(method, i, place);
        // Stages an eighth of a step away should see something of it.
        for (const double side : {std::max(place - 0.125, 0.0), std::min(place + 0.125, 1.0)})
          if (top > -40.0 && top - on(method, i, side) > 12.0) return true;
      } else {
        for (int k = 0; k < parts; ++k)  // a point may lie on the zero itself
          if (at[k] * at[k + 1] <= 0.0 && std::abs(at[k + 1] - at[k]) > 8.0) return true;
      }
    }
    return false;
  }

 private:
  static constexpr double wide = 30.0;  // a change of an argument that a step must not make unseen
  static constexpr int parts = 4;       // number of parts of a step, at whose ends arguments are evaluated
  enum class Kind { peak, passage, condition };
  struct Argument {
    Kind kind;
    std::size_t place;                        // of its node in the list, or of the first of two
    double low = infinity, high = -infinity;  // extremes on the sketch and after all steps so far
    std::array<double, parts + 1> at{};       // values in the current step

    // Whether it has moved so far that a step might hide a wide change.
    [[nodiscard]] bool moves() const {
      return kind == Kind::condition ? high > low : !(high - low <= wide / 3.0);
    }
  };

  void run(const State<dynamic>& z) { nodes_->at(z.q.data(), z.p.data(), n_); }
  /// Evaluates all arguments at a part of the last step.
  void run(OrbitSteps& method, double place) {
    double t = 0.0;
    inside_.resize(2 * n_);
    method.roughly(place, inside_, t);
    nodes_->at(inside_.data(), inside_.data() + n_, n_);
  }
  /// Value of argument i at the last point.
  [[nodiscard]] double value(std::size_t i) const {
    const Argument& argument = arguments_[i];
    const double first = (*nodes_)[argument.place];
    return argument.kind == Kind::condition ? first - (*nodes_)[argument.place + 1] : first;
  }
  /// Value of argument i at a part of the last step.
  double on(OrbitSteps& method, std::size_t i, double place) {
    run(method, place);
    return value(i);
  }
  /// Takes in the arguments at the last point. @return true if one of them moves
  bool take_in() {
    bool any = false;
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
      Argument& argument = arguments_[i];
      argument.low = std::min(argument.low, value(i)), argument.high = std::max(argument.high, value(i));
      any = any || argument.moves();
    }
    return any;
  }

  /// Returns true if something is felt between the zeros of two conditions, in a part of the step that stages
  /// may not see, as a push that begins with one of them and ends with the other.
  bool has_narrow_gap(OrbitSteps& method, const Felt& felt) {
    zeros_.clear();
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
      const Argument& argument = arguments_[i];
      if (argument.kind != Kind::condition || !argument.moves()) continue;
      for (int k = 0; k < parts; ++k)
        if (argument.at[k] * argument.at[k + 1] < 0.0) zeros_.push_back(zero(method, i, k));
    }
    std::ranges::sort(zeros_);
    for (std::size_t k = 1; k < zeros_.size(); ++k)
      if (zeros_[k] > zeros_[k - 1] && zeros_[k] < zeros_[k - 1] + 0.125 &&
          felt(method.polynomial(0.5 * (zeros_[k - 1] + zeros_[k]))))
        return true;
    return false;
  }
  /// The part of the step, between the points k and k + 1, at which condition i changes its sign.
  double zero(OrbitSteps& method, std::size_t i, int k) {
    const double sense = -std::copysign(1.0, arguments_[i].at[k]), width = 1.0 / parts;
    return bracketed_root([&](double place) { return sense * on(method, i, place); }, k * width,
                          sense * arguments_[i].at[k], (k + 1) * width, sense * arguments_[i].at[k + 1], 0.0)
        .x;
  }

  /// Returns true if a condition changes over a part of the step that stages may not see, and that is felt.
  bool flips(OrbitSteps& method, std::size_t i, const Felt& felt) {
    const Argument& argument = arguments_[i];
    double fastest = 0.0;  // largest change between two points: a value farther from zero does not get there
    for (int k = 0; k < parts; ++k)
      fastest = std::max(fastest, std::abs(argument.at[k + 1] - argument.at[k]));
    for (const double sense : {1.0, -1.0}) {
      // Look where it is furthest on one side of zero: an eighth of a step before and after, it has to be on
      // the other side.
      const auto most = std::ranges::max_element(argument.at, {}, [&](double x) { return sense * x; });
      const auto k = static_cast<int>(most - argument.at.begin());
      const int left = std::max(k - 1, 0), right = std::min(k + 1, parts);
      double place = k / static_cast<double>(parts);
      if (sense * *most > 0.0) {
        if ((left < k && sense * argument.at[left] > 0.0) || (right > k && sense * argument.at[right] > 0.0))
          continue;
      } else {
        if (-sense * *most > fastest) continue;
        place =
            highest(method, i, sense, left / static_cast<double>(parts), right / static_cast<double>(parts));
        if (!(sense * on(method, i, place) > 0.0)) continue;
      }
      const bool narrow = sense * on(method, i, std::max(place - 0.125, 0.0)) < 0.0 &&
                          sense * on(method, i, std::min(place + 0.125, 1.0)) < 0.0;
      if (narrow && felt(method.polynomial(place))) return true;
    }
    return false;
  }

  /// The place where an argument, times `sense`, is largest in a part of the step.
  double highest(OrbitSteps& method, std::size_t argument, double sense, double low, double high) {
    return lowest([&](double place) { return -sense * on(method, argument, place); }, low, high, false).x;
  }

  Eigen::Index n_;
  bool kinks_ = false, hides_ = false;
  std::vector<Argument> arguments_;
  std::vector<double> zeros_;          // zeros of conditions in the current step
  VectorX inside_;                     // scratch
  std::optional<NodeValues<>> nodes_;  // all arguments
};

}  // namespace avi::detail
