#pragma once
#include "avi/autodiff/hamiltonian.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"

#include <concepts>
#include <utility>

/// @file
/// The Poincare transformation: constant steps in fictive time tau, variable ones in physical time t.

namespace avi {

/// Monitor of a method without adaptivity: g = 1, so that fictive and physical time agree.
struct Unit {
  /// 1, whatever the position.
  template <class Q>
  double operator()(const Q&) const {
    return 1.0;
  }
};

/// Which terms of Hamilton's equations of H-bar make the Taylor expansion.
enum class Field {
  full,      ///< All of them.
  on_level,  ///< With H + p^t = H-bar / g, where H-bar is the constant that it is along the flow: the same
             ///< flow without the work of evaluating H on it.
  on_shell   ///< With H + p^t = 0 inserted, which holds along the solution: the terms (H + p^t) grad g are
             ///< left out.
};

namespace detail {
/// A Hamiltonian may say its dimension.
template <class H, int n>
inline constexpr bool dimension_fits = true;
template <class H, int n>
requires requires { H::dimension; }
inline constexpr bool dimension_fits<H, n> = H::dimension == n || H::dimension == dynamic || n == dynamic;
}  // namespace detail

/// The Poincare transformation of an autonomous Hamiltonian H with monitor g = dt/dtau > 0 (equation (3.2) of
/// the paper). \f[ \bar H(\bar q, \bar p) = g(q, p)\, (H(q, p) + p^t), \quad \bar q = (q, t), \quad
/// \bar p = (p, p^t). \f] Its equations, with a prime for the derivative in fictive time, are (Section 3.2)
/// \f[ q' = (H + p^t)\, \partial g/\partial p + g\, \partial H/\partial p, \quad
/// p' = -(H + p^t)\, \partial g/\partial q - g\, \partial H/\partial q, \quad t' = g, \f] and p^t is
/// constant; only q and p are unknowns, t follows by summation. A monitor is called as g(q) or as g(q, p),
/// with vectors of any scalar; the first kind is known not to depend on p, and then nothing is spent on
/// dg/dp.
template <int n, class H, class G = Unit>
class Poincare {
  static_assert(std::invocable<const H&, const Vector<double, n>&, const Vector<double, n>&>,
                "The Hamiltonian must be callable as H(q, p) with vectors of n entries.");
  static_assert(std::invocable<const G&, const Vector<double, n>&> ||
                    std::invocable<const G&, const Vector<double, n>&, const Vector<double, n>&>,
                "The monitor must be callable as g(q) or g(q, p) with vectors of n entries.");
  static_assert(detail::dimension_fits<H, n>, "The Hamiltonian is of another dimension than the state.");

 public:
  static constexpr int dimension = n;  ///< Degrees of freedom, or avi::dynamic.
  /// The monitor is called as g(q).
  static constexpr bool position_monitor = std::invocable<const G&, const Vector<double, n>&>;
  /// The monitor is avi::Unit, g = 1.
  static constexpr bool unit = std::same_as<G, Unit>;

  /// The problem of H with monitor g; poincare() finds the types and p^t.
  /// @param energy_momentum p^t, minus the energy of the orbit @param size n, where it is avi::dynamic
  /// @throws std::invalid_argument unless p^t is finite and the size agrees with n.
  Poincare(H hamiltonian, G monitor, double energy_momentum, Eigen::Index size = n)
      : h_(std::move(hamiltonian)), g_(std::move(monitor)), pt_(require_finite("p^t", energy_momentum)),
        size_(size) {
    require(n == dynamic ? size >= 1 : size == n, "Dimension of the problem", size,
            n == dynamic ? "at least " : "", n == dynamic ? 1 : n);
  }

  /// n.
  [[nodiscard]] Eigen::Index size() const {
    if constexpr (n == dynamic)
      return size_;
    else
      return n;
  }
  [[nodiscard]] double energy_momentum() const { return pt_; }  ///< p^t, constant along an orbit.
  [[nodiscard]] const H& hamiltonian() const { return h_; }     ///< H.
  [[nodiscard]] const G& monitor() const { return g_; }         ///< g.

  /// g(q, p) at any scalar.
  template <class S>
  [[nodiscard]] auto rate(const Vector<S, n>& q, const Vector<S, n>& p) const {
    if constexpr (position_monitor)
      return g_(q);
    else
      return g_(q, p);
  }

