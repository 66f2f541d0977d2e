#pragma once
#include "avi/autodiff/hamiltonian.hpp"
#include "avi/core/power.hpp"
#include "avi/core/require.hpp"

#include <cmath>
#include <utility>

/// @file
/// Monitor functions g = dt/dtau. Each is generic in its scalar, and positive wherever it is finite; where it
/// is not finite, a step ends as avi::Outcome::non_finite. A monitor of your own must not vanish anywhere on
/// the orbit; see avi::Poincare. Monitors of mechanical problems take a problem with kinetic(p), potential(q)
/// and potential_gradient(q), \f$H = T(p) + V(q)\f$, \f$T = \tfrac12 p\cdot p\f$ (unit masses). The page
/// \ref monitors tells which monitor suits which problem.

namespace avi {

/// The monitor \f$g(q) = (q\cdot q)^\gamma\f$ (equation (3.33) of the paper; (3.32) for \f$\gamma = 1\f$). It
/// is positive except at the origin.
struct Gamma {
  double gamma = 1.0;  ///< The exponent; 1/2 and 1 in the paper.
  /// g at a position, for any scalar.
  template <class Q>
  auto operator()(const Q& q) const {
    return power(detail::squared_norm(q), gamma);
  }
};

/// The monitor \f$g(q) = q\cdot q\f$ (equation (3.32)): Gamma with \f$\gamma = 1\f$ known at compile time.
struct NormSquared {
  /// g at a position, for any scalar.
  template <class Q>
  auto operator()(const Q& q) const {
    return detail::squared_norm(q);
  }
};

/// The monitor \f$g(q) = \left(2\,(H_0 - V(q)) + |\nabla V(q)|^2\right)^{-1/2}\f$, which gives steps of equal
/// arc length in phase space (equations (3.31) and (3.34); Hairer 1997). It is finite unless the gradient and
/// the kinetic energy both vanish.
template <class Problem>
struct Arclength {
  Problem problem;  ///< Provides V and its gradient.
  double energy;    ///< The energy H_0 of the orbit.
  /// g at a position, for any scalar.
  template <class Q>
  auto operator()(const Q& q) const {
    return power(2.0 * (energy - problem.potential(q)) + detail::squared_norm(problem.potential_gradient(q)),
                 -0.5);
  }
};
/// Deduces the type in Arclength{problem, H_0}.
template <class Problem>
Arclength(Problem, double) -> Arclength<Problem>;

/// The monitor \f$g(q, p) = 1/|p^t - L(q, p)|\f$ with the Lagrangian \f$L = T(p) - V(q)\f$ and the constant
/// \f$p^t = -H_0\f$ (equation (3.35)). Along the solution it equals \f$1/(2T)\f$, which is infinite where the
/// motion stops. With p^t = 0 it is \f$1/|L(q, p)|\f$ (Section 3.3), infinite where T = V.
template <class Problem>
struct Energy {
  Problem problem;         ///< Provides T and V.
  double energy_momentum;  ///< p^t.
  /// g at a point of phase space, for any scalar.
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::abs;
    return 1.0 / abs(energy_momentum - (problem.kinetic(p) - problem.potential(q)));
  }
};
/// Deduces the type in Energy{problem, p^t}.
template <class Problem>
Energy(Problem, double) -> Energy<Problem>;

/// The monitor \f$g(q) = tol\,/\,|\tfrac12 h^2 \nabla V(q)|\f$ (equation (3.30)): the tolerance divided by
/// the truncation error of a step of size h with a method of order 1. For Kepler's problem it is \f$q\cdot
/// q\f$ up to a factor. With `root` 4 it is the fourth root of this, equation (3.29), which the paper
/// simplifies to (3.30).
template <class Problem, int root = 1>
struct Truncation {
  Problem problem;   ///< Provides the gradient of V.
  double tolerance;  ///< tol > 0.
  double h;          ///< The fictive step that the method will take.
  /// g at a position, for any scalar.
  template <class Q>
  auto operator()(const Q& q) const {
    return power(2.0 * tolerance / (h * h), 1.0 / root) *
           power(detail::squared_norm(problem.potential_gradient(q)), -0.5 / root);
  }
};
/// Deduces the type in Truncation{problem, tol, h}.
template <class Problem>
Truncation(Problem, double, double) -> Truncation<Problem>;

/// The monitor \f$\hat g = b\,(g + a)/(g + b)\f$, which lies in [a, b) for \f$g \ge 0\f$ (Leimkuhler and
/// Reich 2005, page 248; Section 3.3). It bounds dt/dtau; the physical step of a Taylor method is only
/// approximately bounded. Where g is infinite, the quotient is NaN.
template <class G>
class Bounded {
 public:
  /// Bounds this monitor by a and b. @throws std::invalid_argument unless 0 <= a < b, both finite.
  Bounded(G monitor, double a, double b) : g_(std::move(monitor)), a_(a), b_(b) {
    require(std::isfinite(a) && a >= 0.0, "Lower bound a of the monitor", a, "finite and at least 0");
    require(std::isfinite(b) && b > a, "Upper bound b of the monitor", b, "finite and above a");
  }
  /// The bounded form of g(q) or g(q, p).
  template <class... Arguments>
  auto operator()(const Arguments&... at) const requires std::invocable<const G&, const Arguments&...> {
    const auto g = g_(at...);
    return b_ * (g + a_) / (g + b_);
  }

 private:
  G g_;
  double a_, b_;
};

/// The bounded form of a monitor. @throws std::invalid_argument unless 0 <= a < b, both finite.
template <class G>
Bounded<G> bounded(G monitor, double a, double b) {
  return {std::move(monitor), a, b};
}

}  // namespace avi
