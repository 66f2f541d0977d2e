#include "common/frame.hpp"

#include "avi/diagnostics/symplecticity.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"
#include "bregman/printed/extended_splitting.hpp"
#include "bregman/printed/htvi_printed.hpp"
#include "common/methods/printed_htvi.hpp"
#include "common/problems/correlated_quartic.hpp"

#include <cmath>

// How far one step is from being symplectic, as the step shrinks: the adaptive integrators on Kepler's
// problem, as maps of (q, p) and of (q, t, p, p^t), and the printed updates for Bregman dynamics on extended
// phase space, r^t included.

namespace {

constexpr Eigen::Index d = 3;
const experiment::CorrelatedQuartic f(d, 0.9);
const auto family = avi::BregmanFamily::adaptive(4.0, 1.0);

avi::ExtendedPoint start() {
  return {.q = Eigen::Vector3d(1.3, 0.8, 1.5), .t = 1.2, .r = Eigen::Vector3d(0.2, -0.4, 0.5), .r_t = 0.7};
}

using Step = void (*)(const avi::BregmanFamily&, const experiment::CorrelatedQuartic&, double,
                      avi::ExtendedPoint&);

/// Defect of a step on (q, t, r, r^t); with `block`, of its (q, r) part at fixed t and r^t.
double bregman_defect(Step step, double h, bool block = false) {
  const Eigen::Index m = block ? d : d + 1;
  avi::VectorX at(2 * m);
  at.head(d) = start().q;
  at.segment(m, d) = start().r;
  if (!block) at[d] = start().t, at[2 * d + 1] = start().r_t;
  return avi::symplecticity_defect(
      [&](const avi::VectorX& v) -> avi::VectorX {
        avi::ExtendedPoint z = start();
        z.q = v.head(d);
        z.r = v.segment(m, d);
        if (!block) z.t = v[d], z.r_t = v[2 * d + 1];
        step(family, f, h, z);
        avi::VectorX image(2 * m);
        image.head(d) = z.q;
        image.segment(m, d) = z.r;
        if (!block) image[d] = z.t, image[2 * d + 1] = z.r_t;
        return image;
      },
      at);
}

/// Defect of a step of HTVI4 on (q, t, p, p^t), off the energy shell: symplecticity must not need it.
template <class Monitor>
double kepler_defect(const Monitor& monitor, double h) {
  const avi::Kepler kepler;
  const avi::State<2> z = avi::Kepler::exact(0.6, 0.9);
  avi::VectorX at(6);
  at << z.q, 0.3, z.p, -kepler(z.q, z.p) + 0.02;
  return avi::symplecticity_defect(
      [&](const avi::VectorX& x) -> avi::VectorX {
        const avi::Poincare<2, avi::Kepler, Monitor> problem(kepler, monitor, x[5]);
        avi::State<2> s{.q = x.head<2>(), .p = x.segment<2>(3), .t = x[2]};
        if (avi::type2<3, experiment::Authors>(problem, avi::simpson()).step(s, h).outcome !=
            avi::Outcome::ok)
          s.t = std::nan("");
        avi::VectorX image(6);
        image << s.q, s.t, s.p, x[5];
        return image;
      },
      at);
}

}  // namespace

int main(int argc, char** argv) {
  return experiment::run(argc, argv, AVI_SHOWS, [](experiment::Frame& frame) {
    experiment::Table table = frame.table({"problem", "method", "variables", "h", "defect"});
    table.note("defect", "| J^T Omega J - Omega |, J by differences good to about 1e-12");
    const avi::Kepler kepler;
    const avi::State<2> somewhere = avi::Kepler::exact(0.6, 0.9);
    const auto monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
    const auto htvi4 =
        avi::type2<3, experiment::Authors>(avi::poincare<2>(kepler, somewhere, monitor), avi::simpson());
    for (double h : {0.16, 0.08, 0.04, 0.02, 0.01}) {
      table.row("kepler", "htvi4", "q p", h, avi::symplecticity_defect(htvi4, somewhere, h));
      table.row("kepler", "htvi4", "q t p p^t", h, kepler_defect(monitor, h));
      table.row("kepler", "symplectic_euler_b", "q p", h,
                avi::symplecticity_defect(avi::euler_b<2>(kepler, somewhere, avi::NormSquared{}), somewhere,
                                          0.25 * h));
    }
    for (double h : {0.02, 0.01, 0.005, 0.0025, 0.00125}) {
      using namespace experiment;
      table.row("bregman", "htvi", "q t r r^t", h, bregman_defect(htvi_printed_step, h));
      table.row("bregman", "splitting", "q t r r^t", h, bregman_defect(splitting_printed_step, h));
      table.row("bregman", "splitting", "q r", h, bregman_defect(splitting_printed_step, h, true));
      table.row("bregman", "three_flows", "q t r r^t", h, bregman_defect(three_flow_step, h));
    }
    frame.write(table);
  });
}
