#include "avi/htvi/htvi.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"
#include "bregman/printed/extended_splitting.hpp"
#include "bregman/printed/htvi_printed.hpp"
#include "common/frame.hpp"
#include "common/methods/printed_htvi.hpp"
#include "framework/step_defects.hpp"

// How far one step is from being symplectic, as the step shrinks: the adaptive integrators on Kepler's
// problem, as maps of (q, p) and of (q, t, p, p^t), and the printed updates for Bregman dynamics on extended
// phase space, r^t included.

using namespace experiment;

void experiment::conduct(Frame& frame) {
  Table& table = frame.table({"problem", "method", "variables", "h", "defect"});
  table.note("defect", "| J^T Omega J - Omega |, J by differences good to about 1e-12");
  const avi::Kepler kepler;
  const avi::State<2> somewhere = kepler_point();
  const auto monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
  const auto htvi4 = avi::type2<3, Authors>(avi::poincare<2>(kepler, somewhere, monitor), avi::simpson());
  for (double h : {0.16, 0.08, 0.04, 0.02, 0.01}) {
    table.row("kepler", "htvi4", "q p", h, avi::symplecticity_defect(htvi4, somewhere, h));
    table.row("kepler", "htvi4", "q t p p^t", h, kepler_defect<Authors>(monitor, h));
    table.row("kepler", "symplectic_euler_b", "q p", h,
              avi::symplecticity_defect(avi::euler_b<2>(kepler, somewhere, avi::NormSquared{}), somewhere,
                                        0.25 * h));
  }
  const auto family = avi::BregmanFamily::adaptive(4.0, 1.0);
  for (double h : {0.02, 0.01, 0.005, 0.0025, 0.00125}) {
    table.row("bregman", "htvi", "q t r r^t", h, bregman_defect(htvi_printed_step, family, h));
    table.row("bregman", "splitting", "q t r r^t", h, bregman_defect(splitting_printed_step, family, h));
    table.row("bregman", "splitting", "q r", h, bregman_defect(splitting_printed_step, family, h, true));
    table.row("bregman", "three_flows", "q t r r^t", h, bregman_defect(three_flow_step, family, h));
  }
}
