#pragma once
#include "beyond/speed/automatic_monitors/energy_run.hpp"
#include "beyond/speed/automatic_monitors/scenes.hpp"
#include "common/table.hpp"
#include "common/timing.hpp"

#include <cmath>
#include <limits>

/// @file
/// What a monitor takes to meet a target.

namespace experiment {

using Point = avi::State<avi::dynamic>;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Targets {
  int order;
  double position, energy;
};
inline constexpr double most_steps = 40000.0;

/// What a run took and its errors; or what it would take to just reach a target.
struct Measured {
  double steps = unknown, sweeps = unknown, seconds = unknown, position_error = unknown,
         energy_error = unknown;
  bool ok = false;
};
struct Cost {
  Measured position, energy;  ///< For the targets of these errors.
  double sweep = 1.0;         ///< What a sweep costs, in additions.
  /// Geometric mean over both targets; infinite where one was not reached.
  [[nodiscard]] double steps() const { return mean(position.steps * energy.steps); }
  [[nodiscard]] double work() const { return sweep * mean(position.sweeps * energy.sweeps); }

 private:
  static double mean(double product) { return std::isnan(product) ? infinity : std::sqrt(product); }
};

/// A scene with what all its runs share.
struct Arena {
  const Scene& scene;
  const Menu menu;
  const avi::VectorX end;  ///< Position at the end.
  double scale;            ///< Of energy errors.
  double turns;            ///< Of the velocity in phase space, 2 pi each: no fewer than periods.
};

/// The choice with which a whole run of order 16 keeps its energy to 1e-12, or the least above it that
/// rounding allows.
inline MonitorChoice finest(const Scene& scene) {
  for (double tolerance = 1e-12;; tolerance *= 3.0) {
    auto solution = energy_run(scene.energy, scene.start, scene.time, tolerance);
    solution.choice.reached = solution.run.outcome == avi::Outcome::ok && solution.kept();
    if (solution.choice.reached || 3.0 * tolerance > 1e-9) return solution.choice;
  }
}

/// A scene with the position at its end and its turns by order 16 with steps of six tenths of those that it
/// was chosen with.
inline Arena arena_of(const Scene& scene, const MonitorChoice& choice) {
  Menu menu({scene.energy, scene.start});
  const Curvature curvature({scene.energy, scene.start});
  auto method = avi::collocation(poincare(scene.energy, scene.start, choice.monitor), 16);
  Point z = scene.start;
  avi::VectorX place(2 * z.q.size()), next = place, way = 0.0 * place;
  place << z.q, z.p;
  double angle = 0.0;
  (void)integrate_to(method, z, 0.6 * choice.h, scene.time, [&](const Point& at, long k) {
    next << at.q, at.p;
    if (k > 1) angle += curvature.angle(way, next - place, menu.scales->frequency);
    way = next - place;
    place = next;
  });
  return {scene, std::move(menu), z.q, choice.energy_scale, angle / (2.0 * M_PI)};
}

/// What a sweep costs with a monitor: by count, for counts do not depend on what else the machine does.
inline double sweep_of(const Arena& arena, const avi::Formula& monitor, int order) {
  const avi::Formula& energy = arena.scene.energy;
  const double h0 = energy(arena.scene.start.q, arena.scene.start.p);
  return sweep_work(
      avi::Formula::of_phase([&](const V& q, const V& p) { return monitor(q, p) * (energy(q, p) - h0); },
                             arena.scene.start.q.size()),
      order);
}

/// One run.
inline Measured measure(const Arena& arena, avi::Collocation<Pilot::Problem>& method, double h, long cap) {
  const avi::Formula& energy = arena.scene.energy;
  const double h0 = energy(arena.scene.start.q, arena.scene.start.p);
  Point z = arena.scene.start;
  double worst = 0.0;
  avi::Run run;
  const double time = seconds([&] {
    run = integrate_to(method, z, h, arena.scene.time, [&](const Point& at, long k) {
      worst = std::max(worst, std::abs(energy(at.q, at.p) - h0) / arena.scale);
      return k < cap && worst < 1e3;
    });
  });
  return {static_cast<double>(run.steps),
          static_cast<double>(run.evaluations),
          time,
          (z.q - arena.end).norm(),
          worst,
          run.outcome == avi::Outcome::ok};
}

/// More and more steps until both targets are met, or both more than `most` steps and more than `dearest`
/// work were spent; between two runs what a target takes is interpolated.
inline Cost cost(const Arena& arena, const avi::Formula& monitor, const Targets& targets, double most,
                 double dearest, double factor) {
  Cost found;
  const OrbitScales& scales = *arena.menu.scales;
  const double fictive = scales.fictive_time(monitor, arena.scene.time);
  if (!(fictive > 0.0) || !std::isfinite(fictive)) return found;
  found.sweep = sweep_of(arena, monitor, targets.order);
  auto method = avi::collocation(poincare(arena.scene.energy, arena.scene.start, monitor), targets.order);
  Measured before;
  const double radians = scales.frequency * arena.scene.time;
  for (double steps = 0.06 * radians * std::pow(targets.energy, -1.0 / targets.order); steps < most_steps;
       steps *= factor) {
    const Measured now = measure(arena, method, fictive / steps, static_cast<long>(2.0 * most_steps));
    if (now.steps > most && found.sweep * now.sweeps > dearest) break;
    const auto look = [&](Measured& reached, double target, double Measured::*error) {
      if (!std::isnan(reached.steps) || !(now.*error <= target)) return;
      reached = now;
      if (!(before.*error > target && now.*error > 0.0)) return;
      const double share = std::log(before.*error / target) / std::log(before.*error / now.*error);
      const double sweeps = std::pow(now.sweeps / before.sweeps, share - 1.0);  // over those of this run
      reached.steps *= std::pow(now.steps / before.steps, share - 1.0);
      reached.sweeps *= sweeps;
      reached.seconds *= sweeps;
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
