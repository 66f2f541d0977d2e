#pragma once
#include "avi/core/vector.hpp"

/// @file
/// Base of problems with unit masses.

namespace avi {

/// Base class of a problem \f$H(q, p) = \tfrac12 p\cdot p + V(q)\f$ in n dimensions. The derived class
/// provides potential(q).
template <class Problem, int n>
struct UnitMass {
  static constexpr int dimension = n;  ///< Entries of q and of p.

  /// Kinetic energy p.p / 2.
  template <class P>
  static auto kinetic(const P& p) {
    return 0.5 * detail::squared_norm(p);
  }

  /// The Hamiltonian T + V.
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return kinetic(p) + static_cast<const Problem&>(*this).potential(q);
  }
};

}  // namespace avi
