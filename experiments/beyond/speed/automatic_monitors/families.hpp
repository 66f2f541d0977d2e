#pragma once
#include "beyond/speed/automatic_monitors/scenes.hpp"

#include "avi/autodiff/reverse.hpp"

#include <algorithm>
#include <cmath>

/// @file
/// Monitors that exist for every problem, the paper's among them.

namespace experiment {

/// The arclength of phase space, \f$(|\dot q|^2 + |\dot p|^2)^{-1/2}\f$; then, with floors and exponents that
/// one would scan, the paper's energy monitor, \f$(p\cdot\partial H/\partial p + c)^{-\alpha}\f$ (twice the
/// kinetic energy), its inverse Lagrangian, \f$(L^2 + c)^{-\alpha}\f$, and the arclength to other powers.
inline std::vector<HandMade> general_monitors(const Scene& scene) {
  const int n = static_cast<int>(scene.energy.size());
  avi::ExpressionGraph graph(2 * n);
  const V q = avi::recorded_inputs(graph, 0, n), p = avi::recorded_inputs(graph, n, n);
  const Recorded energy = scene.energy(q, p);
  const std::vector<int> slopes = avi::Reverse(graph).gradient(energy.node_in(graph));  // dH/dq, dH/dp
  Recorded squared_speed = 0.0, work = 0.0;
  for (const int slope : slopes)
    squared_speed += square(Recorded(graph, slope));
  for (int i = 0; i < n; ++i)
    work += p[i] * Recorded(graph, slopes[n + i]);

  std::vector<HandMade> made;
  const auto add = [&](const char* name, const Recorded& base, double alpha) {
    made.push_back({name, {graph, pow(base, -alpha).node_in(graph)}});
  };
  const double h0 = scene.energy(scene.start.q, scene.start.p);
  add("arclength", squared_speed, 0.5);
  for (const double alpha : {0.5, 1.0, 1.5})
    for (const double floor : {0.1, 1.0})
      add("energy", work + floor * std::max(0.1, std::abs(h0)), alpha);
  for (const double alpha : {0.5, 0.75})
    add("inverse_lagrangian", square(work - energy) + (h0 * h0 + 0.01), alpha);
  add("arclength^0.5", squared_speed, 0.25);
  add("arclength^1.5", squared_speed, 0.75);
  return made;
}

}  // namespace experiment
