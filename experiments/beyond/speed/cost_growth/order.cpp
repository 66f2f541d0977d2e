#include "beyond/speed/cost_growth/axes.hpp"
#include "common/methods/methods.hpp"

#include "avi/problems/kepler.hpp"

#include <cmath>
#include <limits>

// The Taylor order of one expansion.

namespace experiment {

Axis along_order() {
  const State2 start = avi::Kepler::pericentre(0.5);
  constexpr PositionMonitor monitor{.kind = PositionMonitor::power_of_radius, .exponent = 1.5};
  constexpr double h = 0.05, none = std::numeric_limits<double>::quiet_NaN();
  Axis axis;
  for (int r = 0; r <= 15; ++r) {
    const Runner runner = htvi(r, monitor);
    const avi::Until until{.steps = 100};
    State2 z = start;
    const avi::Run run = runner.prepare(start)(z, h, until);
    axis.runs.push_back({"order", "htvi_of_order", static_cast<double>(r), run.steps, run.evaluations, none,
                         [=] {
                           State2 moved = start;
                           (void)runner.prepare(start)(moved, h, until);
                         },
                         static_cast<double>(run.evaluations)});
  }
  // Coefficient k of a product takes k multiplications; what an order costs once keeps the power below 2.
  axis.expected.push_back({"order", "htvi_of_order", none, 2.0, 4.0, 15.0});
  return axis;
}

}  // namespace experiment
