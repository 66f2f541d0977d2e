#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate_to.hpp"
#include "avi/solve.hpp"
#include "avi/transform/poincare.hpp"
#include "beyond/speed/automatic_monitors/scenes.hpp"
#include "common/table.hpp"

#include <cmath>
#include <vector>

// The cost of reaching a given error with a given monitor.

namespace experiment {

using Point = avi::State<avi::dynamic>;
using Problem = avi::Poincare<avi::dynamic, avi::Formula, avi::Formula>;

/// The monitor of a choice for a scene; it is 1 for fixed steps.
inline avi::Formula monitor_of(const Scene& scene, const avi::Choice& choice) {
  return avi::monitor_of(choice, scene.energy, scene.energy(scene.start.q, scene.start.p));
}

/// The choice made by a short call of solve(). @param order of the method; 0 to have it chosen
inline avi::SolutionReport choose(const Scene& scene, double time, double tolerance, int order) {
  return avi::solve(scene.energy, scene.start, time, tolerance, {.check = false, .order = order});
}

/// Target errors for collocation of a given order.
struct Targets {
  int order;
  double position, energy;
};
inline constexpr double most_steps = 40000.0;

/// The cost of a run and its errors; or the interpolated cost of just reaching a target.
struct Measured {
  double steps = unknown, sweeps = unknown, position_error = unknown, energy_error = unknown;
  bool ok = false;
};
/// The cost of reaching the targets with one monitor.
struct Cost {
  Measured position, energy;  ///< For the targets of position and of energy.
  double sweep = 1.0;         ///< Cost of a sweep, in operations.
  /// Geometric mean over both targets; infinite if one was not reached.
  [[nodiscard]] double steps() const { return mean(position.steps * energy.steps); }
  [[nodiscard]] double work() const { return sweep * mean(position.sweeps * energy.sweeps); }

 private:
  static double mean(double product) { return std::isnan(product) ? HUGE_VAL : std::sqrt(product); }
};

/// A scene with its orbit, accurate nearly to rounding.
struct Arena {
  const Scene& scene;
  double scale;              ///< Unit of energy errors.
  std::vector<Point> orbit;  ///< The start and the states after each step of a run of order 16.

  /// The fictive time of the orbit with a monitor; infinite if the monitor is not positive on it.
  [[nodiscard]] double fictive_time(const avi::Formula& monitor) const {
    double sum = 0.0;
    for (std::size_t k = 1; k < orbit.size(); ++k) {
      const Point &a = orbit[k - 1], &b = orbit[k];
      const double left = monitor(a.q, a.p), right = monitor(b.q, b.p);
      if (!(left > 0.0) || !(right > 0.0)) return HUGE_VAL;
      sum += 0.5 * (b.t - a.t) * (1.0 / left + 1.0 / right);
    }
    return sum;
  }
};

/// The orbit of a scene, by order 16 with 0.6 times the step that keeps the tolerance. The tolerance is
/// 1e-12, or the smallest larger power of ten that is kept. The orbit is empty if none below 1e-7 is kept.
inline Arena arena_of(const Scene& scene) {
  Arena arena{scene, 1.0, {}};
  for (double tolerance = 1e-12; tolerance < 1e-7 && arena.orbit.empty(); tolerance *= 10.0) {
    const avi::SolutionReport found = choose(scene, scene.time, tolerance, 16);
    if (!found.kept()) continue;
    arena.scale = found.choice.energy_scale;
    auto method = avi::collocation(poincare(scene.energy, scene.start, monitor_of(scene, found.choice)), 16);
    Point z = scene.start;
    arena.orbit.push_back(z);
    (void)integrate_to(method, z, 0.6 * found.choice.h, scene.time,
                       [&](const Point& at, long) { arena.orbit.push_back(at); });
    arena.orbit.push_back(z);
  }
  return arena;
}

/// The cost of a sweep with a monitor, in operations: those of the gradient of the transformed H, and with
/// n degrees of freedom 20 + 8 n more. For four in five pairs of monitor and scene it is proportional to the
/// time within a third. Operations are counted, because counts do not depend on other work of the machine.
inline double sweep_of(const Scene& scene, const avi::Formula& monitor) {
  const avi::Formula& energy = scene.energy;
  const double h0 = energy(scene.start.q, scene.start.p);
  const auto n = scene.start.q.size();
  const auto transformed =
      avi::Formula::of_phase([&](const V& q, const V& p) { return monitor(q, p) * (energy(q, p) - h0); }, n);
  const auto gradient = avi::Recording(transformed).gradient(0, transformed.inputs());
  return 20.0 + 8.0 * static_cast<double>(n) + static_cast<double>(gradient.operations());
}

/// One run with step h, of at most `cap` steps.
inline Measured measure(const Arena& arena, avi::Collocation<Problem>& method, double h, long cap) {
  const avi::Formula& energy = arena.scene.energy;
  const double h0 = energy(arena.scene.start.q, arena.scene.start.p);
  Point z = arena.scene.start;
  double worst = 0.0;
  const avi::Run run = integrate_to(method, z, h, arena.scene.time, [&](const Point& at, long k) {
    worst = std::max(worst, std::abs(energy(at.q, at.p) - h0) / arena.scale);
    return k < cap && worst < 1e3;
  });
  return {static_cast<double>(run.steps), static_cast<double>(run.evaluations),
          (z.q - arena.orbit.back().q).norm(), worst, run.outcome == avi::Outcome::ok};
}

/// Increases the number of steps until both targets are met, one run takes more than `most` steps and more
/// than `dearest` work, or `most_steps` are reached. The cost at a target is interpolated between two runs.
inline Cost cost(const Arena& arena, const avi::Formula& monitor, const Targets& targets, double most,
                 double dearest) {
  Cost found;
  const double fictive = arena.fictive_time(monitor);
  if (!(fictive > 0.0) || !std::isfinite(fictive)) return found;
  found.sweep = sweep_of(arena.scene, monitor);
  auto method = avi::collocation(poincare(arena.scene.energy, arena.scene.start, monitor), targets.order);
  Measured before;
  const double first = 0.006 * static_cast<double>(arena.orbit.size());
  for (double steps = first * std::pow(targets.energy, -1.0 / targets.order); steps < most_steps;
       steps *= 1.4) {
    const Measured now = measure(arena, method, fictive / steps, static_cast<long>(2.0 * most_steps));
    if (now.steps > most && found.sweep * now.sweeps > dearest) break;
    const auto look = [&](Measured& reached, double target, double Measured::*error) {
      if (!std::isnan(reached.steps) || !(now.*error <= target)) return;
      reached = now;
      if (!(before.*error > target && now.*error > 0.0)) return;
      const double share = std::log(before.*error / target) / std::log(before.*error / now.*error);
      reached.steps *= std::pow(now.steps / before.steps, share - 1.0);
      reached.sweeps *= std::pow(now.sweeps / before.sweeps, share - 1.0);
    };
    if (now.ok) {
      look(found.position, targets.position, &Measured::position_error);
      look(found.energy, targets.energy, &Measured::energy_error);
      if (std::isfinite(found.steps())) break;
    }
    before = now.ok ? now : Measured();
  }
  return found;
}

}  // namespace experiment
