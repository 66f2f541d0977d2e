#pragma once
#include "avi/autodiff/hamiltonian.hpp"
#include "avi/core/power.hpp"
#include "avi/core/require.hpp"

#include <cmath>
#include <utility>

/// @file
/// Monitor functions g = dt/dtau. Each is generic in its scalar and positive wherever it is finite; where it
/// is not finite, a step ends as avi::Outcome::non_finite. A monitor of one's own must not vanish anywhere on
/// the orbit: see avi::Poincare. Mechanical ones take a problem with kinetic(p),
/// potential(q) and potential_gradient(q), \f$H = T(p) + V(q)\f$, \f$T = \tfrac12 p\cdot p\f$ (unit masses).
/// The page \ref monitors says which pays where.

namespace avi {

/// \f$g(q) = (q\cdot q)^\gamma\f$ (equation (3.33) of the paper; \f$\gamma = 1\f$ is (3.32)). Positive except
/// at the origin.
struct Gamma {
  double gamma = 1.0;  ///< The paper takes 1/2 and 1.
  /// g at a position of any scalar.
  template <class Q>
  auto operator()(const Q& q) const {
    return power(detail::squared_norm(q), gamma);
  }
};

/// \f$g(q) = q\cdot q\f$ (equation (3.32)), the case \f$\gamma = 1\f$ known at compile time.
struct NormSquared {
  /// g at a position of any scalar.
  template <class Q>
  auto operator()(const Q& q) const {
    return detail::squared_norm(q);
  }
};

/// \f$g(q) = \left(2\,(H_0 - V(q)) + |\nabla V(q)|^2\right)^{-1/2}\f$: equal steps in arc length of phase
/// space (equations (3.31) and (3.34); Hairer 1997). Finite wherever not both gradient and kinetic energy
/// vanish.
template <class Problem>
struct Arclength {
  Problem problem;  ///< V and its gradient.
  double energy;    ///< H_0.
  /// g at a position of any scalar.
  template <class Q>
  auto operator()(const Q& q) const {
    return power(2.0 * (energy - problem.potential(q)) + detail::squared_norm(problem.potential_gradient(q)),
                 -0.5);
  }
};
/// Arclength{problem, H_0}.
template <class Problem>
Arclength(Problem, double) -> Arclength<Problem>;

/// \f$g(q, p) = 1/|p^t - L(q, p)|\f$ with the Lagrangian \f$L = T(p) - V(q)\f$ and the number
/// \f$p^t = -H_0\f$ (equation (3.35)). Along the solution it is \f$1/(2T)\f$: infinite where the motion
/// stops. With p^t = 0 it is \f$1/|L(q, p)|\f$ (Section 3.3), infinite where T = V.
template <class Problem>
struct Energy {
  Problem problem;         ///< T and V.
  double energy_momentum;  ///< p^t.
  /// g at a point of phase space, of any scalar.
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::abs;
    return 1.0 / abs(energy_momentum - (problem.kinetic(p) - problem.potential(q)));
  }
};
/// Energy{problem, p^t}.
template <class Problem>
Energy(Problem, double) -> Energy<Problem>;

/// \f$g(q) = tol\,/\,|\tfrac12 h^2 \nabla V(q)|\f$ (equation (3.30)): the tolerance over the truncation error
/// of a step of size h by a method of order 1. On Kepler's problem it is \f$q\cdot q\f$ but for a factor.
/// With `root` 4 it is the fourth root of that, equation (3.29), from which the paper simplifies it.
template <class Problem, int root = 1>
struct Truncation {
  Problem problem;   ///< The gradient of V.
  double tolerance;  ///< tol > 0.
  double h;          ///< The fictive step that the method will take.
  /// g at a position of any scalar.
  template <class Q>
  auto operator()(const Q& q) const {
    return power(2.0 * tolerance / (h * h), 1.0 / root) *
           power(detail::squared_norm(problem.potential_gradient(q)), -0.5 / root);
  }
};
/// Truncation{problem, tol, h}.
template <class Problem>
Truncation(Problem, double, double) -> Truncation<Problem>;

/// \f$\hat g = b\,(g + a)/(g + b)\f$, which lies in [a, b) for \f$g \ge 0\f$ (Leimkuhler and Reich 2005, page
/// 248; Section 3.3). It bounds dt/dtau; for a Taylor method it bounds the step only nearly. Where g is
/// infinite the quotient is NaN.
template <class G>
class Bounded {
 public:
  /// Between a and b. @throws std::invalid_argument unless 0 <= a < b, both finite.
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
