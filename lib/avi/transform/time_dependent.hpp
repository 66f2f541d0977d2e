#pragma once
#include "avi/transform/poincare.hpp"

#include <utility>

/// @file
/// The Poincare transformation of a Hamiltonian that depends on time.

namespace avi {

/// Dimension of the extended phase space: n + 1.
constexpr int extended_dimension(int n) { return n == dynamic ? dynamic : n + 1; }

namespace detail {
/// Calls a monitor g(q, t, p), g(q, p) or g(q).
template <class G, class Q, class S, class P>
auto monitor_at(const G& g, const Q& q, const S& t, const P& p) {
  if constexpr (std::invocable<const G&, const Q&, const S&, const P&>)
    return g(q, t, p);
  else if constexpr (std::invocable<const G&, const Q&, const P&>)
    return g(q, p);
  else
    return g(q);
}
}  // namespace detail

/// The extended Hamiltonian \f$\bar H(\bar q, \bar p) = g(q, t, p)\, (H(q, t, p) + p^t)\f$ with \f$\bar q =
/// (q, t)\f$, \f$\bar p = (p, p^t)\f$, which is autonomous and has dimension n + 1 (equation (3.9) of the
/// paper). H and g are called with vectors of n entries and the scalar t. A monitor that does not depend on
/// time may also be called as g(q) or g(q, p). If n is known only at run time, each call copies q and p.
template <int n, class H, class G>
struct ExtendedHamiltonian {
  H hamiltonian;  ///< H(q, t, p).
  G monitor;      ///< g(q, t, p), g(q, p) or g(q), > 0.

  /// H-bar at the point (q, t), (p, p^t), of n + 1 entries each.
  template <class S>
  S operator()(const Vector<S, extended_dimension(n)>& q, const Vector<S, extended_dimension(n)>& p) const {
    const Eigen::Index last = q.size() - 1;
    const Vector<S, n> x = q.template head<n>(last), y = p.template head<n>(last);
    return detail::monitor_at(monitor, x, q[last], y) * (hamiltonian(x, q[last], y) + p[last]);
  }
};

/// The extended problem, of dimension n + 1, for a Hamiltonian that depends on time. All n + 1 momenta
/// evolve, including p^t.
template <int n, class H, class G>
class TimeDependent : public Poincare<extended_dimension(n), ExtendedHamiltonian<n, H, G>> {
  using Vec = Vector<double, n>;
  static_assert(std::invocable<const H&, const Vec&, const double&, const Vec&>,
                "The Hamiltonian must be callable as H(q, t, p) with vectors of n entries.");
  static_assert(std::invocable<const G&, const Vec&> || std::invocable<const G&, const Vec&, const Vec&> ||
                    std::invocable<const G&, const Vec&, const double&, const Vec&>,
                "The monitor must be callable as g(q), g(q, p) or g(q, t, p) with vectors of n entries.");

 public:
  /// The problem of H(q, t, p) with monitor g(q, t, p); time_dependent() deduces the types.
  /// @param size n, where it is avi::dynamic
  /// @throws std::invalid_argument unless the size agrees with n.
  TimeDependent(H hamiltonian, G monitor, Eigen::Index size = n)
      : Poincare<extended_dimension(n), ExtendedHamiltonian<n, H, G>>(
            {std::move(hamiltonian), std::move(monitor)}, Unit{}, 0.0, size + 1) {}

  /// Physical time, which is the last coordinate: states of this problem hold it both in q and in t. (With
  /// the monitor Unit, the clock of Poincare would give fictive time.)
  [[nodiscard]] double clock(const Vector<double, extended_dimension(n)>& q, double) const {
    return q[q.size() - 1];
  }
  /// Sets both times of a state that already agree with t to rounding.
  void set_time(State<extended_dimension(n)>& z, double t) const { z.q[z.q.size() - 1] = z.t = t; }
};

/// The extended problem of H(q, t, p), with a monitor g(q, t, p), g(q, p) or g(q). Without one, time is
/// merely made a coordinate. From `start` only n is taken; extended(problem, start) is the state to begin
/// with.
/// @throws std::invalid_argument if q and p are empty or of different size.
template <int n, class H, class G = Unit>
TimeDependent<n, H, G> time_dependent(H hamiltonian, const State<n>& start, G monitor = {}) {
  require_dimension(start);
  return {std::move(hamiltonian), std::move(monitor), start.q.size()};
}

/// The state (q, t), (p, p^t) of the extended problem at time z.t, with p^t = -H(q, t, p).
/// @throws std::invalid_argument if z, or H there, is not finite, q and p are empty or of different size, or
/// H reads an entry beyond them.
template <int n, class H, class G>
State<extended_dimension(n)> extended(const TimeDependent<n, H, G>& problem, const State<n>& z) {
  require_start(z);
  const detail::Checked<double, n> q(z.q), p(z.p);
  // Evaluated first, because an exception thrown inside Eigen's comma initialiser would end the program.
  const double energy =
      require_finite("H at the start", static_cast<double>(problem.hamiltonian().hamiltonian(q, z.t, p)));
  State<extended_dimension(n)> bar{.q = Vector<double, extended_dimension(n)>(z.q.size() + 1),
                                   .p = Vector<double, extended_dimension(n)>(z.q.size() + 1)};
  bar.q << z.q, z.t;
  bar.p << z.p, -energy;
  bar.t = z.t;
  return bar;
}

/// The state (q, p) at time t that corresponds to a state of the extended problem.
template <int m>
auto reduced(const State<m>& bar) {
  constexpr int n = m == dynamic ? dynamic : m - 1;
  const Eigen::Index last = bar.q.size() - 1;
  return State<n>{.q = bar.q.template head<n>(last), .p = bar.p.template head<n>(last), .t = bar.q[last]};
}

}  // namespace avi