  /// Physical time from the coordinates (q, t) of a state, or of the change in a step: here t itself, the
  /// integral of g. Every method sets the time of a state through this function.
  [[nodiscard]] double clock(const Vector<double, n>&, double t) const { return t; }

  /// g(q, p) (H(q, p) + p^t) at any scalar.
  template <class S>
  [[nodiscard]] S transformed(const Vector<S, n>& q, const Vector<S, n>& p, const S& pt) const {
    return rate(q, p) * (h_(q, p) + pt);
  }
  /// The same at a state, zero along the exact solution.
  [[nodiscard]] double transformed(const State<n>& z) const { return transformed(z.q, z.p, pt_); }

  /// Hamilton's equations at any scalar: dq = q', dp = -p', dt = t'. Without `forces`, dp is neither needed
  /// nor computed; its operations come last, so that leaving them out keeps the sequence of the others.
  /// @param pt p^t, or the constant H-bar of Field::on_level
  template <Field form, class S>
  void field(const Vector<S, n>& q, const Vector<S, n>& p, const S& pt, Vector<S, n>& dq, Vector<S, n>& dp,
             S& dt, bool forces = true) const {
    constexpr bool shell_terms = form != Field::on_shell && !unit;
    if constexpr (!shell_terms) {
      const auto g = rate(q, p);
      dt = g;
      const Vector<S, n> velocity = d_dp(h_, q, p);
      for (Eigen::Index i = 0; i < size(); ++i)
        dq[i] = g * velocity[i];
      if (!forces) return;
      const Vector<S, n> force = d_dq(h_, q, p);
      for (Eigen::Index i = 0; i < size(); ++i)
        dp[i] = g * force[i];
    } else {
      Partials<S, n> g;  // with derivatives by q, or by p where it depends on p
      if constexpr (position_monitor)
        g = value_and_gradient(g_, q);
      else
        g = value_and_d_dp(g_, q, p);
      dt = g.value;
      Partials<S, n> energy;  // with derivatives by p, and its value where that is needed
      if constexpr (form == Field::on_level)
        energy = {S(0.0), d_dp(h_, q, p)};
      else
        energy = value_and_d_dp(h_, q, p);
      const auto defect = [&]() -> S { return form == Field::on_level ? pt / g.value : energy.value + pt; };
      for (int i = 0; i < n; ++i) {
        dq[i] = g.value * energy.partial(i);
        if constexpr (!position_monitor) dq[i] += defect() * g.partial(i);
      }
      if (!forces) return;
      const S across = defect();
      const Vector<S, n> force = d_dq(h_, q, p);
      if constexpr (!position_monitor) g = {g.value, d_dq(g_, q, p)};
      for (int i = 0; i < n; ++i)
        dp[i] = g.value * force[i] + across * g.partial(i);
    }
  }

  /// Integrand of the printed action, \f$p\cdot q' + p^t t' - \bar H\f$ with q', t' from the same field:
  /// \f$g\,(p\cdot\partial H/\partial p - H)\f$, and in the full field
  /// \f$(H + p^t)\, p\cdot\partial g/\partial p\f$ more.
  template <Field form, class S>
  [[nodiscard]] S action_rate(const Vector<S, n>& q, const Vector<S, n>& p, const S& pt) const {
    const auto [energy, work] = value_and_work(h_, q, p);
    if constexpr (position_monitor || form == Field::on_shell) {
      return rate(q, p) * (work - energy);
    } else {
      const auto [g, g_work] = value_and_work(g_, q, p);
      return g * (work - energy) + (energy + pt) * g_work;
    }
  }

 private:
  H h_;
  G g_;
  double pt_;
  Eigen::Index size_;
};

/// The transformed problem of an orbit through `start`: \f$p^t = -H(q(0), p(0))\f$, the paper's common choice
/// (Section 3.1). @throws std::invalid_argument where the start or H there is not finite, q and p are of
/// different size or empty, or H or g reads an entry that they do not have.
template <int n, class H, class G = Unit>
Poincare<n, H, G> poincare(H hamiltonian, const State<n>& start, G monitor = {}) {
  require_start(start);
  const detail::Checked<double, n> q(start.q), p(start.p);
  const double pt = -require_finite("H at the start", static_cast<double>(hamiltonian(q, p)));
  if constexpr (std::invocable<const G&, const detail::Checked<double, n>&>)
    (void)std::as_const(monitor)(q);
  else
    (void)std::as_const(monitor)(q, p);
  return {std::move(hamiltonian), std::move(monitor), pt, start.q.size()};
}

}  // namespace avi
