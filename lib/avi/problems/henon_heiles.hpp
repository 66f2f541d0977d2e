#pragma once
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"
#include "avi/problems/unit_mass.hpp"

#include <cmath>

/// @file
/// The galactic model of Henon and Heiles (The applicability of the third integral of motion, 1964).

namespace avi {

/// The Hamiltonian \f$H(q, p) = \tfrac12 (|p|^2 + x^2 + y^2) + x^2 y - \tfrac13 y^3\f$ with q = (x, y). Below
/// the energy 1/6 orbits are bounded; they are mostly regular at 1/12 and mostly chaotic at 1/6.
struct HenonHeiles : UnitMass<HenonHeiles, 2> {
  /// Potential V(q) = (x^2 + y^2) / 2 + x^2 y - y^3 / 3.
  template <class Q>
  static auto potential(const Q& q) {
    return 0.5 * (q[0] * q[0] + q[1] * q[1]) + q[0] * q[0] * q[1] - q[1] * q[1] * q[1] / 3.0;
  }

  /// dV/dq = (x + 2 x y, y + x^2 - y^2).
  template <class S>
  static Vector<S, 2> potential_gradient(const Vector<S, 2>& q) {
    return {q[0] + 2.0 * q[0] * q[1], q[1] + q[0] * q[0] - q[1] * q[1]};
  }

  /// The state on the surface of section x = 0, p_x > 0 with given y and p_y, at the given energy.
  /// @throws std::invalid_argument if there is no such state with a real p_x > 0.
  static State<2> on_section(double energy, double y, double p_y) {
    require_finite("Coordinate y", y);
    require_finite("Momentum p_y", p_y);
    const double twice_kinetic = 2.0 * energy - p_y * p_y - y * y + 2.0 * y * y * y / 3.0;
    require(std::isfinite(energy) && twice_kinetic > 0.0, "Energy", energy,
            "finite and above the least that this point of the section has");
    return {.q = {0.0, y}, .p = {std::sqrt(twice_kinetic), p_y}};
  }
};

}  // namespace avi
