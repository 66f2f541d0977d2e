#pragma once
#include "avi/core/require.hpp"
#include "avi/core/vector.hpp"

#include <cmath>

/// @file
/// A check of problems that are taken to have masses of 1.

namespace avi::detail {

/// Requires that T(p) is half the square of p, as far as one point shows, where a problem gives no velocity:
/// its drift would be wrong otherwise. @param kinetic T, as a function of p @param rounding of T
template <int n, class Kinetic>
void require_unit_masses(const Kinetic& kinetic, double rounding = 0.0) {
  if constexpr (n != dynamic) {
    Vector<double, n> p;
    for (int i = 0; i < n; ++i)
      p[i] = 1.0 + 0.125 * i;
    const double energy = kinetic(p), expected = 0.5 * p.squaredNorm();
    require(std::abs(energy - expected) <= 1e-8 * expected + rounding,
            "Kinetic energy at p = (1, 1.125, 1.25 ...)", energy, "half the square of p, ", expected,
            ", where the problem has no velocity(p)");
  }
}

}  // namespace avi::detail
