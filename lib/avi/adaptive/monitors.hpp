#pragma once
#include "avi/core/hamiltonian.hpp"
#include "avi/core/power.hpp"
#include "avi/core/require.hpp"

#include <cmath>
#include <utility>

/// @file
/// Monitor functions g = dt/dtau. Each is generic in its scalar and positive wherever it is finite.
/// Mechanical ones take a problem with kinetic(p), potential(q) and potential_gradient(q), H = p . p / 2 +
/// V(q), unit masses.

namespace avi {

namespace detail {
template <class V>
auto squared_norm(const V& v) {
  auto sum = v[0] * v[0];
  for (Eigen::Index i = 1; i < v.size(); ++i)
    sum += v[i] * v[i];
  return sum;
}
}  // namespace detail

/// g(q) = (q . q)^gamma (equation (gamma) of the paper; gamma = 1 is (qnorm)).
struct Gamma {
  double gamma = 1.0;
  template <class Q>
  auto operator()(const Q& q) const {
    return power(detail::squared_norm(q), gamma);
  }
};

/// g(q) = q . q, the case gamma = 1 known at compile time.
struct NormSquared {
  template <class Q>
  auto operator()(const Q& q) const {
    return detail::squared_norm(q);
  }
};

/// g(q) = (2 (H_0 - V(q)) + |grad V(q)|^2)^(-1/2): equal steps in arc length of phase space (equation
/// (arclength); Hairer 1997).
template <class Problem>
struct Arclength {
  Problem problem;
  double energy;  ///< H_0
  template <class Q>
  auto operator()(const Q& q) const {
    return power(2.0 * (energy - problem.potential(q)) + detail::squared_norm(problem.potential_gradient(q)),
                 -0.5);
  }
};
template <class Problem>
Arclength(Problem, double) -> Arclength<Problem>;

/// g(q, p) = 1 / |p^t - L(q, p)| with the Lagrangian L = T(p) - V(q) and the number p^t = -H_0 (equation
/// (energy)).
template <class Problem>
struct Energy {
  Problem problem;
  double energy_momentum;  ///< p^t
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::abs;
    return 1.0 / abs(energy_momentum - (problem.kinetic(p) - problem.potential(q)));
  }
};
template <class Problem>
Energy(Problem, double) -> Energy<Problem>;

/// g(q, p) = 1 / |L(q, p)| (Section 3.3 of the paper).
template <class Problem>
struct InverseLagrangian {
  Problem problem;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::abs;
    return 1.0 / abs(problem.kinetic(p) - problem.potential(q));
  }
};
template <class Problem>
InverseLagrangian(Problem) -> InverseLagrangian<Problem>;

/// g(q, p) = 1 / |p^t + H(q, p)| (Section 3.3), infinite on the solution itself, where the paper finds it
/// fails; only its bounded form can be used.
template <class Problem>
struct InverseEnergyError {
  Problem problem;
  double energy_momentum;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::abs;
    return 1.0 / abs(energy_momentum + problem(q, p));
  }
};
template <class Problem>
InverseEnergyError(Problem, double) -> InverseEnergyError<Problem>;

/// g(q) = tol / |h^2 / 2 grad V(q)| (equation (trunerror)): the truncation error of a step of size h.
template <class Problem>
struct Truncation {
  Problem problem;
  double tolerance;
  double h;
  template <class Q>
  auto operator()(const Q& q) const {
    return (2.0 * tolerance / (h * h)) * power(detail::squared_norm(problem.potential_gradient(q)), -0.5);
  }
};
template <class Problem>
Truncation(Problem, double, double) -> Truncation<Problem>;

/// g(q) = (tol / |h^2 / 2 grad V(q)|)^(1/4), the form from which Truncation was simplified.
template <class Problem>
struct TruncationRoot {
  Problem problem;
  double tolerance;
  double h;
  template <class Q>
  auto operator()(const Q& q) const {
    return std::pow(2.0 * tolerance / (h * h), 0.25) *
           power(detail::squared_norm(problem.potential_gradient(q)), -0.125);
  }
};
template <class Problem>
TruncationRoot(Problem, double, double) -> TruncationRoot<Problem>;

/// g^ = b (g + a) / (g + b), which lies between a and b (Leimkuhler and Reich 2005, page 248; Section 3.3).
/// It bounds dt/dtau; for a Taylor method it bounds the step only nearly.
template <class G>
class Bounded {
 public:
  /// @throws std::invalid_argument unless 0 <= a < b, both finite.
  Bounded(G monitor, double a, double b) : g_(std::move(monitor)), a_(a), b_(b) {
    require(std::isfinite(a) && a >= 0.0, "Lower bound a of the monitor", a, "finite and at least 0");
    require(std::isfinite(b) && b > a, "Upper bound b of the monitor", b, "finite and above a");
  }
  template <class Q>
  auto operator()(const Q& q) const requires std::invocable<const G&, const Q&> {
    return bound(g_(q));
  }
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const requires std::invocable<const G&, const Q&, const P&> {
    return bound(g_(q, p));
  }

 private:
  template <class S>
  S bound(const S& g) const {
    return b_ * (g + a_) / (g + b_);
  }
  G g_;
  double a_, b_;
};

/// bounded(g, a, b).
template <class G>
Bounded<G> bounded(G monitor, double a, double b) {
  return {std::move(monitor), a, b};
}

}  // namespace avi
