#pragma once
#include "avi/core/state.hpp"

#include <cmath>

// The position of a body along its Kepler orbit.

namespace experiment {

/// Mean longitude in Kepler's problem with unit masses, counted in the direction of motion. It is the polar
/// angle of q minus nu - E and e sin E, with e cos E = 1 - |q| / a, e sin E = q.p / sqrt(a), a = -1 / (2 H)
/// and tan((nu - E)/2) = beta sin E / (1 - beta cos E), beta = e / (1 + sqrt(1 - e^2)). It is smooth also
/// near circular orbits, where the anomalies are undefined. NaN for H >= 0.
inline double mean_longitude(const avi::State<2>& z) {
  const double radius = z.q.norm(), a = 1.0 / (2.0 / radius - z.p.squaredNorm());
  const double e_sine = z.q.dot(z.p) / std::sqrt(a), e_cosine = 1.0 - radius / a;
  const double L = z.q[0] * z.p[1] - z.q[1] * z.p[0];
  const double beta_over_e = 1.0 / (1.0 + std::abs(L) / std::sqrt(a));
  const double equation = 2.0 * std::atan2(beta_over_e * e_sine, 1.0 - beta_over_e * e_cosine);
  return std::copysign(1.0, L) * std::atan2(z.q[1], z.q[0]) - equation - e_sine;
}

/// Mean longitude of z minus that of the exact orbit through `start` at the same time, in [-pi, pi].
inline double phase_error(const avi::State<2>& start, const avi::State<2>& z) {
  const double a = 1.0 / (2.0 / start.q.norm() - start.p.squaredNorm());
  return std::remainder(mean_longitude(z) - mean_longitude(start) - (z.t - start.t) * std::pow(a, -1.5),
                        2.0 * M_PI);
}

}  // namespace experiment
