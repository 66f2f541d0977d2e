#pragma once
#include "avi/bregman/bregman_hamiltonian.hpp"

// The HTVI update as the paper prints it, r^t included: what the running form is tested against, and the
// form to use when the extended energy is to be seen.

namespace experiment {

/// One step of Section 4.4, Type II HTVI with Taylor order 0, on extended phase space.
/// \f{align*}{
/// r_1 &= r_0 - h\, potential(t_0)\, \nabla f(q_0), & q_1 &= q_0 + h\, kinetic(t_0)\, r_1,
/// \\ r^t_1 &= \frac{r^t_0 - h\,(\tfrac12\, kinetic'(t_0)\, |r_1|^2 + potential'(t_0)\, f(q_0))}
/// {1 + h\, monitor'(t_0)}, & t_1 &= t_0 + h\, monitor(t_0).
/// \f}
/// They are the discrete right Hamilton's equations (2.5) of
/// \f$H_d^+ = r_1\cdot q_0 + r^t_1 t_0 + h \bar H(q_0, t_0, r_1, r^t_1)\f$. For \f$\mathring p = p\f$ the
/// denominator is 1 and they are the Direct approach's. The coefficients grow as \f$t^{2p}\f$:
/// bregman/bregman_htvi.hpp has the form with half that range.
template <avi::Objective F>
void htvi_printed_step(const avi::BregmanFamily& family, const F& f, double h, avi::ExtendedPoint& z) {
  avi::VectorX gradient(z.q.size());
  const double value = f(z.q, gradient);
  z.r -= (h * family.potential(z.t)) * gradient;
  const double force =
      0.5 * family.kinetic_rate(z.t) * avi::dot(z.r, z.r) + family.potential_rate(z.t) * value;
  z.r_t = (z.r_t - h * force) / (1.0 + h * family.monitor_rate(z.t));
  z.q += (h * family.kinetic(z.t)) * z.r;
  z.t += h * family.monitor(z.t);
}

}  // namespace experiment
