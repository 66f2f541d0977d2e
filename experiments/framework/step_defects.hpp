#pragma once
#include "avi/bregman/bregman_hamiltonian.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"
#include "common/problems/correlated_quartic.hpp"

#include <cmath>

// How far one step on extended phase space is from being symplectic.

namespace experiment {

using BregmanStep = void (*)(const avi::BregmanFamily&, const CorrelatedQuartic&, double,
                             avi::ExtendedPoint&);

/// Defect of a step on (q, t, r, r^t); with `block`, of its (q, r) part at fixed t and r^t.
inline double bregman_defect(BregmanStep step, const avi::BregmanFamily& family, double h,
                             bool block = false) {
  constexpr Eigen::Index d = 3;
  const Eigen::Index m = block ? d : d + 1;
  const CorrelatedQuartic f(d, 0.9);
  const avi::ExtendedPoint start{
      .q = Eigen::Vector3d(1.3, 0.8, 1.5), .t = 1.2, .r = Eigen::Vector3d(0.2, -0.4, 0.5), .r_t = 0.7};
  const auto packed = [&](const avi::ExtendedPoint& z) {
    avi::VectorX v(2 * m);
    v.head(d) = z.q;
    v.segment(m, d) = z.r;
    if (!block) v[d] = z.t, v[2 * d + 1] = z.r_t;
    return v;
  };
  return avi::symplecticity_defect(
      [&](const avi::VectorX& v) -> avi::VectorX {
        avi::ExtendedPoint z = start;
        z.q = v.head(d);
        z.r = v.segment(m, d);
        if (!block) z.t = v[d], z.r_t = v[2 * d + 1];
        step(family, f, h, z);
        return packed(z);
      },
      packed(start));
}

/// A point off the axes, e = 0.6, some way past the pericentre.
inline avi::State<2> kepler_point() { return avi::Kepler::exact(0.6, 0.9); }

/// Defect of a step of Type II with r = 3 from there on (q, t, p, p^t), off the energy shell: symplecticity
/// must not need it. NaN where a step fails.
template <class Construction, class Monitor>
double kepler_defect(const Monitor& monitor, double h) {
  const avi::Kepler kepler;
  const avi::State<2> z = kepler_point();
  avi::VectorX at(6);
  at << z.q, 0.3, z.p, -kepler(z.q, z.p) + 0.02;
  return avi::symplecticity_defect(
      [&](const avi::VectorX& x) -> avi::VectorX {
        const avi::Poincare<2, avi::Kepler, Monitor> problem(kepler, monitor, x[5]);
        avi::State<2> s{.q = x.head<2>(), .p = x.segment<2>(3), .t = x[2]};
        if (avi::type2<3, Construction>(problem, avi::simpson()).step(s, h).outcome != avi::Outcome::ok)
          s.t = std::nan("");
        avi::VectorX image(6);
        image << s.q, s.t, s.p, x[5];
        return image;
      },
      at);
}

}  // namespace experiment
