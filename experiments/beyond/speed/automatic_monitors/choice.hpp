#pragma once
#include "avi/solve.hpp"
#include "beyond/speed/automatic_monitors/scenes.hpp"

/// @file
/// The monitor, order and step that solve() chooses for a scene, and the monitor as a formula.

namespace experiment {

/// The monitor of a choice for a scene; 1 where steps are fixed.
inline avi::Formula monitor_of(const Scene& scene, const avi::Choice& choice) {
  return avi::monitor_of(choice, scene.energy, scene.energy(scene.start.q, scene.start.p));
}

/// What a short call of solve() chooses. @param order 0 to have it chosen
inline avi::SolutionReport choose(const Scene& scene, double time, double tolerance, int order) {
  return avi::solve(scene.energy, scene.start, time, tolerance, {.check = false, .order = order});
}

}  // namespace experiment
