#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"
#include "avi/core/summation.hpp"
#include "avi/core/unit_masses.hpp"
#include "avi/integrators/coefficient_lists.hpp"

#include <limits>
#include <utility>

/// @file
/// Splitting: one stepper for all methods that alternate two explicit flows.

namespace avi {

/// Change of position and time in a drift.
template <int n>
struct Drift {
  Vector<double, n> position;  ///< Added to q.
  double time;                 ///< Added to t.
};

/// The flows of \f$H = T(p) + V(q)\f$: drift \f$q \mathrel{+}= h\,\partial T/\partial p\f$, \f$t \mathrel{+}=
/// h\f$; kick \f$p \mathrel{-}= h\,\partial V/\partial q\f$. `Problem` provides `dimension`,
/// potential_gradient(q), and velocity(p), \f$\partial T/\partial p\f$, unless all masses are 1.
template <class Problem>
class Separable {
  static_assert(
      requires(const Problem& problem, const Vector<double, Problem::dimension>& q) {
        problem.potential_gradient(q);
      },
      "A problem to split must have potential_gradient(q): H = T(p) + V(q), and no time in it.");

 public:
  static constexpr int dimension = Problem::dimension;  ///< Entries of q and of p.
  using Vec = Vector<double, dimension>;                ///< A position or a momentum.

  /// The flows of this problem. @throws std::invalid_argument if it has kinetic(p), that is not half the
  /// square of p, and it has no velocity(p)
  explicit Separable(Problem problem = {}) : problem_(std::move(problem)) {
    if constexpr (
        requires(const Vec& p) { problem_.kinetic(p); } && !requires(const Vec& p) { problem_.velocity(p); })
      detail::require_unit_masses<dimension>([this](const Vec& p) { return problem_.kinetic(p); });
  }

  /// Change of q and t in a drift over h.
  [[nodiscard]] Drift<dimension> drift(const Vec& p, double h) const {
    if constexpr (requires { problem_.velocity(p); })
      return {h * detail::sized("Number of entries of the velocity", problem_.velocity(p), p.size()), h};
    else
      return {h * p, h};
  }
  /// Change of p in a kick over h.
  [[nodiscard]] Vec kick(const Vec& q, double h) const {
    return -h * detail::sized("Number of entries of the gradient", problem_.potential_gradient(q), q.size());
  }
  [[nodiscard]] bool admits(const State<dimension>&) const { return true; }  ///< Every state is admitted.

 private:
  Problem problem_;
};

namespace detail {
/// Flows that a Splitting alternates.
template <class Flows>
concept ExplicitFlows = requires(const Flows& flows, const Vector<double, Flows::dimension>& x) {
  flows.drift(x, 0.0);
  flows.kick(x, 0.0);
};
}  // namespace detail

/// The splitting method \f$A(a_0 h)\, B(b_0 h) \cdots A(a_m h)\f$, with drift A and kick B from `Flows`
/// (Separable, LogHamiltonian). It is explicit, and symplectic as a composition of exact flows.
///
/// With Summation::compensated, the rounding error of the energy grows only as the square root of the number
/// of steps (Brouwer's law). This makes the chain of dependent operations in each stage longer by about one
/// addition. The clock is always compensated.
template <class Flows, Summation summation = Summation::plain>
class Splitting {
  static_assert(detail::ExplicitFlows<Flows>,
                "A splitting alternates two flows: splitting(Separable(problem), coefficients).");

 public:
  static constexpr int n = Flows::dimension;  ///< Dimension of the problem.
  static constexpr bool one_step =
      summation != Summation::compensated;  ///< Else it remembers rounding errors.

  /// @param flows provides drift(p, h), kick(q, h) and admits(state) @param coefficients one of
  /// avi::splittings
  /// @throws std::invalid_argument unless both lists are palindromes with sum 1, and there is one drift more
  /// than there are kicks.
  Splitting(Flows flows, const SplitCoefficients& coefficients)
      : flows_(std::move(flows)), order_(coefficients.order), a_(coefficients.a), b_(coefficients.b) {
    require(a_.size() == b_.size() + 1, "Number of drifts", a_.size(), "one more than that of the kicks, ",
            b_.size());
    a_.validate("List of drifts");
    b_.validate("List of kicks");
    // equal to no state: there is no kept rounding error yet
    after_.t = std::numeric_limits<double>::quiet_NaN();
  }

  /// The order of the coefficients. A Nystrom list has this order only if the kinetic energy is quadratic in
  /// p.
  [[nodiscard]] int order() const { return order_; }
  static constexpr bool symplectic = true;  ///< A composition of exact flows.
  static constexpr bool symmetric = true;   ///< The coefficients are palindromes.

  /// Advances z by h, with one evaluation of the gradient per kick. The step ends as Outcome::diverged if the
  /// flows do not admit the new state, and as non_finite if that state is not finite; z is then unchanged.
  StepReport step(State<n>& z, double h) {
    State<n> moved = z;
    // If the state was changed from outside, the kept rounding error does not belong to it.
    if constexpr (compensated)
      if (!(moved == after_)) low_.q.setZero(z.q.size()), low_.p.setZero(z.p.size());
    State<n> low = low_;
    ClockSum clock = clock_;
    for (std::size_t i = 0; i < b_.size(); ++i) {
      drift(moved, low, clock, a_[i] * h);
      add<summation>(moved.p, low.p, flows_.kick(moved.q, b_[i] * h));
    }
    drift(moved, low, clock, a_.back() * h);
    StepReport report{.evaluations = static_cast<int>(b_.size())};
    if (!flows_.admits(moved)) {
      report.outcome = Outcome::diverged;
      return report;
    }
    std::swap(z, moved);
    if (!z.finite()) {  // tested on z, which a run tests too, so that the compiler keeps one of the two tests
      report = detail::lost_at(z, report.evaluations);
      z = moved;
      return report;
    }
    clock_ = clock;
    if constexpr (compensated) {
      low_ = low;
      after_ = z;
    }
    return report;
  }

 private:
  static constexpr bool compensated = summation == Summation::compensated;

  void drift(State<n>& z, State<n>& low, ClockSum& clock, double h) const {
    const Drift<n> d = flows_.drift(z.p, h);
    add<summation>(z.q, low.q, d.position);
    clock.add(z.t, d.time);
  }

  Flows flows_;
  int order_;
  Lengths<double> a_, b_;
  State<n> low_{}, after_{};
  ClockSum clock_;
};

/// Deduces the types: splitting<Summation::compensated>(flows, compositions::kahan_li8).
template <Summation summation = Summation::plain, class Flows>
Splitting<Flows, summation> splitting(Flows flows, const SplitCoefficients& coefficients) {
  return {std::move(flows), coefficients};
}
/// The same for a composition of the leapfrog A(h/2) B(h) A(h/2).
template <Summation summation = Summation::plain, class Flows>
Splitting<Flows, summation> splitting(Flows flows, const CompositionCoefficients& coefficients) {
  return {std::move(flows), split(coefficients)};
}

}  // namespace avi
