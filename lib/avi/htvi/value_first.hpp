#pragma once
#include "avi/core/summation.hpp"
#include "avi/htvi/generating_map.hpp"
#include "avi/htvi/taylor_values.hpp"

#include <algorithm>
#include <limits>
#include <utility>

/// @file
/// HTVI at the accuracy of the number format.

namespace avi {

/// An HTVI that does not compute what rounding would drop. The step differs from the Taylor method of its
/// order by less than the error of that method; where the Taylor expansion has converged to round-off within
/// the step (TaylorValues::converged()), the symplectic correction, its derivatives and the quadrature are
/// below round-off, and the step is the Taylor polynomial alone, at a fraction of the cost. Any other step is
/// the HTVI's. A larger `tolerance` takes the Taylor polynomial, too, where its remainder is that small a
/// part of q and of p: what a step then lacks in symplecticity is of that size, and errors of up to so much
/// may add up over the steps. Increments are accumulated with compensated summation (Kahan 1965), so that the
/// errors of a long run are those of the increments.
///
/// Only on the energy shell: there H is kept by the Taylor flow itself, not by the implicit equations, and
/// the rounding of g (H + p^t), which a monitor amplifies from apocentre to pericentre, does not arise.
/// @tparam summation Summation::plain is a control, to see what compensation is worth
template <class HtviMethod, Summation summation = Summation::compensated>
class ValueFirst;

/// The one for an HTVI of Taylor order r, 2 or more, on the energy shell.
template <Generating type, class Problem, int r, Construction construction, Summation summation>
class ValueFirst<Htvi<type, Problem, r, construction>, summation> {
 public:
  using Method = Htvi<type, Problem, r, construction>;  ///< What makes the steps that need it.
  using Values = TaylorValues<Problem, r>;              ///< What makes the others.
  static constexpr int n = Problem::dimension;          ///< Dimension of the problem.
  static_assert(r != dynamic,
                "ValueFirst needs a Taylor order that is known at compile time: type2<r>(...).");
  static_assert(construction.field == Field::on_shell,
                "ValueFirst needs a construction on the energy shell.");

  /// Around this method, with its settings.
  /// @param tolerance relative remainder of the Taylor expansion at which a step is the polynomial alone
  /// @throws std::invalid_argument unless half an ulp <= tolerance < 1.
  explicit ValueFirst(Method method, double tolerance = Values::half_ulp)
      : method_(std::move(method)), values_(method_.problem()), tolerance_(tolerance) {
    require(tolerance >= Values::half_ulp && tolerance < 1.0, "Tolerance of ValueFirst", tolerance,
            "in [1.2e-16, 1)");
    after_.t = std::numeric_limits<double>::quiet_NaN();  // No state is this one: nothing is left over yet.
  }

  /// Advances z by the fictive step h.
  StepReport step(State<n>& z, double h) {
    if (z.t != after_.t || z.q != after_.q || z.p != after_.p)  // changed from outside: nothing is left over
      low_ = State<n>{.q = Vector<double, n>::Zero(), .p = Vector<double, n>::Zero()};
    typename Method::Change change;
    StepReport report{.evaluations = 0};
    bool by_value = false;
    if (pause_ > 0) {
      --pause_;
    } else {
      values_.expand(z.q, z.p, h);
      ++report.evaluations;
      values_.increments(change.q, change.p, change.t);
      by_value = values_.converged(tolerance_) && change.t * h > 0.0;
      // A run that does not converge should not pay for many tries.
      last_pause_ = by_value ? 0 : std::min(2 * last_pause_ + 1, 63);
      pause_ = last_pause_;
    }
    if (!by_value) {
      const int tried = report.evaluations;
      report = method_.increment(z, h, change);
      report.evaluations += tried;
      if (report.outcome != Outcome::ok) return report;
    }
    ++(by_value ? value_steps_ : full_steps_);
    add<summation>(z.q, low_.q, change.q);
    add<summation>(z.p, low_.p, change.p);
    add<summation>(z.t, low_.t, change.t);
    after_ = z;
    return report;
  }

  /// Steps that were Taylor polynomials alone.
  [[nodiscard]] long value_steps() const { return value_steps_; }
  /// Steps of the HTVI proper.
  [[nodiscard]] long full_steps() const { return full_steps_; }

 private:
  Method method_;
  Values values_;
  double tolerance_;
  State<n> low_{}, after_{};
  int pause_ = 0, last_pause_ = 0;
  long value_steps_ = 0, full_steps_ = 0;
};

/// ValueFirst(type2<r>(...)) and ValueFirst(type2<r>(...), tolerance) know their type.
template <Generating type, class Problem, int r, Construction construction, class... Tolerance>
ValueFirst(Htvi<type, Problem, r, construction>, Tolerance...)
    -> ValueFirst<Htvi<type, Problem, r, construction>>;

}  // namespace avi
