#include "frame/frame.hpp"
#include "order/order.hpp"

// The order theorem of the paper (Section 2.2) as an experiment: the order of the map is at least min(r + 1,
// s) for Taylor order r and quadrature order s, Type II and III.
int main(int argc, char** argv) {
  using namespace experiment;
  return run(argc, argv, "order_verification",
             "Measured order of HTVI for every Taylor order, rule, type and problem", [](Frame& frame) {
               avi::Table out = frame.table({"problem", "type", "r", "quadrature", "expected_order",
                                             "measured_order", "construction", "points"});
               out.note("measured_order",
                        "slope of the final error over the step, nan with fewer than 3 usable points");
               const auto add = [&](const std::vector<OrderCell>& cells) {
                 for (const auto& c : cells)
                   out.row(c.problem, c.type, c.r, c.quadrature, c.expected, c.measured, c.construction,
                           c.points);
               };
               add(order_cells_printed(frame.quick, [&](double f) { frame.progress("printed", 0.5 * f); }));
               add(order_cells_superconvergent(
                   frame.quick, [&](double f) { frame.progress("superconvergent", 0.5 + 0.5 * f); }));
               frame.write(out);
             });
}
