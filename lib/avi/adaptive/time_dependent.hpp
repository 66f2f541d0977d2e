#pragma once
#include "avi/adaptive/poincare.hpp"

#include <utility>

/// @file
/// The Poincare transformation of a Hamiltonian that depends on time.

namespace avi {

/// \f$\bar H(\bar q, \bar p) = g(q, t, p)\, (H(q, t, p) + p^t)\f$ with \f$\bar q = (q, t)\f$,
/// \f$\bar p = (p, p^t)\f$: an autonomous Hamiltonian of dimension n + 1 (equation (3.9) of the paper). H and
/// g are called with vectors of n entries and the scalar t.
template <int n, class H, class G>
struct ExtendedHamiltonian {
  H hamiltonian;  ///< H(q, t, p).
  G monitor;      ///< g(q, t, p) > 0.

  /// H-bar at (q, t), (p, p^t), n + 1 entries each.
  template <class S>
  S operator()(const Vector<S, n + 1>& q, const Vector<S, n + 1>& p) const {
    const Vector<S, n> x = q.template head<n>(), y = p.template head<n>();
    return monitor(x, q[n], y) * (hamiltonian(x, q[n], y) + p[n]);
  }
};

/// g(q, t, p) = 1: no adaptivity, time is only made a coordinate.
struct UnitInTime {
  /// 1, whatever the arguments.
  template <class Q, class S, class P>
  S operator()(const Q&, const S&, const P&) const {
    return S(1.0);
  }
};

/// The extended problem, of dimension n + 1; all of its n + 1 momenta evolve, p^t too.
template <int n, class H, class G>
class TimeDependent : public Poincare<n + 1, ExtendedHamiltonian<n, H, G>> {
 public:
  static_assert(n != dynamic, "A time-dependent problem needs its dimension at compile time.");
  /// The coordinate that is physical time: states of this problem carry it in q and in t alike.
  static constexpr int clock = n;

  /// The problem of H(q, t, p) with monitor g(q, t, p); time_dependent() finds the types.
  TimeDependent(H hamiltonian, G monitor)
      : Poincare<n + 1, ExtendedHamiltonian<n, H, G>>({std::move(hamiltonian), std::move(monitor)}, Unit{},
                                                      0.0) {}
};

/// The extended problem of H(q, t, p) with monitor g(q, t, p).
template <int n, class H, class G = UnitInTime>
TimeDependent<n, H, G> time_dependent(H hamiltonian, G monitor = {}) {
  return {std::move(hamiltonian), std::move(monitor)};
}

/// The state (q, t), (p, p^t) of the extended problem at time z.t, with p^t = -H(q, t, p).
template <int n, class H, class G>
State<n + 1> extended(const TimeDependent<n, H, G>& problem, const State<n>& z) {
  State<n + 1> bar;
  bar.q << z.q, z.t;
  bar.p << z.p, -problem.hamiltonian().hamiltonian(z.q, z.t, z.p);
  bar.t = z.t;
  return bar;
}

/// The state (q, p) at time t of an extended one.
template <int m>
State<m - 1> reduced(const State<m>& bar) {
  return {.q = bar.q.template head<m - 1>(), .p = bar.p.template head<m - 1>(), .t = bar.q[m - 1]};
}

}  // namespace avi
