#pragma once
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"

#include <cmath>

// A chain of masses and springs of any length.

namespace experiment {

using avi::State, avi::Vector, avi::dynamic, avi::require;

/// n unit masses on a line between walls, coupled by n + 1 springs (Fermi, Pasta, Ulam and Tsingou 1955, the
/// model with a quadratic term in the force). \f[ H(q, p) = \sum_{i=1}^{n} \tfrac12 p_i^2 + \sum_{i=0}^{n}
/// V(q_{i+1} - q_i), \qquad V(x) = \tfrac12 x^2 + \tfrac14 x^3, \qquad q_0 = q_{n+1} = 0. \f] For any n.
struct Chain {
  /// The Hamiltonian.
  auto operator()(const auto& q, const auto& p) const {
    const auto spring = [](const auto& x) { return 0.5 * (x * x) + 0.25 * (x * x * x); };
    auto sum = spring(q[0]) + spring(-q[q.size() - 1]);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      sum += 0.5 * (p[i] * p[i]);
      if (i + 1 < q.size()) sum += spring(q[i + 1] - q[i]);
    }
    return sum;
  }

  /// dH/dq, n entries, supplied for speed.
  template <class S, int n>
  Vector<S, n> d_dq(const Vector<S, n>& q, const Vector<S, n>&) const {
    const auto force = [](const auto& x) { return x + 0.75 * (x * x); };
    Vector<S, n> slope(q.size());
    S left = force(q[0]);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const S right = force(i + 1 < q.size() ? S(q[i + 1] - q[i]) : S(-q[i]));
      slope[i] = left - right;
      left = right;
    }
    return slope;
  }
  /// dH/dp = p.
  template <class S, int n>
  Vector<S, n> d_dp(const Vector<S, n>&, const Vector<S, n>& p) const {
    return p;
  }

  /// Start at rest in the lowest mode, with amplitude 0.3.
  /// @throws std::invalid_argument for fewer than one mass.
  static State<dynamic> plucked(int masses) {
    require(masses >= 1, "Number of masses", masses, "at least 1");
    State<dynamic> z{.q = Vector<double, dynamic>(masses), .p = Vector<double, dynamic>::Zero(masses)};
    for (int i = 0; i < masses; ++i)
      z.q[i] = 0.3 * std::sin(M_PI * (i + 1) / (masses + 1));
    return z;
  }
};

}  // namespace experiment
