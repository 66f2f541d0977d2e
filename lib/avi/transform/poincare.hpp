#pragma once
#include "avi/autodiff/hamiltonian.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"

#include <concepts>
#include <utility>

/// @file
/// The Poincare transformation: constant steps in fictive time tau are variable steps in physical time t.

namespace avi {

/// The monitor g = 1 of a method without adaptivity: fictive and physical time agree.
struct Unit {
  /// 1 at every position.
  template <class Q>
  double operator()(const Q&) const {
    return 1.0;
  }
};

namespace detail {
/// False where a Hamiltonian declares another dimension than n.
template <class H, int n>
inline constexpr bool dimension_fits = true;
template <class H, int n>
requires requires { H::dimension; }
inline constexpr bool dimension_fits<H, n> = H::dimension == n || H::dimension == dynamic || n == dynamic;
}  // namespace detail

/// The Poincare transformation of an autonomous Hamiltonian H with monitor g = dt/dtau > 0 (equation (3.2) of
/// the paper). \f[ \bar H(\bar q, \bar p) = g(q, p)\, (H(q, p) + p^t), \quad \bar q = (q, t), \quad \bar p =
/// (p, p^t). \f] Its equations, with a prime for the derivative by fictive time, are (Section 3.2) \f[ q' =
/// (H + p^t)\, \partial g/\partial p + g\, \partial H/\partial p, \quad p' = -(H + p^t)\, \partial g/\partial
/// q - g\, \partial H/\partial q, \quad t' = g, \f] and p^t is constant. So only q and p are unknowns, and t
/// is summed up. A monitor is called as g(q) or g(q, p), with vectors of any scalar. For a monitor g(q),
/// dg/dp is not computed.
///
/// The monitor must stay away from zero on the whole orbit. In fictive time no orbit reaches a place where it
/// vanishes. A numerical solution preserves \f$\bar H\f$ up to some small \f$\delta\f$, so near such a place
/// the energy is off by \f$\delta/g\f$, until the motion turns back. Every g on the way may be positive, and
/// every step may end as ok. The error shows in the energy during the run, but not necessarily at its end,
/// where g may be large again.
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

  /// The problem of H with monitor g; poincare() deduces the types and finds p^t.
  /// @param energy_momentum p^t, minus the energy of the orbit @param size n, where it is avi::dynamic
  /// @throws std::invalid_argument unless p^t is finite and the size agrees with n.
  Poincare(H hamiltonian, G monitor, double energy_momentum, Eigen::Index size = n)
      : h_(std::move(hamiltonian)), g_(std::move(monitor)), pt_(require_finite("p^t", energy_momentum)),
        size_(size) {
    require(n == dynamic ? size >= 1 : size == n, "Dimension of the problem", size,
            n == dynamic ? "at least " : "", n == dynamic ? 1 : n);
  }

  /// The number n of degrees of freedom.
  [[nodiscard]] Eigen::Index size() const {
    if constexpr (n == dynamic)
      return size_;
    else
      return n;
  }
  [[nodiscard]] double energy_momentum() const { return pt_; }  ///< p^t, constant along an orbit.
  [[nodiscard]] const H& hamiltonian() const { return h_; }     ///< H.
  [[nodiscard]] const G& monitor() const { return g_; }         ///< g.

  /// g(q, p) for any scalar.
  template <class S>
  [[nodiscard]] auto rate(const Vector<S, n>& q, const Vector<S, n>& p) const {
    if constexpr (position_monitor)
      return g_(q);
    else
      return g_(q, p);
  }

  /// Physical time, from the coordinates (q, t) of a state or from their change in a step. Here it is t
  /// itself, the integral of g. Every method sets the time of a state by this function.
  [[nodiscard]] double clock(const Vector<double, n>&, double t) const { return t; }

  /// H-bar = g(q, p) (H(q, p) + p^t) for any scalar.
  template <class S>
  [[nodiscard]] S transformed(const Vector<S, n>& q, const Vector<S, n>& p, const S& pt) const {
    return rate(q, p) * (h_(q, p) + pt);
  }
  /// H-bar at a state; zero along the exact solution.
  [[nodiscard]] double transformed(const State<n>& z) const { return transformed(z.q, z.p, pt_); }

