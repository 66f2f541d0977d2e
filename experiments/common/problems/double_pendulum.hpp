#pragma once
#include "avi/core/state.hpp"

#include <cmath>

// Two pendulums, one hanging from the other.

namespace experiment {

using avi::State;

/// Two unit masses on rods of unit length in unit gravity; q are the angles from the downward vertical. H is
/// not separable, because the kinetic energy depends on q (Landau and Lifshitz, Mechanics, Section 5). \f[
/// H(q, p) = \frac{p_1^2 + 2 p_2^2 - 2 p_1 p_2 \cos(q_1 - q_2)}{2\,(1 + \sin^2(q_1 - q_2))} - 2 \cos q_1 -
/// \cos q_2 \f]
struct DoublePendulum {
  static constexpr int dimension = 2;  ///< Two angles.

  /// The Hamiltonian.
  auto operator()(const auto& q, const auto& p) const {
    using std::cos, std::sin;
    const auto between = q[0] - q[1];
    const auto s = sin(between);
    const auto square = p[0] * p[0] + 2.0 * (p[1] * p[1]) - 2.0 * (p[0] * p[1]) * cos(between);
    return 0.5 * square / (1.0 + s * s) - 2.0 * cos(q[0]) - cos(q[1]);
  }

  /// Start at rest at these angles; from (pi/2, pi/2) the motion is chaotic.
  static State<2> released(double first, double second) { return {.q = {first, second}, .p = {0.0, 0.0}}; }
};

}  // namespace experiment
