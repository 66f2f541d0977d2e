#pragma once
#include "avi/autodiff/program.hpp"
#include "avi/autodiff/schedule.hpp"
#include "candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

/// @file
/// Features of H that a step may jump over: walls and bells thinner than the way from stage to stage.

namespace avi::detail {

/// The arguments of all functions in H that change within a narrow range of their argument only: exp, tanh,
/// cosh, erf and the like. The arguments are smooth on the way where the functions are not, so that a peak or
/// a passage through zero between two points can be found from them.
class SharpFeatures {
 public:
  /// Takes H as a node of a graph. @param sketch of the orbit, where it begins
  SharpFeatures(const ExpressionGraph& graph, int energy, const Sketch& sketch) : n_(graph.inputs() / 2) {
    const std::vector<char> part = graph.parts(energy);
    std::vector<int> nodes;
    for (int i = 0; i <= energy; ++i) {
      using enum Operation;
      const Operation what = graph[i].operation;
      const bool peak = what == exp,
                 passage = what == tanh || what == cosh || what == sinh || what == erf || what == erfc;
      if (!part[static_cast<std::size_t>(i)] || !(peak || passage)) continue;
      arguments_.push_back({peak});
      nodes.push_back(graph[i].a);
    }
    if (none()) return;
    formula_.emplace(RecordedFormula<double>{Schedule::program(graph, -1, nodes, graph.size())});
    for (const Sketch::Sample& sample : sketch.samples) {
      formula_->run(sample.z.data(), sample.z.data() + n_, n_);
      take_in();
    }
  }

  /// H has no such function.
  [[nodiscard]] bool none() const { return arguments_.empty(); }

  /// Some feature lies inside the last step of `method`, between points that do not show it.
  bool jumped(const OrbitSteps& method, const State<dynamic>& before, const State<dynamic>& after) {
    if (none()) return false;
    run(after);
    if (!take_in()) return false;
    for (int k = 0; k <= parts; ++k) {
      run(k == 0 ? before : k == parts ? after : method.polynomial(static_cast<double>(k) / parts));
      for (std::size_t i = 0; i < arguments_.size(); ++i)
        arguments_[i].at[k] = value(i);
    }
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
      const Argument& argument = arguments_[i];
      if (!argument.moves()) continue;
      const std::array<double, parts + 1>& at = argument.at;
      const auto [least, most] = std::ranges::minmax_element(at);
      if (!(*most - *least > wide)) continue;
      if (argument.peak) {
        const auto k = static_cast<int>(most - at.begin());
        // From e^-40 on it may be felt. A smooth top lies hardly further above three points than they differ.
        const int first = std::clamp(k - 1, 0, parts - 2);
        const double low = std::min({at[first], at[first + 1], at[first + 2]});
        if (*most + 2.0 * (*most - low) < -40.0) continue;
        const double place = highest(method, i, std::max(k - 1, 0) / static_cast<double>(parts),
                                     std::min(k + 1, parts) / static_cast<double>(parts));
        const double top = on(method, i, place);
        // Stages an eighth of a step away would have to see something of it.
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
  static constexpr double wide = 30.0;  // a change of the argument that a step may not make unseen
  static constexpr int parts = 4;       // of a step, at whose ends arguments are looked at
  struct Argument {
    bool peak;
    double low = infinity, high = -infinity;  // on the sketch and after all steps
    std::array<double, parts + 1> at{};       // in the step under way

    // So far by so much that a step might hide a change that is wide.
    [[nodiscard]] bool moves() const { return !(high - low <= wide / 3.0); }
  };

  void run(const State<dynamic>& z) { formula_->run(z.q.data(), z.p.data(), n_); }
  /// Argument i, at the last point.
  [[nodiscard]] double value(std::size_t i) const { return formula_->partial(static_cast<int>(i)); }
  /// The same at a part of the last step.
  double on(const OrbitSteps& method, std::size_t i, double place) {
    run(method.polynomial(place));
    return value(i);
  }
  /// Takes in the arguments at the last point. @return one of them moves
  bool take_in() {
    bool any = false;
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
      Argument& argument = arguments_[i];
      argument.low = std::min(argument.low, value(i)), argument.high = std::max(argument.high, value(i));
      any = any || argument.moves();
    }
    return any;
  }

  /// Where it is largest in a part of the step, by golden section.
  double highest(const OrbitSteps& method, std::size_t argument, double low, double high) {
    constexpr double golden = 0.6180339887498949;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = on(method, argument, a), at_b = on(method, argument, b);
    for (int i = 0; i < 30; ++i) {
      if (at_a > at_b) {
        high = b, b = a, at_b = at_a;
        a = high - golden * (high - low);
        at_a = on(method, argument, a);
      } else {
        low = a, a = b, at_a = at_b;
        b = low + golden * (high - low);
        at_b = on(method, argument, b);
      }
    }
    return 0.5 * (low + high);
  }

  Eigen::Index n_;
  std::vector<Argument> arguments_;
  std::optional<RecordedFormula<double>> formula_;  // of all arguments, as derivatives of nothing
};

}  // namespace avi::detail
