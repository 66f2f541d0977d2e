#pragma once
#include "avi/htvi/htvi.hpp"

#include <utility>

// HTVI as printed in the paper (Section 2.2), and as its authors ran it: two further constructions for
// avi::type2(), avi::type3() and avi::htvi_of_order(). Both are symplectic and of order min(r + 1, s).

namespace experiment {

using avi::ActionRemainder, avi::DiscreteEquations, avi::Generating, avi::IterationProgress, avi::Matrix,
    avi::Partials, avi::Quadrature, avi::StepChange, avi::SuppliesGradient, avi::Vector, avi::constants;

/// f(q, p) and \f$p\cdot\partial f/\partial p\f$, for any scalar.
template <class F, class S, int n>
std::pair<S, S> value_and_work(const F& f, const Vector<S, n>& q, const Vector<S, n>& p) {
  if constexpr (SuppliesGradient<F, S, n>) {
    const Vector<S, n> slope = f.d_dp(q, p);
    S sum(0.0);
    for (int i = 0; i < n; ++i)
      sum += p[i] * slope[i];
    return {f(q, p), sum};
  } else {
    const auto at_q = constants<Partials<S, 1>>(q);
    Vector<Partials<S, 1>, n> along(p.size());  // differentiated in the direction of p
    for (Eigen::Index i = 0; i < p.size(); ++i)
      along[i] = Partials<S, 1>::variable(p[i], 0, p[i]);
    const Partials<S, 1> both = f(at_q, along);
    return {both.value, both.partial(0)};
  }
}

/// Integrand of the printed action, \f$p\cdot q' + p^t t' - \bar H\f$, with q' and t' from the field:
/// \f$g\,(p\cdot\partial H/\partial p - H)\f$, and off the energy shell the additional term \f$(H + p^t)\,
/// p\cdot\partial g/\partial p\f$.
template <bool on_shell, class Problem, class S, int n>
S action_rate(const Problem& problem, const Vector<S, n>& q, const Vector<S, n>& p, const S& pt) {
  const auto [energy, work] = value_and_work(problem.hamiltonian(), q, p);
  if constexpr (Problem::position_monitor || on_shell) {
    return problem.rate(q, p) * (work - energy);
  } else {
    const auto [g, g_work] = value_and_work(problem.monitor(), q, p);
    return g * (work - energy) + (energy + pt) * g_work;
  }
}

/// The action \f$A = h\sum_i b_i [p\cdot q' + p^t t' - \bar H](c_i h)\f$ of Section 2.2 of the paper. q' and
/// t' come from the field at the nodes, not from the curve, so the action is not stationary on the solution,
/// and the order is r + 1. Its variation is found by automatic differentiation.
template <class Expansion, class Construction>
class PrintedAction {
 public:
  using Number = typename Expansion::Number;  ///< A number with its partials.
  static constexpr int n = Expansion::n;      ///< Dimension of the problem.

  /// The action with this quadrature rule. @throws std::invalid_argument for an improper rule.
  explicit PrintedAction(Quadrature rule) : rule_(std::move(rule)) { validate(rule_); }

  [[nodiscard]] const Quadrature& rule() const { return rule_; }  ///< The quadrature rule b_i, c_i.

  /// R for the last expansion, with step h and increments d.
  [[nodiscard, gnu::noinline, gnu::flatten]] ActionRemainder<Number>
  remainder(const Expansion& e, const typename Expansion::Increments& d, double h) const {
    const Number pt = e.energy_momentum();
    const auto q_series = e.q(), p_series = e.p();
    Number sum(0.0);
    for (std::size_t j = 0; j < rule_.nodes.size(); ++j) {
      const double c = rule_.nodes[j];
      const bool raised = Construction::raises_the_end && c == 1.0;
      Vector<Number, n> q, p;
      for (int i = 0; i < n; ++i) {
        q[i] = q_series[i][0] + c * Expansion::tail(q_series[i], e.order() + (raised ? 1 : 0), c);
        p[i] = p_series[i][0] + c * Expansion::tail(p_series[i], e.order(), c);
      }
      sum += rule_.weights[j] * action_rate<Construction::on_shell>(e.problem(), q, p, pt);
    }
    // [p . dq]_0^h = p(h) . d(q(h) - q(0)) + (p(h) - p(0)) . dq(0), and p^t dt(h) where p^t is a variable.
    Number remainder = h * sum - e.problem().energy_momentum() * d.t;
    for (int i = 0; i < n; ++i)
      remainder -= (p_series[i][0].value() + d.p[i].value()) * d.q[i] + d.p[i].value() * q_series[i][0];
    return {remainder, d.t.value()};
  }

 private:
  Quadrature rule_;
};

/// Broyden's quasi-Newton method for F(u) = 0. It is used where the plain iteration u += F(u) contracts
/// slowly or not at all, at large h and for stiff problems. It takes over when a residual has not fallen to a
/// tenth of the one before, and starts from the identity, that is, from the plain iteration.
template <int n>
class Broyden {
 public:
  /// The shift of u for this residual. @param plain the shift of the plain iteration @param slow the residual
  /// has not fallen to a tenth
  Vector<double, n> shift(const Vector<double, n>& residual, const Vector<double, n>& plain, bool slow) {
    if (slow && !at_work_) {
      inverse_.setIdentity();
      at_work_ = true;
    }
    if (at_work_) {
      // The update makes the inverse map the last decrease of the residual to the last shift.
      const Vector<double, n> image = inverse_ * (last_residual_ - residual);
      const double scale = last_shift_.dot(image);
      if (scale != 0.0) {
        const auto row = (last_shift_.transpose() * inverse_).eval();
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            inverse_(i, j) += (last_shift_[i] - image[i]) / scale * row[j];
      }
    }
    last_residual_ = residual;
    last_shift_ = plain;
    if (at_work_) last_shift_ = inverse_ * residual;
    return last_shift_;
  }

