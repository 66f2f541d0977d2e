#pragma once
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"
#include "avi/problems/unit_mass.hpp"

#include <cmath>

/// @file
/// The mathematical pendulum.

namespace avi {

/// The Hamiltonian \f$H(q, p) = \tfrac12 p^2 - \cos q\f$. q is the angle from the rest position; time is in
/// units of sqrt(length / g).
struct Pendulum : UnitMass<Pendulum, 1> {
  /// Potential V(q) = -cos q.
  template <class Q>
  static auto potential(const Q& q) {
    using std::cos;
    return -cos(q[0]);
  }

  /// dV/dq = sin q.
  template <class S>
  static Vector<S, 1> potential_gradient(const Vector<S, 1>& q) {
    using std::sin;
    Vector<S, 1> gradient;
    gradient[0] = sin(q[0]);
    return gradient;
  }

  /// The state at rest at the angle `amplitude`.
  /// @throws std::invalid_argument unless 0 <= amplitude < pi.
  static State<1> start(double amplitude) {
    require(amplitude >= 0.0 && amplitude < M_PI, "Amplitude", amplitude, "in [0, pi)");
    return {.q = Vector<double, 1>(amplitude), .p = Vector<double, 1>(0.0)};
  }

  /// Period 4 K(sin(amplitude / 2)) of the swing, where K is the complete elliptic integral of the first
  /// kind.
  /// @throws std::invalid_argument unless 0 <= amplitude < pi.
  static double period(double amplitude) {
    require(amplitude >= 0.0 && amplitude < M_PI, "Amplitude", amplitude, "in [0, pi)");
    // K(k) = pi / (2 agm(1, sqrt(1 - k^2))); the mean converges quadratically.
    double a = 1.0, b = std::cos(0.5 * amplitude);
    for (int i = 0; i < 60 && std::abs(a - b) > 1e-15 * a; ++i) {
      const double mean = 0.5 * (a + b);
      b = std::sqrt(a * b);
      a = mean;
    }
    return 2.0 * M_PI / a;
  }
};

}  // namespace avi
