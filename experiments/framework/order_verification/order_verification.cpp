#include "common/frame.hpp"
#include "framework/order_verification/order.hpp"

// The order of the map as an experiment: min(2r + 2, s) for the stationary construction and Taylor order r,
// quadrature order s; min(r + 1, s) at least for the paper's (Section 2.2). Type II and III.
int main(int argc, char** argv) {
  using namespace experiment;
  return run(
      argc, argv, "order_verification",
      "Measured order of HTVI for every Taylor order, rule, type and class of problem", [](Frame& frame) {
        experiment::Table out = frame.table({"problem", "type", "r", "quadrature", "expected_order",
                                             "measured_order", "construction", "points", "limit_order"});
        out.note("measured_order",
                 "slope of the final error in (q, p, t) over the step, nan with fewer than 3 usable points");
        out.note("limit_order",
                 "slope at h = 0, extrapolated from measured_order and the slope of the four steps before");
        double begin = 0.0;
        for (auto* part :
             {&order_cells_without_monitor, &order_cells_of_monitors, &order_cells_of_general_problems}) {
          for (const auto& c :
               part(frame.quick, [&](double f) { frame.progress("cells", (begin + f) / 3.0); }))
            out.row(c.problem, c.type, c.r, c.quadrature, c.expected, c.measured, c.construction, c.points,
                    c.limit);
          begin += 1.0;
        }
        frame.write(out);
      });
}
