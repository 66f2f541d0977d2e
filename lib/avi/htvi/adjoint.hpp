#pragma once
#include "avi/core/inverse.hpp"
#include "avi/core/outcome.hpp"
#include "avi/core/state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

/// @file
/// The adjoint of an HTVI, and the symmetric method made of the two.

namespace avi {

/// The adjoint \f$\Phi^*_h = (\Phi_{-h})^{-1}\f$ of an HTVI \f$\Phi\f$ (Hairer, Lubich and Wanner 2006,
/// Section II.3).
///
/// With \f$H_d^+(q_0, p_1; h)\f$ the discrete right Hamiltonian of \f$\Phi\f$, \f$\Phi^*\f$ is the Type III
/// map of \f[ H_d^-(q_1, p_0; h) = -H_d^+(q_1, p_0; -h), \f] that is, the same Taylor data read from the
/// other end: the trial curve is expanded backwards from \f$(q_1, \tilde p_1)\f$ and its quadrature nodes are
/// mirrored, \f$c \to 1 - c\f$. (For \f$\Phi\f$ of Type III, exchange the types.) Type III as type3() makes
/// it expands forwards from \f$(\tilde q_0, p_0)\f$, so it is this adjoint only up to \f$O(h^{r+2})\f$; the
/// two agree exactly for r = 0, separable H and no monitor: symplectic Euler-A and -B.
///
/// The step solves \f$\Phi_{-h}(z_1) = z_0\f$ for \f$z_1 - z_0\f$ by Broyden's method, started from
/// \f$\Phi_h(z_0)\f$, which is off by O(h^(order + 1)), with the derivative of the Taylor method.
template <class M>
class Adjoint {
 public:
  static constexpr int n = M::n;  ///< Dimension of the problem, or avi::dynamic.

  /// The adjoint of this method, with its settings.
  explicit Adjoint(M method) : forward_(method), backward_(std::move(method)) {}

  /// Advances z by the fictive step h. Evaluations of both maps are counted; a failure of either is the
  /// step's, and so is Outcome::not_converged after 50 iterations.
  StepReport step(State<n>& z, double h) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const Eigen::Index m = z.q.size();
    typename M::Change change;
    StepReport report = forward_.increment(z, h, change);
    if (report.outcome != Outcome::ok) return report;
    Both delta = joined(change);  // z_1 - z_0
    Matrix<double, both> slope;   // approximates the inverse of dz_0/dz_1
    Both last_residual, last_shift;
    double previous = 0.0;
    for (int k = 1; k <= max_iterations; ++k) {
      State<n> end = z;
      end.q += delta.head(m);
      end.p += delta.tail(m);
      if constexpr (!M::has_clock) end.t += change.t;
      delta << end.q - z.q, end.p - z.p;  // what was really added, after rounding
      const StepReport back = backward_.increment(end, -h, change);
      report.evaluations += back.evaluations;
      if (back.outcome != Outcome::ok) {
        report.outcome = back.outcome;
        report.residual = back.residual;
        return report;
      }
      const Both residual = delta + joined(change);  // of Phi_(-h)(z_1) - z_0
      report.residual = residual.template lpNorm<Eigen::Infinity>();
      if (!std::isfinite(report.residual)) {
        report.outcome = Outcome::non_finite;
        return report;
      }
      const double accepted =
          8.0 * epsilon *
          (std::max(z.q.template lpNorm<Eigen::Infinity>(), z.p.template lpNorm<Eigen::Infinity>()) +
           delta.template lpNorm<Eigen::Infinity>());
      const bool stagnates =
          k > 1 && report.residual >= 0.5 * previous && report.residual <= 100.0 * accepted;
      if (report.residual <= accepted || stagnates) {
        z.q = end.q;
        z.p = end.p;
        if constexpr (M::has_clock)
          z.t = z.q[m - 1];
        else
          z.t -= change.t;
        return report;
      }
      if (k == 1) {
        slope = inverse<both>(backward_.tangent());
      } else {
        // Broyden's update of the inverse: it maps the last change of the residual to the last shift.
        const Both y = residual - last_residual, image = slope * y;
        const double scale = last_shift.dot(image);
        if (scale != 0.0) slope += (last_shift - image) * (last_shift.transpose() * slope).eval() / scale;
      }
      last_residual = residual;
      last_shift = -(slope * residual);
      delta += last_shift;
      change.t = -change.t;
      previous = report.residual;
    }
    report.outcome = Outcome::not_converged;
    return report;
  }

 private:
  static constexpr int both = n == dynamic ? dynamic : 2 * n;
  static constexpr int max_iterations = 50;
  using Both = Vector<double, both>;

  static Both joined(const typename M::Change& change) {
    Both x(2 * change.q.size());
    x << change.q, change.p;
    return x;
  }

  M forward_, backward_;
};

/// \f$\Phi^*_{h/2} \circ \Phi_{h/2}\f$: symmetric (its own adjoint), so time-reversible and of even order, at
/// least that of \f$\Phi\f$, and one more where that is odd. It is symplectic as both halves are.
template <class M>
class Symmetric {
 public:
  static constexpr int n = M::n;  ///< Dimension of the problem, or avi::dynamic.

  /// The composition of this method with its adjoint.
  explicit Symmetric(M method) : first_(method), second_(std::move(method)) {}

  /// Advances z by the fictive step h; z stays as it was unless both halves succeed.
  StepReport step(State<n>& z, double h) {
    State<n> half = z;
    StepReport report = first_.step(half, 0.5 * h);
    if (report.outcome != Outcome::ok) return report;
    const StepReport second = second_.step(half, 0.5 * h);
    report.outcome = second.outcome;
    report.evaluations += second.evaluations;
    report.residual = std::max(report.residual, second.residual);
    if (report.outcome == Outcome::ok) z = half;
    return report;
  }

 private:
  M first_;
  Adjoint<M> second_;
};

/// The adjoint of an HTVI.
template <class M>
Adjoint<M> adjoint(M method) {
  return Adjoint<M>(std::move(method));
}

/// The symmetric composition of an HTVI with its adjoint, half a step each.
template <class M>
Symmetric<M> symmetric(M method) {
  return Symmetric<M>(std::move(method));
}

}  // namespace avi
