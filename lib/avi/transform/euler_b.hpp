#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/unit_masses.hpp"
#include "avi/transform/poincare.hpp"

#include <cmath>
#include <utility>

/// @file
/// Symplectic Euler-B for \f$H = \tfrac12 p\cdot p + V(q)\f$, with fixed or adaptive steps.

namespace avi {

/// Adaptive symplectic Euler-B (equation (3.26) of the paper; Hairer 1997; Leimkuhler and Reich 2005, page
/// 254), \f[ p_1 = p_0 - h\,g\,\nabla V - h\,\nabla g\,(\tfrac12 |p_1|^2 + V + p^t), \quad q_1 = q_0 +
/// h\,g\,p_1, \quad t_1 = t_0 + h\,g, \f] with g, V and their gradients at \f$q_0\f$. It is the Type II HTVI
/// with r = 0. With the monitor Unit it is the usual method with fixed steps.
///
/// The implicit equation is solved in closed form. With \f$A = p_0 - h g \nabla V - h \nabla g\,(V + p^t)\f$
/// and \f$B = 1 + h A\cdot\nabla g\f$, \f$s = |p_1|^2\f$ is that root of \f[ \tfrac14 h^2 |\nabla g|^2 s^2 -
/// B s + |A|^2 = 0 \f] which tends to \f$|A|^2\f$ as h tends to 0; then \f$p_1 = A - \tfrac12 h s \nabla
/// g\f$. If there is no such root, h is too large for the monitor, and the step ends as not_converged with
/// the discriminant as its residual.
///
/// `Problem` provides potential(q) and potential_gradient(q); the monitor is differentiated automatically.
template <int n, class Problem, class G = Unit>
class EulerB {
  static_assert(n != dynamic, "Euler-B needs a dimension known at compile time.");
  static_assert(std::invocable<const G&, const Vector<double, n>&>,
                "The monitor of Euler-B must be callable as g(q): its equation is solved in closed form.");

 public:
  /// The method for orbits of energy -p^t; euler_b() deduces the types and finds p^t.
  /// @param energy_momentum p^t = -H(q(0), p(0)) @throws std::invalid_argument unless it is finite.
  EulerB(Problem problem, G monitor, double energy_momentum)
      : problem_(std::move(problem)), g_(std::move(monitor)), pt_(require_finite("p^t", energy_momentum)) {}

  static constexpr int order() { return 1; }  ///< In the step size.
  static constexpr bool symplectic = true;    ///< As a map of (q, p) for fixed p^t.
  static constexpr bool symmetric = false;    ///< Its adjoint is Euler-A.

  /// Advances z by the fictive step h. It ends as bad_monitor if g is not positive; as non_finite if g, its
  /// gradient, that of the potential or anything computed from them is not finite; and as not_converged if h
  /// is too large. z is then unchanged.
  StepReport step(State<n>& z, double h) const {
    State<n> moved = z;
    if constexpr (std::same_as<G, Unit>) {
      moved.p -= h * problem_.potential_gradient(z.q);
      moved.q += h * moved.p;
      moved.t += h;
    } else {
      const Partials<double, n> g = value_and_gradient(g_, z.q);
      if (!std::isfinite(g.value)) return {.outcome = Outcome::non_finite, .residual = g.value};
      if (!(g.value > 0.0)) return {.outcome = Outcome::bad_monitor, .residual = g.value};
      const double hg = h * g.value;
      const Vector<double, n> slope = g.gradient();
      const Vector<double, n> a =
          z.p - hg * problem_.potential_gradient(z.q) - (h * (problem_.potential(z.q) + pt_)) * slope;
      const double a2 = a.squaredNorm(), b = 1.0 + h * a.dot(slope);
      const double discriminant = b * b - h * h * slope.squaredNorm() * a2;
      if (std::isnan(discriminant)) return {.outcome = Outcome::non_finite, .residual = discriminant};
      // B > 0 need not be checked: where h A . grad g <= -1 the discriminant is below zero (Cauchy-Schwarz).
      if (!(discriminant >= 0.0)) return {.outcome = Outcome::not_converged, .residual = discriminant};
      moved.p = a - (h * a2 / (b + std::sqrt(discriminant))) * slope;
      moved.q += hg * moved.p;
      moved.t += hg;
    }
    if (!moved.finite()) return detail::lost_at(moved);
    z = moved;
    return {};
  }

 private:
  Problem problem_;
  G g_;
  double pt_;
};

/// The adaptive symplectic Euler-B for orbits of the energy of `start`: \f$p^t = -H(q(0), p(0))\f$.
/// @throws std::invalid_argument where H is not finite there, or all masses are not 1.
template <int n, class Problem, class G = Unit>
EulerB<n, Problem, G> euler_b(Problem problem, const State<n>& start, G monitor = {}) {
  const double pt = require_finite("p^t", -problem(start.q, start.p)),
               rest = problem(start.q, Vector<double, n>::Zero().eval());
  detail::require_unit_masses<n>([&](const auto& p) { return problem(start.q, p) - rest; },
                                 1e-8 * std::abs(rest));
  return {std::move(problem), std::move(monitor), pt};
}

}  // namespace avi
