#pragma once
#include "avi/autodiff/partials.hpp"
#include "avi/autodiff/program.hpp"
#include "avi/core/bracketed_root.hpp"
#include "src/autodiff/node_values.hpp"
#include "src/choice/candidates.hpp"
#include "src/features/poles.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

/// @file
/// Steps that pass a light body so closely that their stages miss its kick.

namespace avi::detail {

/// The poles that are not felt where an orbit begins, such as those of light bodies. Two runs whose stages
/// both miss the kick of such a pole agree, and are both wrong.
class NearPasses {
 public:
  /// The squares of the distances at an end of a step, and their derivatives by the part of the step.
  struct Distances {
    std::vector<double> square, rate;
  };

  /// Takes H as a node of a graph, which outlives it. @param sketch of the beginning of the orbit
  /// @param scale unit of energy @param frequency that of the motion, in radians @param kick the part of the
  /// momenta that is felt at the end of the run
  NearPasses(const ExpressionGraph& graph, int energy, const Sketch& sketch, double scale, double frequency,
             double kick)
      : graph_(&graph), energy_(energy), scale_(scale), frequency_(frequency), kick_(kick),
        poles_(graph, energy) {
    // With a heavier body, stages an eighth of a step away feel enough for two runs to differ.
    light_ = poles_.unfelt(sketch, 0.01 * scale);
    std::vector<int> nodes;
    for (const Poles::Light& each : light_)
      nodes.push_back(each.node);
    if (none()) return;
    moving_.emplace(graph, nodes);
    still_.emplace(graph, nodes);
  }

  /// Returns true if there is no such pole.
  [[nodiscard]] bool none() const { return light_.empty(); }
  /// Sets the distances at an end of a step of the fictive size h. @param slope dz/dt there
  void look(Candidate& candidate, double h, const State<dynamic>& z, const VectorX& slope, Distances& now) {
    const Eigen::Index n = z.q.size();
    along_.resize(static_cast<std::size_t>(2 * n));
    for (Eigen::Index i = 0; i < n; ++i) {
      along_[i] = Along::variable(z.q[i], 0, slope[i]);
      along_[n + i] = Along::variable(z.p[i], 0, slope[n + i]);
    }
    moving_->at(along_.data(), along_.data() + n, n);
    const double rate = candidate.fixed() ? h : h * candidate.rate_at(z);
    now.square.resize(light_.size()), now.rate.resize(light_.size());
    for (std::size_t k = 0; k < light_.size(); ++k) {
      const Along square = light_[k].square((*moving_)[k]);
      now.square[k] = square.value, now.rate[k] = rate * square.partial(0);
    }
  }
  /// Returns true if the last step passed a body without seeing it. @param order that of the method
  /// @param time duration of the step
  bool unseen(const OrbitSteps& method, int order, double time, const Distances& before,
              const Distances& after) {
    for (std::size_t k = 0; k < light_.size(); ++k)
      if (before.rate[k] < 0.0 && after.rate[k] > 0.0 &&
          misses(method, k, order, light_[k].reach * frequency_ * time,
                 {before.square[k], before.rate[k], after.square[k], after.rate[k]}))
        return true;
    return false;
  }

 private:
  using Along = Partials<double, 1>;
  /// A cubic polynomial in the part c of a step, from its values and slopes at 0 and 1.
  struct Cubic {
    double value, slope, end, end_slope;
    [[nodiscard]] double bend() const { return 3.0 * (end - value) - 2.0 * slope - end_slope; }
    [[nodiscard]] double twist() const { return slope + end_slope - 2.0 * (end - value); }
    [[nodiscard]] double at(double c) const { return value + c * (slope + c * (bend() + c * twist())); }
    /// The place of its minimum, as it falls at 0 and rises at 1.
    [[nodiscard]] double lowest() const {
      const auto rise = [this](double c) { return slope + c * (2.0 * bend() + 3.0 * c * twist()); };
      return bracketed_root(rise, 0.0, slope, 1.0, end_slope, 0.0).x;
    }
  };

  /// The part of an integral that Gauss's rule misses, if the integrand has a pole at the distance y from the
  /// interval [-1, 1].
  static double missed(double y, int order) { return std::pow(y + std::sqrt(1.0 + y * y), -order); }

  /// Returns true if the part of a kick that a step misses may be felt. The kick is 2 w / v, where w is the
  /// energy of the two bodies at their smallest distance and v the speed at which they pass. @param way
  /// distance that the kicked body moves in the step, by the motion as a whole @param u the square of
  /// distance k
  bool misses(const OrbitSteps& method, std::size_t k, int order, double way, const Cubic& u) {
    const Poles::Light& light = light_[k];
    const double place = u.lowest(), curvature = u.bend() + 3.0 * place * u.twist();
    if (!(curvature > 0.0)) return false;
    const double passes = std::sqrt(curvature);  // the way past the body, if it were straight
    const auto felt = [&](double change, double square) {
      const double y = 2.0 * std::sqrt(std::max(square, 0.0)) / passes;
      // From y = 1 on, errors fall with the step as the comparison of two runs supposes.
      return y < 1.0 && !(change / scale_ * way / passes * missed(y, order) <= kick_);
    };
    // On a circle, the cubic is wrong by as much in a step of 2.3 radians.
    const double nearest = std::max(u.at(place) - 0.03 * curvature, 0.0);
    if (!felt(light.strength * std::pow(nearest, -0.5 * light.steepness), nearest)) return false;
    const State<dynamic> there = method.polynomial(lowest(method, k, place));
    values_.assign(there.q.begin(), there.q.end());
    values_.insert(values_.end(), there.p.begin(), there.p.end());
    evaluate(*graph_, energy_, values_);
    return felt(poles_.change(light.node, light.degree, values_),
                light.square(values_[static_cast<std::size_t>(light.node)]));
  }
  /// The square of distance k at a part of the last step.
  double square_at(const OrbitSteps& method, std::size_t k, double part) {
    const State<dynamic> there = method.polynomial(part);
    still_->at(there.q.data(), there.p.data(), there.q.size());
    return light_[k].square((*still_)[k]);
  }
  /// The part of the step near `part` at which distance k is smallest, found by two parabolas: the square of
  /// the distance nearly is one.
  double lowest(const OrbitSteps& method, std::size_t k, double part) {
    for (const double aside : {0.05, 0.005}) {
      part = std::clamp(part, aside, 1.0 - aside);
      const double low = square_at(method, k, part - aside), middle = square_at(method, k, part),
                   high = square_at(method, k, part + aside), bend = low - 2.0 * middle + high;
      if (bend > 0.0) part += aside * std::clamp(0.5 * (low - high) / bend, -4.0, 4.0);
    }
    return std::clamp(part, 0.0, 1.0);
  }

  const ExpressionGraph* graph_;
  int energy_;
  double scale_, frequency_, kick_;
  Poles poles_;
  std::vector<Poles::Light> light_;
  std::optional<NodeValues<Along>> moving_;  // divisors of H, with their derivatives along the motion
  std::optional<NodeValues<>> still_;
  std::vector<Along> along_;    // (q, p) with their rates
  std::vector<double> values_;  // values of all nodes
};

}  // namespace avi::detail
