#pragma once
#include "avi/core/inverse.hpp"
#include "avi/htvi/discrete_hamiltonian.hpp"
#include "avi/htvi/solver.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <utility>

/// @file
/// The discrete Hamilton's equations of a generating function, at one Taylor expansion.

namespace avi {

/// From the Taylor expansion at (u, k) to the step: u, the unknown, is \f$\tilde p_0\f$ (Type II) or
/// \f$\tilde q_0\f$ (Type III), k the known half of the expansion point. See \ref solving.
template <Generating type, class Problem, int r, Construction construction>
class DiscreteEquations {
  // The unknown u is p~_0 (Type II) or q~_0 (Type III); the known half k of the expansion point is q_0 or
  // p_0. With X = p_1 or q_1 as a function of (u, k), sigma = +1 or -1, and y the other half of the new
  // state, the chain rule turns the discrete equations into y = sigma X_u^-T (.)_u and the residual of k's
  // conjugate; the latter is solved for u by an iteration that contracts like O(h^(r+1)): du_0/du is I +
  // O(h^(r+1)) in the full field, and I + v w^T + O(h^(r+1)) on the energy shell, w = dH/du, v = sigma T_k -
  // X_k^T s, s = sigma X_u^-T T_u, T = t~_1 - t_0, because off the shell dK = (terms of the exact flow) + (H
  // + p^t) dT. All quantities are increments over the step.

 public:
  using Action = TaylorAction<Problem, r, construction>;       ///< The Taylor discrete Hamiltonian.
  using Change = StepChange<Problem::dimension>;               ///< What a step adds.
  static constexpr int n = Problem::dimension;                 ///< Dimension of the problem, or avi::dynamic.
  static constexpr int both = n == dynamic ? dynamic : 2 * n;  ///< That of phase space.
  static constexpr bool right = type == Generating::type2;     ///< Of the discrete right Hamiltonian.

  /// Of this problem and rule. @param order r, where it is avi::dynamic at compile time
  /// @throws std::invalid_argument for an improper rule or an order out of range.
  DiscreteEquations(const Problem& problem, Quadrature rule, int order, std::size_t tape_slots)
      : action_(problem, std::move(rule), order, tape_slots), x_(2 * size(), size()),
        other_(2 * size(), size()), factor_(size(), size()), x_u_(size(), size()), drift_(size()), s_(size()),
        v_(size()), slope_(size()), x_pt_(size()), rest_(2 * size()), t_(2 * size()) {}

  [[nodiscard]] int size() const { return action_.size(); }       ///< Dimension of the problem.
  [[nodiscard]] const Action& action() const { return action_; }  ///< The last expansion.
  /// Increment of u's own variable by the Taylor method.
  [[nodiscard]] const Vector<double, n>& drift() const { return drift_; }
  /// Whether the expansion advances time in the sense of h.
  [[nodiscard]] bool advances(double h) const { return d_.t.value() * h > 0.0; }

  /// Expands from z with `unknown` in the place of u.
  void expand(const State<n>& z, const Vector<double, n>& unknown, double h) {
    for (int c = 0; c < action_.chunks(); ++c) {
      action_.expand(right ? z.q : unknown, right ? unknown : z.p, h, d_, c);
      gather(right ? unknown : z.p, c);
    }
  }

  /// Solves the equations for the change at the present expansion, and for the u - u_0 that they ask for.
  void solve(Change& change, Vector<double, n>& wanted) {
    factor_ = x_.template middleRows<n>(at_u(), size());
    if constexpr (n != dynamic && n <= 4)
      x_u_ = factor_.inverse();
    else
      invert(factor_, x_u_);
    const auto x_k = x_.template middleRows<n>(at_k(), size());
    auto& other = right ? change.q : change.p;
    auto& same = right ? change.p : change.q;
    // Coefficient by coefficient: no temporaries at run-time dimension.
    other = x_u_.lazyProduct(sigma * rest_.template segment<n>(at_u(), size()));
    wanted = x_k.lazyProduct(other);
    wanted -= sigma * rest_.template segment<n>(at_k(), size());
    if constexpr (right) {
      same = wanted;
      wanted -= drift_;
    } else {
      same = wanted + drift_;
    }
    if constexpr (shell_terms) {
      s_ = x_u_.lazyProduct(sigma * t_.template segment<n>(at_u(), size()));
      v_ = x_k.lazyProduct(s_);
      v_ = sigma * t_.template segment<n>(at_k(), size()) - v_;
    }
    if constexpr (Action::energy_lane)
      change.t = rest_pt_ - sigma * x_pt_.dot(other);
    else
      change.t = d_.t.value();
  }

