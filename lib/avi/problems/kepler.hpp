#pragma once
#include "avi/core/power.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"
#include "avi/problems/unit_mass.hpp"

#include <cmath>

/// @file
/// Kepler's planar two-body problem, in relative coordinates, with unit masses and period 2 pi.

namespace avi {

/// Kepler's Hamiltonian \f$H(q, p) = \tfrac12 |p|^2 - 1/|q|\f$, with q, p in \f$R^2\f$ (Section 3.3 of the
/// paper).
struct Kepler : UnitMass<Kepler, 2> {
  /// Potential V(q) = -1 / |q|.
  template <class Q>
  static auto potential(const Q& q) {
    using std::sqrt;
    return -1.0 / sqrt(q[0] * q[0] + q[1] * q[1]);
  }

  /// dV/dq = q / |q|^3.
  template <class S>
  static Vector<S, 2> potential_gradient(const Vector<S, 2>& q) {
    const S u = power(q[0] * q[0] + q[1] * q[1], -1.5);
    return {q[0] * u, q[1] * u};
  }

  /// dH/dq = q / |q|^3, supplied for speed.
  template <class S>
  Vector<S, 2> d_dq(const Vector<S, 2>& q, const Vector<S, 2>&) const {
    return potential_gradient(q);
  }
  /// dH/dp = p, supplied for speed.
  template <class S>
  Vector<S, 2> d_dp(const Vector<S, 2>&, const Vector<S, 2>& p) const {
    return p;
  }

  /// s grad log(-V) = -s q / |q|^2, which needs no root.
  template <class S>
  static Vector<S, 2> log_potential_gradient(const Vector<S, 2>& q, const S& s) {
    const S u = -s / (q[0] * q[0] + q[1] * q[1]);
    return {q[0] * u, q[1] * u};
  }

  /// Angular momentum q_1 p_2 - q_2 p_1, conserved.
  static double angular_momentum(const State<2>& z) { return z.q[0] * z.p[1] - z.q[1] * z.p[0]; }

  /// The state at the pericentre of the orbit with semi-major axis 1: q = (1 - e, 0), p = (0, sqrt((1 + e) /
  /// (1 - e))).
  /// @throws std::invalid_argument unless 0 <= e < 1.
  static State<2> pericentre(double e) {
    require(e >= 0.0 && e < 1.0, "Eccentricity", e, "in [0, 1)");
    return {.q = {1.0 - e, 0.0}, .p = {0.0, std::sqrt((1.0 + e) / (1.0 - e))}};
  }

  /// The exact state at time t on the orbit that starts at pericentre(e). Kepler's equation \f$E - e \sin E =
  /// t\f$ is solved by Newton's method with bisection as a safeguard.
  /// @throws std::invalid_argument unless 0 <= e < 1 and t is finite.
  static State<2> exact(double e, double t) {
    require(e >= 0.0 && e < 1.0, "Eccentricity", e, "in [0, 1)");
    require_finite("Time", t);
    const double mean = std::remainder(t, 2.0 * M_PI);
    double low = mean - e, high = mean + e, anomaly = mean;
    for (int i = 0; i < 200; ++i) {
      const double defect = anomaly - e * std::sin(anomaly) - mean;
      (defect > 0.0 ? high : low) = anomaly;
      double next = anomaly - defect / (1.0 - e * std::cos(anomaly));
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (next == anomaly) break;
      anomaly = next;
    }
    const double c = std::cos(anomaly), s = std::sin(anomaly), b = std::sqrt((1.0 - e) * (1.0 + e));
    const double rate = 1.0 / (1.0 - e * c);
    return {.q = {c - e, b * s}, .p = {-s * rate, b * c * rate}, .t = t};
  }
};

}  // namespace avi
