#pragma once
#include "beyond/speed/work_precision/scenes/arena.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/transform/poincare.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

/// @file
/// Gauss collocation of the orders 4 to 16, each a family, with the monitor that the scene asks for.

namespace experiment::work_precision {
/// g = |q|^(3/2).
struct ThreeHalves {
  template <class Q>
  auto operator()(const Q& q) const {
    using std::pow;
    return pow(q[0] * q[0] + q[1] * q[1], 0.75);
  }
};

/// Orders 4 to 16; `largest` is the coarsest step of order 16. In short runs of many small steps sweeps that
/// end early are tried, too (`loosely`): enough for errors above their tolerance.
template <class P, class G>
void add_collocation(Scene& scene, const Arena<P>& arena, const std::string& knob, double largest, G monitor,
                     bool loosely = false) {
  const auto add = [&](const std::string& its, int order, double coarse, avi::SweepSettings sweeps = {}) {
    scene.families.push_back(
        arena.family("collocation", order, Origin::collocation, its + " h",
                     geometric(coarse * largest, order < 8 ? 0.8 : 0.9, order < 8 ? 30 : 24),
                     [=](const P& problem, const auto& start) {
                       return avi::collocation(avi::poincare(problem, start, monitor), order, sweeps);
                     }));
  };
  add(knob, 4, 0.3);
  add(knob, 8, 0.6);
  add(knob, 12, 0.9);
  add(knob, 16, 1.0);
  if (!loosely) return;
  for (const double tolerance : {1e-4, 1e-6, 1e-10}) {
    const std::string its = fmt::format("{} tolerance={:.0e}", knob, tolerance);
    add(its, 8, 0.6, {.tolerance = tolerance});
    add(its, 16, 1.0, {.tolerance = tolerance});
  }
}

}  // namespace experiment::work_precision