 private:
  Matrix<double, n> inverse_;
  Vector<double, n> last_residual_, last_shift_;
  bool at_work_ = false;
};

/// The iteration of the paper's constructions: the plain one, and Broyden's method where that contracts
/// slowly.
template <int n>
class BroydenIteration {
 public:
  [[nodiscard]] BroydenIteration begin(bool) const { return {}; }
  bool propose(const auto& equations, const Vector<double, n>& residual, const IterationProgress<n>& now) {
    const bool slow = now.residual > 0.1 * now.previous;
    Vector<double, n> plain = residual;
    if constexpr (requires { equations.newton(residual); }) plain = equations.newton(residual);
    shift = now.stagnates ? plain : broyden_.shift(residual, plain, slow);
    // Each residual is at most residual / previous times the one before. Once the next one would be well
    // below round-off, so is the error of a first-order correction.
    return now.residual * now.residual <= 0.1 * now.accepted * now.previous;
  }
  [[nodiscard]] StepChange<n> step(const auto& equations, const Vector<double, n>& residual) const {
    return equations.shifted(residual, shift);
  }

  Vector<double, n> shift;

 private:
  Broyden<n> broyden_;
};

/// The construction as printed in the paper: the velocity in the action is that of the field, and the
/// position has order r at the nodes of the quadrature.
struct Printed {
  static constexpr bool energy_is_variable = true, on_level = false, on_shell = false, raises_the_end = false;
  template <class Vec, class S>
  static void field(const auto& problem, const Vec& q, const Vec& p, const S& pt, Vec& dq, Vec& dp, S& dt) {
    problem.field(q, p, pt, dq, dp, dt);
  }
  template <class Expansion>
  using Action = PrintedAction<Expansion, Printed>;
  template <Generating type, class Expansion>
  using Equations = DiscreteEquations<type, Expansion>;
  template <int n>
  using Iteration = BroydenIteration<n>;
  static constexpr int order(int r, int s) { return std::min(r + 1, s); }
};

/// The discrete equations on the energy shell. An expansion from a point off the shell follows another orbit,
/// so du_0/du differs from the identity not only by O(h^(r+1)) but also by a term of rank one.
template <Generating type, class Expansion>
class ShellEquations : public DiscreteEquations<type, Expansion> {
  using Base = DiscreteEquations<type, Expansion>;
  using Base::right, Base::sigma, Base::at_u, Base::at_k, Base::own, Base::n;

 public:
  using Vec = typename Base::Vec;

  ShellEquations(const Expansion& e, const typename Base::Increments& d,
                 const typename Base::Remainder& remainder)
      : Base(e, d, remainder) {
    // d_u changes with u by v w^T with w = dH/du, apart from O(h^(r+1)): off the shell, dR contains the terms
    // of the exact flow and (H + p^t) dt.
    Vec y;
    for (int j = 0; j < n; ++j)
      y[j] = sigma * d.t.partial(at_u + j);
    s_ = this->inverse_.lazyProduct(y);
    for (int j = 0; j < n; ++j) {
      v_[j] = sigma * d.t.partial(at_k + j);
      for (int i = 0; i < n; ++i)
        v_[j] -= own(i).partial(at_k + j) * s_[i];
      // From q' = g dH/dp and p' = -g dH/dq.
      w_[j] = (right ? e.q()[j][1].value() : -e.p()[j][1].value()) / e.t()[1].value();
    }
  }
  /// The shift of u that removes a residual, up to O(h^(r+1)) times the shift.
  [[nodiscard]] Vec newton(const Vec& residual) const {
    return residual - v_ * (w_.dot(residual) / (1.0 + w_.dot(v_)));
  }
  [[nodiscard]] StepChange<n> shifted(const Vec& residual, const Vec& shift) const {
    StepChange<n> moved = Base::shifted(residual, shift);
    (right ? moved.q : moved.p) += w_.dot(shift) * s_;
    return moved;
  }

 private:
  Vec s_, v_, w_;
};

/// The construction that gives the errors printed in Tables 1 and 2. It is as printed, but the trial curve
/// follows the field with H + p^t = 0, and at the node c = 1 the position has order r + 1.
struct Authors : Printed {
  static constexpr bool energy_is_variable = false, on_shell = true, raises_the_end = true;
  template <class Vec, class S>
  static void field(const auto& problem, const Vec& q, const Vec& p, const S&, Vec& dq, Vec& dp, S& dt) {
    problem.field_on_shell(q, p, dq, dp, dt);
  }
  template <class Expansion>
  using Action = PrintedAction<Expansion, Authors>;
  template <Generating type, class Expansion>
  using Equations = std::conditional_t<Expansion::unit, DiscreteEquations<type, Expansion>,
                                       ShellEquations<type, Expansion>>;
};

}  // namespace experiment
