#pragma once
#include "avi/bregman/bregman_hamiltonian.hpp"
#include "common/rules/bregman_cloning.hpp"

// Phase-space cloning with both copies, as the paper prints it: 3, 7 or 19 gradients a step. Kept to test
// bregman/bregman_cloning.hpp and to show what the clone costs.

namespace experiment {

/// One step of Strang's splitting, or of a triple jump of it, of \f$\bar H_1(q, t, \tilde r) + \bar
/// H_2(\tilde q, \tilde t, r)\f$ (equation (4.19)), r^t left out; z is the copy that is read. The last of the
/// printed equations (4.20) has a sign slip: \f$\tilde r' = -\nabla_{\tilde q} \bar H_2\f$ is meant, and
/// `clone_sign` = -1 is that; +1 is the printed sign. z does not feel the difference.
template <avi::Objective F>
void cloning_printed_step(const avi::BregmanFamily& family, const F& f, double h, const MergedStages& stages,
                          avi::ExtendedPoint& z, avi::ExtendedPoint& clone, double clone_sign = -1.0) {
  avi::VectorX gradient(z.q.size());
  const auto first_flow = [&](double length) {  // of H-bar_1: moves q~, t~ and r
    f(z.q, gradient);
    z.r -= (length * h * family.potential(z.t)) * gradient;
    clone.q += (length * h * family.kinetic(z.t)) * clone.r;
    clone.t += length * h * family.monitor(z.t);
  };
  const auto second_flow = [&](double length) {  // of H-bar_2: moves q, t and r~
    f(clone.q, gradient);
    clone.r += (clone_sign * length * h * family.potential(clone.t)) * gradient;
    z.q += (length * h * family.kinetic(clone.t)) * z.r;
    z.t += length * h * family.monitor(clone.t);
  };
  second_flow(stages.b[0]);
  for (std::size_t i = 0; i < stages.a.size(); ++i) {
    first_flow(stages.a[i]);
    second_flow(stages.b[i + 1]);
  }
}

}  // namespace experiment