  /// Hamilton's equations of H-bar for any scalar: dq = q', dp = -p', dt = t'. For n known at compile time,
  /// unless H supplies its gradient. @param pt p^t
  template <class S>
  void field(const Vector<S, n>& q, const Vector<S, n>& p, const S& pt, Vector<S, n>& dq, Vector<S, n>& dp,
             S& dt) const {
    field_with(q, p, dq, dp, dt, [&](const S& energy, const S&) -> S { return energy + pt; });
  }
  /// The same field with H + p^t replaced by H-bar / g, so that the value of H is not needed. H-bar is
  /// constant along the flow; `level` is its value.
  template <class S>
  void field_on_level(const Vector<S, n>& q, const Vector<S, n>& p, const S& level, Vector<S, n>& dq,
                      Vector<S, n>& dp, S& dt) const {
    field_with(q, p, dq, dp, dt, [&](const S&, const S& g) -> S { return level / g; });
  }
  /// The same field with H + p^t = 0, which holds along the solution: the field of H times g.
  template <class S>
  void field_on_shell(const Vector<S, n>& q, const Vector<S, n>& p, Vector<S, n>& dq, Vector<S, n>& dp,
                      S& dt) const {
    const auto g = rate(q, p);
    dt = g;
    const Vector<S, n> velocity = d_dp(h_, q, p), force = d_dq(h_, q, p);
    for (Eigen::Index i = 0; i < size(); ++i) {
      dq[i] = g * velocity[i];
      dp[i] = g * force[i];
    }
  }

 private:
  /// Hamilton's equations, where defect(H, g) returns H + p^t.
  template <class S, class Defect>
  void field_with(const Vector<S, n>& q, const Vector<S, n>& p, Vector<S, n>& dq, Vector<S, n>& dp, S& dt,
                  const Defect& defect) const {
    if constexpr (unit) {
      field_on_shell(q, p, dq, dp, dt);
    } else {
      Partials<S, n> g;  // with derivatives by q, or by p if g depends on p
      if constexpr (position_monitor)
        g = value_and_gradient(g_, q);
      else
        g = value_and_d_dp(g_, q, p);
      dt = g.value;
      const Partials<S, n> energy = value_and_d_dp(h_, q, p);
      const S across = defect(energy.value, g.value);
      for (int i = 0; i < n; ++i) {
        dq[i] = g.value * energy.partial(i);
        if constexpr (!position_monitor) dq[i] += across * g.partial(i);
      }
      const Vector<S, n> force = d_dq(h_, q, p);
      if constexpr (!position_monitor) g = {g.value, d_dq(g_, q, p)};
      for (int i = 0; i < n; ++i)
        dp[i] = g.value * force[i] + across * g.partial(i);
    }
  }

  H h_;
  G g_;
  double pt_;
  Eigen::Index size_;
};

/// The transformed problem for the orbit through `start`, with \f$p^t = -H(q(0), p(0))\f$, the usual choice
/// in the paper (Section 3.1). Its methods follow orbits of this energy only. A state of another energy, for
/// example after a kick, needs its own problem: with a monitor, its run would end as ok but not follow an
/// orbit of H.
/// @throws std::invalid_argument if the start, or H there, is not finite, q and p are empty or of different
/// size, H or g reads an entry beyond them, or H supplies a gradient of another size.
template <int n, class H, class G = Unit>
Poincare<n, H, G> poincare(H hamiltonian, const State<n>& start, G monitor = {}) {
  require_start(start);
  const detail::Checked<double, n> q(start.q), p(start.p);
  const double pt = -require_finite("H at the start", static_cast<double>(hamiltonian(q, p)));
  if constexpr (SuppliesGradient<H, double, n>) {
    (void)detail::sized("Number of entries of d_dq", std::as_const(hamiltonian).d_dq(q, p), q.size());
    (void)detail::sized("Number of entries of d_dp", std::as_const(hamiltonian).d_dp(q, p), q.size());
  }
  if constexpr (std::invocable<const G&, const detail::Checked<double, n>&>)
    (void)std::as_const(monitor)(q);
  else
    (void)std::as_const(monitor)(q, p);
  return {std::move(hamiltonian), std::move(monitor), pt, start.q.size()};
}

}  // namespace avi
