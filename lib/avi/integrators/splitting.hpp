#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"
#include "avi/core/summation.hpp"
#include "avi/integrators/coefficient_lists.hpp"

#include <limits>
#include <utility>

/// @file
/// One stepper for every method that alternates two explicit flows.

namespace avi {

/// Change of position and time by a drift.
template <int n>
struct Drift {
  Vector<double, n> position;  ///< Added to q.
  double time;                 ///< Added to t.
};

/// The flows of \f$H = T(p) + V(q)\f$: drift \f$q \mathrel{+}= h\,\partial T/\partial p\f$,
/// \f$t \mathrel{+}= h\f$; kick \f$p \mathrel{-}= h\,\partial V/\partial q\f$.
/// `Problem` gives potential_gradient(q), and velocity(p) unless masses are 1.
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

  /// The flows of this problem.
  explicit Separable(Problem problem = {}) : problem_(std::move(problem)) {}

  /// Change of q and t by the drift over h.
  [[nodiscard]] Drift<dimension> drift(const Vec& p, double h) const {
    if constexpr (requires { problem_.velocity(p); })
      return {h * detail::sized("Number of entries of the velocity", problem_.velocity(p), p.size()), h};
    else
      return {h * p, h};
  }
  /// Change of p by the kick over h.
  [[nodiscard]] Vec kick(const Vec& q, double h) const {
    return -h * detail::sized("Number of entries of the gradient", problem_.potential_gradient(q), q.size());
  }
  [[nodiscard]] bool admits(const State<dimension>&) const { return true; }  ///< Admits every state.

 private:
  Problem problem_;
};

/// \f$A(a_0 h)\, B(b_0 h) \cdots A(a_m h)\f$ with the flows of `Flows` (Separable, LogHamiltonian). Explicit,
/// and symplectic as a product of exact flows.
///
/// With Summation::compensated the rounding error of the energy grows only as the square root of the number
/// of steps (Brouwer's law); it makes the chain of dependent operations of a stage about one addition longer.
/// The clock is compensated in every case.
template <class Flows, Summation summation = Summation::plain>
class Splitting {
 public:
  static constexpr int n = Flows::dimension;  ///< Dimension of the problem.

  /// @param flows with drift(p, h), kick(q, h) and admits(state) @param coefficients one of avi::splittings
  /// @throws std::invalid_argument unless both lists are the same read backwards, with sum 1, and there is
  /// one drift more than there are kicks.
  Splitting(Flows flows, const SplitCoefficients& coefficients)
      : flows_(std::move(flows)), order_(coefficients.order), a_(coefficients.a), b_(coefficients.b) {
    require(a_.size() == b_.size() + 1, "Number of drifts", a_.size(), "one more than that of the kicks, ",
            b_.size());
    a_.validate("List of drifts");
    b_.validate("List of kicks");
    after_.t = std::numeric_limits<double>::quiet_NaN();  // Equal to no state: no rounding error is kept yet.
  }

  /// The order of the coefficients. A Nystrom list has it only where the kinetic energy is quadratic in p.
  [[nodiscard]] int order() const { return order_; }
  static constexpr bool symplectic = true;  ///< A product of exact flows.
  static constexpr bool symmetric = true;   ///< The coefficients are the same read backwards.

  /// Advances z by h, with one evaluation of the gradient for each kick. Ends as Outcome::diverged, with z as
  /// it was, in a state that the flows do not admit, and as non_finite in one that is not finite.
  StepReport step(State<n>& z, double h) {
    State<n> moved = z;
    // A state changed from outside has no kept rounding error.
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
    if (!z.finite()) {  // asked of z, where a run asks the same: one test of the two is left
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
/// The same with a composition of the leapfrog A(h/2) B(h) A(h/2).
template <Summation summation = Summation::plain, class Flows>
Splitting<Flows, summation> splitting(Flows flows, const CompositionCoefficients& coefficients) {
  return {std::move(flows), split(coefficients)};
}

}  // namespace avi
