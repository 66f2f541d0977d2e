#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/optim/objective.hpp"

/// @file
/// The Poincare-transformed Bregman Hamiltonian on extended phase space.

namespace avi {

/// A point (q, t, r, r^t) of extended phase space.
struct ExtendedPoint {
  VectorX q;         ///< Position: the argument of the objective.
  double t;          ///< Physical time, q^t in the paper.
  VectorX r;         ///< Momentum.
  double r_t = 0.0;  ///< Momentum conjugate to time.
};

/// The value of \f$\bar H\f$ of a BregmanFamily at z, for an objective f (equations (4.16) and (4.18)):
/// \f$\tfrac12\, kinetic(t)\, |r|^2 + potential(t)\, f(q) + monitor(t)\, r^t\f$.
template <Objective F>
double bregman_energy(const BregmanFamily& family, const F& f, const ExtendedPoint& z) {
  VectorX unused(z.q.size());
  return 0.5 * family.kinetic(z.t) * dot(z.r, z.r) + family.potential(z.t) * f(z.q, unused) +
         family.monitor(z.t) * z.r_t;
}

/// The start of the paper's runs at position q: r and t from `from`, and r^t such that H-bar = 0.
template <Objective F>
ExtendedPoint bregman_start(const BregmanFamily& family, const F& f, const VectorX& q,
                            const BregmanStart& from = {}) {
  family.validate();
  from.validate();
  ExtendedPoint z{.q = q, .t = from.t, .r = VectorX::Constant(q.size(), from.momentum)};
  z.r_t = -bregman_energy(family, f, z) / family.monitor(z.t);
  return z;
}

}  // namespace avi
