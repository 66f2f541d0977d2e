#include "extremes/methods.hpp"
#include "growth/axes.hpp"

#include "avi/htvi/taylor_values.hpp"
#include "avi/problems/kepler.hpp"

#include <cmath>
#include <limits>
#include <memory>

// The Taylor order of one expansion.

namespace experiment {

namespace {

const State2 start = avi::Kepler::pericentre(0.5);
constexpr PositionMonitor monitor{.kind = PositionMonitor::power_of_radius, .exponent = 1.5};
constexpr double h = 0.05, nan = std::numeric_limits<double>::quiet_NaN();

/// The expansion of TaylorValues, a hundred times.
template <int r>
Measurement values() {
  constexpr int times = 100;
  const auto problem = avi::poincare<2>(avi::Kepler{}, start, monitor);
  const auto taylor = std::make_shared<avi::TaylorValues<std::decay_t<decltype(problem)>, r>>(problem);
  return {"order",
          "taylor_values",
          r,
          0,
          times,
          nan,
          [=] {
            State2 z = start, change = start;
            for (int k = 0; k < times; ++k) {  // each from where the last one ended
              taylor->expand(z.q, z.p, h);
              taylor->increments(change.q, change.p, change.t);
              z.q += change.q;
              z.p += change.p;
            }
            volatile double seen = z.q[0];
            (void)seen;
          },
          times};
}

}  // namespace

Axis along_order() {
  Axis axis;
  for (int r = 0; r <= 15; ++r) {
    const Runner runner = htvi(r, monitor);
    const avi::Until until{.steps = 100};
    State2 z = start;
    const avi::Run run = runner.advance(start, z, h, until, [](const State2&) { return true; });
    axis.runs.push_back({"order", "htvi_of_order", static_cast<double>(r), run.steps, run.evaluations, nan,
                         [=] {
                           State2 moved = start;
                           runner.advance(start, moved, h, until, [](const State2&) { return true; });
                         },
                         static_cast<double>(run.evaluations)});
  }
  for (const Measurement& one : {values<3>(), values<5>(), values<8>(), values<12>()})
    axis.runs.push_back(one);
  // Coefficient k of a product takes k multiplications; what an order costs once keeps the power below 2.
  axis.expected.push_back({"order", "htvi_of_order", nan, 2.0, 4.0, 15.0});
  axis.expected.push_back({"order", "taylor_values", nan, 2.0, 3.0, 15.0});
  return axis;
}

}  // namespace experiment
