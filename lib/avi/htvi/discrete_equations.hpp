#pragma once
#include "avi/core/inverse.hpp"
#include "avi/htvi/action.hpp"
#include "avi/htvi/taylor_expansion.hpp"

/// @file
/// The discrete Hamilton's equations of a generating function, for one Taylor expansion.

namespace avi {

/// The type of the generating function of a step.
enum class Generating {
  type2,  ///< H_d^+(q_0, p_1), the discrete right Hamiltonian.
  type3   ///< H_d^-(q_1, p_0), the discrete left Hamiltonian.
};

/// The change of the state in a step.
template <int n>
struct StepChange {
  Vector<double, n> q;  ///< q_1 - q_0.
  Vector<double, n> p;  ///< p_1 - p_0.
  double t;             ///< t_1 - t_0.
};

/// The discrete Hamilton's equations for one expansion, from the point (u, k). The unknown u is \f$\tilde
/// p_0\f$ (Type II) or \f$\tilde q_0\f$ (Type III); k is the known other half of the state. Let X be the end
/// of the curve in the variable of u, which by definition is p_1 or q_1, and y the conjugate variable;
/// \f$\sigma\f$ = 1 for Type II, -1 for Type III. Both types read \f[ D_u\cdot\delta k + D_y\cdot\delta X =
/// -\sigma R \f] for all variations. R is the remainder of the action (ActionRemainder), D_u the true start
/// u_0 minus u, and D_y the true end of y minus the end of the curve in y. See \ref solving.
template <Generating type, class Expansion>
class DiscreteEquations {
 protected:
  static constexpr bool right = type == Generating::type2;  ///< True for Type II.
  static constexpr double sigma = right ? 1.0 : -1.0;       ///< Sign of the type.

 public:
  static constexpr int n = Expansion::n;                          ///< Dimension of the problem.
  using Increments = typename Expansion::Increments;              ///< Increments of the Taylor method.
  using Remainder = ActionRemainder<typename Expansion::Number>;  ///< R.
  using Vec = Vector<double, n>;                                  ///< A vector of n entries.

  /// Solves the equations for the last expansion of e, with the increments d.
  DiscreteEquations(const Expansion&, const Increments& d, const Remainder& remainder) : d_(d) {
    const auto& r = remainder.variation;
    Matrix<double, n> x_u;  // transposed
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        x_u(j, i) = own(i).partial(at_u + j) + (i == j ? 1.0 : 0.0);
    inverse_ = inverse<n>(x_u);
    Vec y;
    for (int j = 0; j < n; ++j)
      y[j] = -sigma * r.partial(at_u + j);
    const Vec d_y = inverse_.lazyProduct(y);
    for (int j = 0; j < n; ++j) {
      corrections[n + j] = d_y[j];
      double d_u = -sigma * r.partial(at_k + j);
      for (int i = 0; i < n; ++i)
        d_u -= own(i).partial(at_k + j) * d_y[i];
      corrections[j] = -d_u;
      drift[j] = own(j).value();
      (right ? change.p : change.q)[j] = drift[j] + corrections[j];
      (right ? change.q : change.p)[j] = other(j).value() + d_y[j];
    }
    change.t = remainder.time;
    if constexpr (Expansion::energy_partial) {
      change.t -= r.partial(2 * n);
      for (int i = 0; i < n; ++i)
        change.t -= sigma * own(i).partial(2 * n) * d_y[i];
    }
    corrections[2 * n] = change.t - d.t.value();
  }

  StepChange<n> change;  ///< The step, valid once u solves the implicit equation.
  /// Corrections to the Taylor curve: u - u_0, then D_y, then the correction of the time.
  Vector<double, 2 * n + 1> corrections;
  Vec drift;  ///< Increment of the variable of u along the curve.

  /// The step for u + shift, linearised with the derivative of the curve. It differs from the true one by
  /// O(h^(r+1)) times the shift. @param more difference between the corrections at u + shift and those at u,
  /// where known
  [[nodiscard]] StepChange<n>
  shifted(const Vec& residual, const Vec& shift,
          const Vector<double, 2 * n + 1>& more = Vector<double, 2 * n + 1>::Zero()) const {
    StepChange<n> moved = change;
    Vec& same = right ? moved.p : moved.q;
    Vec& conjugate = right ? moved.q : moved.p;
    for (int j = 0; j < n; ++j)
      same[j] += shift[j] - residual[j];
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        same[i] += own(i).partial(at_u + j) * shift[j];
        conjugate[i] += other(i).partial(at_u + j) * shift[j];
      }
      moved.t += d_.t.partial(at_u + j) * shift[j];
    }
    for (int j = 0; j < n; ++j)
      conjugate[j] += more[n + j];
    moved.t += more[2 * n];
    return moved;
  }

 protected:
  static constexpr int at_u = right ? n : 0;  ///< Index of the first partial by the unknown u.
  static constexpr int at_k = right ? 0 : n;  ///< Index of the first partial by the known half.
  /// Increment of the variable of u.
  [[nodiscard]] const auto& own(int i) const { return (right ? d_.p : d_.q)[i]; }
  /// Increment of the conjugate variable.
  [[nodiscard]] const auto& other(int i) const { return (right ? d_.q : d_.p)[i]; }

  const Increments& d_;        ///< Increments of the expansion.
  Matrix<double, n> inverse_;  ///< Inverse of dX/du, transposed.
};

}  // namespace avi
