#pragma once
#include "avi/autodiff/partials.hpp"
#include "avi/autodiff/program.hpp"
#include "candidates.hpp"
#include "poles.hpp"
#include "schedule.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

/// @file
/// Steps that go by a light body so near that their stages miss its kick.

namespace avi::detail {

/// The poles of which nothing is felt where an orbit begins, as those of light bodies. Two runs whose stages
/// both miss the kick of such a pole agree, and are both wrong.
class NearPasses {
 public:
  /// The squares u of the distances at the end of a step, and how they change in time.
  struct Distances {
    std::vector<double> u, rate;
  };

  /// Takes H as a node of a graph, which outlives it. @param sketch of the orbit, where it begins
  /// @param scale of its energies @param kick part of the momenta that is felt at the end of the run
  NearPasses(const ExpressionGraph& graph, int energy, const Sketch& sketch, double scale, double kick)
      : graph_(&graph), energy_(energy), scale_(scale), kick_(kick), poles_(graph, energy) {
    if (poles_.size() < 2) return;  // one alone is felt everywhere
    light_ = poles_.unfelt(sketch, 0.01 * scale);
    std::vector<int> nodes;
    for (const Poles::Light& each : light_)
      nodes.push_back(each.node);
    if (none()) return;
    const Program squares = Schedule::program(graph, -1, nodes, graph.size());
    moving_.emplace(RecordedFormula<Along>{squares});
    still_.emplace(RecordedFormula<double>{squares});
  }

  /// There is none.
  [[nodiscard]] bool none() const { return light_.empty(); }
  /// A body goes by unseen in the last step, of the size h, of a method of that order.
  /// @param slope dz/dt at its end @param last distances at its beginning; gets those at its end
  bool unseen(const OrbitSteps& method, Candidate& candidate, int order, double h,
              const State<dynamic>& before, const State<dynamic>& after, const VectorX& slope,
              Distances& last) {
    Along* const at = moving_->room.arguments();
    const Eigen::Index n = after.q.size();
    for (Eigen::Index i = 0; i < n; ++i) {
      at[i] = Along::variable(after.q[i], 0, slope[i]);
      at[n + i] = Along::variable(after.p[i], 0, slope[n + i]);
    }
    moving_->program.run(moving_->room);
    const double rate = candidate.fixed() ? h : h * candidate.rate_at(after);
    last.u.resize(light_.size(), 0.0), last.rate.resize(light_.size(), 0.0);
    bool any = false;
    for (std::size_t k = 0; k < light_.size(); ++k) {
      const double u = moving_->partial(static_cast<int>(k)).value,
                   change = rate * moving_->partial(static_cast<int>(k)).partial(0);
      if (!any && last.rate[k] < 0.0 && change > 0.0)
        any = misses(method, light_[k], order, (after.q - before.q).norm(),
                     {last.u[k], last.rate[k], u, change});
      last.u[k] = u, last.rate[k] = change;
    }
    return any;
  }

 private:
  using Along = Partials<double, 1>;
  /// A cubic of the part c of a step, from its values and slopes at 0 and 1.
  struct Cubic {
    double value, slope, end, end_slope;
    [[nodiscard]] double bend() const { return 3.0 * (end - value) - 2.0 * slope - end_slope; }
    [[nodiscard]] double twist() const { return slope + end_slope - 2.0 * (end - value); }
    [[nodiscard]] double at(double c) const { return value + c * (slope + c * (bend() + c * twist())); }
    /// Where it is least, as it falls at 0 and rises at 1.
    [[nodiscard]] double lowest() const {
      double low = 0.0, high = 1.0;
      for (int i = 0; i < 20; ++i) {
        const double c = 0.5 * (low + high);
        (slope + c * (2.0 * bend() + 3.0 * c * twist()) < 0.0 ? low : high) = c;
      }
      return 0.5 * (low + high);
    }
  };

  /// What Gauss's rule misses of a function with a pole at the distance y from its interval [-1, 1].
  static double missed(double y, int order) { return std::pow(y + std::sqrt(1.0 + y * y), -order); }

  /// The part of a kick that a step misses may be felt. @param way of all bodies in the step @param u the
  /// square of the distance
  bool misses(const OrbitSteps& method, const Poles::Light& light, int order, double way, const Cubic& u) {
    const double place = u.lowest(), curvature = u.bend() + 3.0 * place * u.twist();
    if (!(curvature > 0.0)) return false;
    const double passes = std::sqrt(curvature);  // the way by the body, were it straight
    const auto felt = [&](double change, double square) {
      const double y = 2.0 * std::sqrt(std::max(square, 0.0)) / passes;
      return y < 1.0 && !(change / scale_ * way / passes * missed(y, order) <= kick_);
    };
    // The cubic is wrong by some hundredths of what the square changes by.
    const double nearest = std::max(u.at(place) - 0.03 * curvature, 0.0);
    if (!felt(light.strength * std::pow(nearest, -0.5 * light.steepness), nearest)) return false;
    const std::size_t k = static_cast<std::size_t>(&light - light_.data());
    const State<dynamic> there = method.polynomial(lowest(method, k, place));
    values_.assign(there.q.begin(), there.q.end());
    values_.insert(values_.end(), there.p.begin(), there.p.end());
    evaluate(*graph_, energy_, values_);
    return felt(poles_.change(light.pole, values_), values_[static_cast<std::size_t>(light.node)]);
  }
  /// The square of distance k at a part of the last step.
  double square_at(const OrbitSteps& method, std::size_t k, double part) {
    const State<dynamic> there = method.polynomial(part);
    still_->run(there.q, there.p);
    return still_->partial(static_cast<int>(k));
  }
  /// Where it is least, near a part of the step, by golden section.
  double lowest(const OrbitSteps& method, std::size_t k, double part) {
    constexpr double golden = 0.6180339887498949;
    double low = std::max(part - 0.2, 0.0), high = std::min(part + 0.2, 1.0);
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = square_at(method, k, a), at_b = square_at(method, k, b);
    for (int i = 0; i < 20; ++i) {
      if (at_a < at_b) {
        high = b, b = a, at_b = at_a;
        a = high - golden * (high - low);
        at_a = square_at(method, k, a);
      } else {
        low = a, a = b, at_a = at_b;
        b = low + golden * (high - low);
        at_b = square_at(method, k, b);
      }
    }
    return 0.5 * (low + high);
  }

  const ExpressionGraph* graph_;
  int energy_;
  double scale_, kick_;
  Poles poles_;
  std::vector<Poles::Light> light_;
  std::optional<RecordedFormula<Along>> moving_;  // squares of the distances
  std::optional<RecordedFormula<double>> still_;
  std::vector<double> values_;  // of all nodes
};

}  // namespace avi::detail
