#pragma once
#include "avi/core/hamiltonian.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"

#include <concepts>
#include <utility>

/// @file
/// The Poincare transformation: constant steps in fictive time tau, variable ones in physical time t.

namespace avi {

/// Monitor of a method without adaptivity: g = 1, so that fictive and physical time agree.
struct Unit {
  template <class Q>
  double operator()(const Q&) const {
    return 1.0;
  }
};

/// Which terms of Hamilton's equations of H-bar make the Taylor expansion.
enum class Field {
  full,     ///< All of them.
  on_shell  ///< With H + p^t = 0 inserted, which holds along the solution: the terms (H + p^t) grad g are
            ///< left out.
};

/// H-bar(q-bar, p-bar) = g(q, p) (H(q, p) + p^t), the Poincare transformation of an autonomous Hamiltonian H
/// with monitor g = dt/dtau > 0 (equation (TransformedH) of the paper).
///
/// Its equations are q' = (H + p^t) dg/dp + g dH/dp, p' = -(H + p^t) dg/dq - g dH/dq, t' = g, and p^t is
/// constant; only q and p are unknowns, t follows by summation. A monitor is called as g(q) or as g(q, p),
/// with vectors of any scalar; the first kind is known not to depend on p, and then nothing is spent on
/// dg/dp.
template <int n, class H, class G = Unit>
class Poincare {
 public:
  static constexpr int dimension = n;
  /// g(q) alone.
  static constexpr bool position_monitor = std::invocable<const G&, const Vector<double, n>&>;
  /// g = 1.
  static constexpr bool unit = std::same_as<G, Unit>;

  /// @param energy_momentum p^t, minus the energy of the orbit.
  Poincare(H hamiltonian, G monitor, double energy_momentum)
      : h_(std::move(hamiltonian)), g_(std::move(monitor)), pt_(require_finite("p^t", energy_momentum)) {}

  [[nodiscard]] double energy_momentum() const { return pt_; }
  [[nodiscard]] const H& hamiltonian() const { return h_; }
  [[nodiscard]] const G& monitor() const { return g_; }

  /// g at any scalar.
  template <class S>
  [[nodiscard]] auto rate(const Vector<S, n>& q, const Vector<S, n>& p) const {
    if constexpr (position_monitor)
      return g_(q);
    else
      return g_(q, p);
  }

  /// g(q, p) (H(q, p) + p^t), zero along the exact solution.
  [[nodiscard]] double transformed(const State<n>& z) const { return rate(z.q, z.p) * (h_(z.q, z.p) + pt_); }

  /// Hamilton's equations at any scalar: dq = q', dp = -p', dt = t'. With `forces` false, dp is neither
  /// needed nor computed; its operations come last, so that leaving them out keeps the sequence of the
  /// others.
  template <Field form, bool forces, class S>
  void field(const Vector<S, n>& q, const Vector<S, n>& p, const S& pt, Vector<S, n>& dq, Vector<S, n>& dp,
             S& dt) const {
    const auto g = rate(q, p);
    dt = g;
    const Vector<S, n> velocity = d_dp(h_, q, p);
    for (int i = 0; i < n; ++i)
      dq[i] = g * velocity[i];
    constexpr bool shell_terms = form == Field::full && !unit;
    S defect(0.0);
    if constexpr (shell_terms) defect = h_(q, p) + pt;
    if constexpr (shell_terms && !position_monitor) {
      const Vector<Partials<S, n>, n> at_q = q.template cast<Partials<S, n>>();
      const Vector<S, n> slope = gradient([&](const auto& x) { return g_(at_q, x); }, p);
      for (int i = 0; i < n; ++i)
        dq[i] += defect * slope[i];
    }
    if constexpr (forces) {
      const Vector<S, n> force = d_dq(h_, q, p);
      for (int i = 0; i < n; ++i)
        dp[i] = g * force[i];
      if constexpr (shell_terms) {
        const Vector<S, n> slope = monitor_d_dq(q, p);
        for (int i = 0; i < n; ++i)
          dp[i] += defect * slope[i];
      }
    }
  }

  /// Integrand of the action, p . q' + p^t t' - H-bar with q', t' from the same field: g (p . dH/dp - H), and
  /// in the full field (H + p^t) p . dg/dp more.
  template <Field form, class S>
  [[nodiscard]] S action_rate(const Vector<S, n>& q, const Vector<S, n>& p, const S& pt) const {
    S energy, work(0.0);
    if constexpr (SuppliesGradient<H, S, n>) {
      energy = h_(q, p);
      const Vector<S, n> velocity = h_.d_dp(q, p);
      for (int i = 0; i < n; ++i)
        work += p[i] * velocity[i];
    } else {
      const Vector<Partials<S, 1>, n> at_q = q.template cast<Partials<S, 1>>();
      const auto both = along_momentum([&](const auto& x) { return h_(at_q, x); }, p);
      energy = both.value;
      work = both.partial(0);
    }
    if constexpr (position_monitor || form == Field::on_shell) {
      return rate(q, p) * (work - energy);
    } else {
      const Vector<Partials<S, 1>, n> at_q = q.template cast<Partials<S, 1>>();
      const auto g = along_momentum([&](const auto& x) { return g_(at_q, x); }, p);
      return g.value * (work - energy) + (energy + pt) * g.partial(0);
    }
  }

  /// dg/dq at any scalar.
  template <class S>
  [[nodiscard]] Vector<S, n> monitor_d_dq(const Vector<S, n>& q, const Vector<S, n>& p) const {
    if constexpr (position_monitor) {
      return gradient([&](const auto& x) { return g_(x); }, q);
    } else {
      const Vector<Partials<S, n>, n> at_p = p.template cast<Partials<S, n>>();
      return gradient([&](const auto& x) { return g_(x, at_p); }, q);
    }
  }

 private:
  H h_;
  G g_;
  double pt_;
};

/// The transformed problem of an orbit through `start`: p^t = -H(q(0), p(0)), the paper's common choice.
template <int n, class H, class G = Unit>
Poincare<n, H, G> poincare(H hamiltonian, const State<n>& start, G monitor = {}) {
  const double pt = -static_cast<double>(hamiltonian(start.q, start.p));
  return {std::move(hamiltonian), std::move(monitor), pt};
}

}  // namespace avi
