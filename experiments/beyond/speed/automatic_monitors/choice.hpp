#pragma once
#include "avi/autodiff/reverse.hpp"
#include "avi/solve.hpp"
#include "beyond/speed/automatic_monitors/scenes.hpp"

#include <cmath>
#include <numeric>
#include <vector>

/// @file
/// The monitor, order and step that solve() chooses for a scene, and the monitor as a formula.

namespace experiment {

/// The monitor of that name in the menu of solve(), with the constants that its choice holds; 1 where steps
/// are fixed.
inline avi::Formula monitor_of(const Scene& scene, const avi::Choice& choice) {
  const int n = scene.energy.inputs() / 2;
  avi::ExpressionGraph graph(2 * n);
  const V q = avi::recorded_inputs(graph, 0, n), p = avi::recorded_inputs(graph, n, n);
  const Recorded energy = scene.energy(q, p);
  Recorded g = 1.0;
  if (choice.name == "acceleration") {
    const std::vector<int> slopes = avi::Reverse(graph).gradient(energy.node_in(graph));
    Recorded sum = 1.0;
    for (std::size_t i = 0; i < choice.accelerations.size(); ++i)
      sum += square(choice.accelerations[i] * Recorded(graph, slopes[i]));
    g = pow(sum, -0.375);
  } else if (choice.name.starts_with("energy")) {
    const double at_start = scene.energy(scene.start.q, scene.start.p);
    V rest = V::Constant(n, Recorded(0.0));
    if (!choice.drifts.empty()) {
      const std::vector<int> slopes = avi::Reverse(graph).gradient(energy.node_in(graph));
      std::vector<int> arguments(slopes.size(), graph.constant(0.0));
      std::iota(arguments.begin(), arguments.begin() + n, 0);
      for (int i = 0; i < n; ++i)
        rest[i] =
            (-1.0 / choice.drifts[static_cast<std::size_t>(i)]) *
            Recorded(graph, graph.substitute(graph, slopes[static_cast<std::size_t>(n + i)], arguments));
    }
    const Recorded lively = choice.kinetic + 0.5 * (energy + at_start) - scene.energy(q, rest);
    g = pow(lively, choice.name == "energy" ? -1.0 : -1.5);
  }
  return {graph, g.node_in(graph)};
}

/// What a short call of solve() chooses. @param order 0 to have it chosen
inline avi::SolutionReport choose(const Scene& scene, double time, double tolerance, int order) {
  return avi::solve(scene.energy, scene.start, time, tolerance, {.check = false, .order = order});
}

}  // namespace experiment