  /// Solves (du_0/du) shift = residual, up to O(h^(r+1)).
  void newton(const Vector<double, n>& residual, Vector<double, n>& shift) {
    shift = residual;
    if constexpr (shell_terms) {
      action_.energy_slope(right, slope_);
      shift -= v_ * (slope_.dot(residual) / (1.0 + slope_.dot(v_)));
    }
  }

  /// Moves the change to u + shift by its derivative: y and t_1 differ from the Taylor method's by O(h^(r+1))
  /// only, apart from the term (H + p^t) s off the energy shell. After newton().
  void correct(const Vector<double, n>& residual, const Vector<double, n>& shift, Change& change) const {
    auto& other = right ? change.q : change.p;
    auto& same = right ? change.p : change.q;
    if constexpr (shell_terms) other += slope_.dot(shift) * s_;
    same -= residual;
    for (int j = 0; j < size(); ++j) {
      for (int i = 0; i < size(); ++i) {
        other[i] += other_(at_u() + j, i) * shift[j];
        same[i] += x_(at_u() + j, i) * shift[j];
      }
      change.t += t_[at_u() + j] * shift[j];
    }
  }

  /// d(q_1, p_1)/d(q_0, p_0) of the last Taylor expansion; on the energy shell not that of the map.
  [[nodiscard]] Matrix<double, both> tangent() const {
    Matrix<double, both> slope(2 * size(), 2 * size());
    for (int i = 0; i < size(); ++i)
      for (int j = 0; j < 2 * size(); ++j) {
        const double other = other_(j, i) + (j == at_k() + i ? 1.0 : 0.0);
        slope(i, j) = right ? other : x_(j, i);
        slope(size() + i, j) = right ? x_(j, i) : other;
      }
    return slope;
  }

 private:
  using Lane = typename Action::Lane;
  static constexpr double sigma = right ? 1.0 : -1.0;
  [[nodiscard]] int at_u() const { return right ? size() : 0; }  // where the variables of the unknown begin
  [[nodiscard]] int at_k() const { return right ? 0 : size(); }  // and those of the known half
  static constexpr bool shell_terms = !Problem::unit && construction.field == Field::on_shell;

  /// Keeps the partials of chunk c of the expansion, whose momentum is p, and the Taylor method's increment
  /// of u's own variable in drift_.
  void gather(const Vector<double, n>& p, int c) {
    const double energy_momentum = action_.problem().energy_momentum();
    const Lane pt =
        Action::energy_lane ? Action::seeded(energy_momentum, 2 * size(), c) : Lane(energy_momentum);
    // The generating function less P . q_0 (Type II) or less -p_0 . q_1 (Type III): free of cancellation.
    Lane rest = pt * d_.t - d_.action;
    const int first = c * Action::lanes, last = std::min(first + Action::lanes, 2 * size());
    for (int i = 0; i < size(); ++i) {
      const Lane x = Action::seeded(right ? p[i] : 0.0, at_u() + i, c) + (right ? d_.p[i] : d_.q[i]);
      const Lane& other = right ? d_.q[i] : d_.p[i];
      rest += right ? x * d_.q[i] : p[i] * d_.q[i];
      drift_[i] = right ? d_.p[i].value() : d_.q[i].value();
      for (int j = first; j < last; ++j) {
        x_(j, i) = x.partial(j - first);
        other_(j, i) = other.partial(j - first);
      }
      if constexpr (Action::energy_lane)
        if (2 * size() - first < Action::lanes) x_pt_(i) = x.partial(2 * size() - first);
    }
    for (int j = first; j < last; ++j) {
      rest_[j] = rest.partial(j - first);
      t_[j] = d_.t.partial(j - first);
    }
    if constexpr (Action::energy_lane)
      if (2 * size() - first < Action::lanes) rest_pt_ = rest.partial(2 * size() - first);
  }

  Action action_;
  Matrix<double, both, n> x_, other_;  // transposed derivatives of X and of the change of the other half
  Matrix<double, n> factor_, x_u_;     // transpose of dX/du, and its inverse
  Vector<double, n> drift_, s_, v_, slope_, x_pt_;
  Vector<double, both> rest_, t_;
  double rest_pt_ = 0.0;
  typename Action::Increments d_;
};

}  // namespace avi
