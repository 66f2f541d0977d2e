#pragma once
#include "avi/core/require.hpp"
#include "avi/problems/kepler.hpp"

#include <cmath>

// Kepler's problem about an oblate body, in its equatorial plane.

namespace experiment {

using avi::Vector, avi::require, avi::UnitMass;

/// Motion in the equatorial plane of an oblate body: \f$H(q, p) = \tfrac12 |p|^2 - 1/|q| - \varepsilon/(2
/// |q|^3)\f$, with monopole and quadrupole (\f$\varepsilon = J_2 R^2\f$ in units of the orbit). Energy and
/// angular momentum are conserved; the ellipse precesses. Starts are those of Kepler.
class PerturbedKepler : public UnitMass<PerturbedKepler, 2> {
 public:
  /// The problem with this quadrupole. @throws std::invalid_argument unless epsilon is finite and >= 0.
  explicit PerturbedKepler(double epsilon = 0.0) : epsilon_(epsilon) {
    require(std::isfinite(epsilon) && epsilon >= 0.0, "Quadrupole epsilon", epsilon,
            "finite and not negative");
  }

  /// Potential V(q) = -(1 + epsilon / (2 |q|^2)) / |q|.
  auto potential(const auto& q) const {
    using std::sqrt;
    const auto square = q[0] * q[0] + q[1] * q[1];
    return -(1.0 + 0.5 * epsilon_ / square) / sqrt(square);
  }

  /// dV/dq = q (1 + 3 epsilon / (2 |q|^2)) / |q|^3.
  template <class S>
  Vector<S, 2> potential_gradient(const Vector<S, 2>& q) const {
    using std::sqrt;
    const S square = q[0] * q[0] + q[1] * q[1];
    const S u = (1.0 + 1.5 * epsilon_ / square) / (square * sqrt(square));
    return {q[0] * u, q[1] * u};
  }

  /// s grad log(-V) = -s q (1 / |q|^2) (|q|^2 + 3 epsilon / 2) / (|q|^2 + epsilon / 2), which needs no root.
  template <class S>
  Vector<S, 2> log_potential_gradient(const Vector<S, 2>& q, const S& s) const {
    const S square = q[0] * q[0] + q[1] * q[1];
    const S u = -s * (square + 1.5 * epsilon_) / (square * (square + 0.5 * epsilon_));
    return {q[0] * u, q[1] * u};
  }

 private:
  double epsilon_;
};

}  // namespace experiment
