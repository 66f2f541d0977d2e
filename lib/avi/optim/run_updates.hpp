#pragma once
#include "avi/core/event.hpp"
#include "avi/optim/starting_point.hpp"
#include "avi/optim/stopping.hpp"

#include <algorithm>
#include <concepts>
#include <limits>
#include <utility>

/// @file
/// run_updates(): the only loop for update rules. It handles stopping, counting, observation and failures; a
/// method only provides the update.

namespace avi {

/// A method is a set of hyper-parameters. start() checks them and returns the state for one run. update()
/// moves iterate.x once and may evaluate the objective anywhere. It sets iterate.evaluated to false unless
/// value and gradient are those of the new x.
template <class M, class F>
concept OptimisationMethod = requires(const M& method, typename M::State& state, Iterate& iterate,
                                      Counted<F>& objective) {
  { method.start(iterate) } -> std::same_as<typename M::State>;
  { method.update(state, iterate, objective) } -> std::same_as<Outcome>;
};

/// A witness that does nothing.
struct NoWitness {
  /// Does nothing.
  void operator()(const Iterate&, long, long) const {}
};

namespace detail {

inline std::string describe_end(Outcome outcome, long k, const Iterate& at, std::string_view reason) {
  return joined(
      {"The run ended as ", name(outcome), " at iteration ", k, ", where f = ", at.value, ": ", reason, "."});
}

/// Distinguishes a run whose iterates exceeded their bounds from one that met a value that is not a number.
inline void describe_failure(Minimisation& run, double x_bound) {
  const double size = largest_entry(run.last.x);
  std::string_view reason = "the iterates left every bound";
  run.outcome = Outcome::diverged;
  if (std::isnan(size)) {
    run.outcome = Outcome::non_finite;
    reason = "the iterate is not a number, because a gradient or a coefficient was not";
  } else if (std::isnan(run.last.value) && size <= x_bound) {
    run.outcome = Outcome::non_finite;
    reason = "the objective's value is not a number";
  } else if (size <= x_bound) {
    reason = "the objective's value left every bound";
  }
  run.message = describe_end(run.outcome, run.iterations, run.last, reason);
}

}  // namespace detail

/// Minimises f from x0 = `start` by the updates of `method`, until `stopping` holds.
///
/// The objective is evaluated once at x0, and then wherever the method or the stopping test needs it.
/// `witness(iterate, k, gradient_evaluations)` is called at the start (k = 0) and after every update; if it
/// returns a bool, false ends the run as Outcome::stopped.
/// @throws std::invalid_argument for a stopping rule or hyper-parameters out of range, an empty or non-finite
/// x0, an objective that is not finite at x0 or does not fill in its gradient there, or a gradient of another
/// size at any time.
template <Objective F, OptimisationMethod<F> M, class Witness = NoWitness>
Minimisation run_updates(const F& f, const M& method, const StartingPoint& start,
                         const Stopping& stopping = {}, Witness&& witness = {}) {
  stopping.validate();
  const VectorX& x0 = start.vector();
  require(x0.size() > 0, "Size of x0", x0.size(), "at least 1");
  require(std::isfinite(largest_entry(x0)), "Largest entry of x0", largest_entry(x0), "finite");
  Counted<F> objective(f, x0.size());
  Minimisation run;
  Iterate& now = run.last;
  now.x = x0;
  // NaN, so that an f that does not fill it is noticed
  now.gradient.setConstant(x0.size(), std::numeric_limits<double>::quiet_NaN());
  now.evaluate(objective);
  require_finite("Value of the objective at x0", now.value);
  require_finite("Norm of the gradient at x0", norm(now.gradient));
  typename M::State state = method.start(now);

  const auto bound = [&](double size) {
    return std::min(stopping.growth * std::max(1.0, size), std::numeric_limits<double>::max());
  };
  const double value_bound = bound(std::abs(now.value)), x_bound = bound(largest_entry(x0));
  const auto go_on = [&] {
    return detail::notify(witness, std::as_const(now), run.iterations, objective.gradients).ok();
  };
  const auto end = [&]() -> Minimisation& {
    run.gradient_evaluations = objective.gradients;
    run.function_evaluations = objective.values;
    return run;
  };
  // After a failure the run goes back one update. An objective that returns finite values for NaN arguments
  // may hide the failure for longer; then only x0 is known to be valid.
  VectorX good = now.x;
  const auto fail = [&]() -> Minimisation& {
    detail::describe_failure(run, x_bound);
    now.x = std::isfinite(largest_entry(good)) ? good : x0;
    now.evaluate(objective);
    return end();
  };
  const auto end_as = [&](Outcome outcome, std::string_view reason) -> Minimisation& {
    run.outcome = outcome;
    run.message = detail::describe_end(outcome, run.iterations, now, reason);
    return end();
  };

  bool more = go_on();
  while (more && run.iterations < stopping.iterations) {
    const double before = now.value;
    good = now.x;
    const Outcome outcome = method.update(state, now, objective);
    ++run.iterations;
    if (outcome != Outcome::ok) return end_as(outcome, "the method cannot continue");
    if (!now.evaluated) now.evaluate(objective);
    // One comparison per iteration detects every failure, because it is also false for NaN.
    if (!(std::abs(now.value) <= value_bound)) return fail();
    more = go_on();
    if (stopping.holds(now.value - before, now)) {
      run.outcome = Outcome::ok;
      break;
    }
  }
  if (!std::isfinite(largest_entry(now.x))) return fail();
  if (run.outcome == Outcome::ok) return end();
  return more ? end_as(Outcome::step_limit, "the cap on iterations was reached")
              : end_as(Outcome::stopped, "the witness asked to stop");
}

}  // namespace avi
