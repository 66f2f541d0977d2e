#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"

#include <concepts>
#include <limits>
#include <sstream>
#include <type_traits>

/// @file
/// The only time loop of the library.

namespace avi {

/// Where a run ends: at the first step whose physical time reaches `time`, or after `steps` steps.
struct Until {
  double time = std::numeric_limits<double>::infinity();  ///< Physical time; infinity sets no end.
  long steps = std::numeric_limits<long>::max();          ///< Number of steps; the largest long sets no end.
};

/// A method advances a state by one step of size h (fictive time where the method is adaptive). When the
/// report is not ok the state is left as it was.
template <class M, class State>
concept Method = requires(M& method, State& state, double h) {
  { method.step(state, h) } -> std::same_as<StepReport>;
};

/// Observer that looks at nothing and costs nothing.
struct NoObserver {
  /// Does nothing.
  template <class State>
  void operator()(const State&, long) const {}
};

namespace detail {
template <class State>
std::string describe_end(Outcome outcome, const State& state, long steps, double residual) {
  std::ostringstream sentence;
  sentence.precision(17);
  sentence << "The run ended as " << name(outcome) << " after " << steps << " steps, at t = " << state.t;
  if constexpr (requires { state.q.transpose(), state.p.transpose(); })
    if (outcome == Outcome::not_converged)
      sentence << ", q = (" << state.q.transpose() << "), p = (" << state.p.transpose() << ")";
  if (outcome == Outcome::not_converged) sentence << ", with residual " << residual;
  sentence << ".";
  return sentence.str();
}

/// What the observer says: true where it says nothing.
template <class Observer, class State>
bool goes_on(Observer& observer, const State& state, long k) {
  if constexpr (std::is_same_v<std::invoke_result_t<Observer&, const State&, long>, bool>) {
    return observer(state, k);
  } else {
    observer(state, k);
    return true;
  }
}
}  // namespace detail

/// Applies `method` with constant step h until `until` is met; the last step passes until.time, it is not
/// cut.
///
/// The observer is called as observer(state, k) after step k = 1, 2, ...; when it returns bool, false stops
/// the run. The state is always the last good one.
/// A run to a time that is over 2^53 steps away at the pace of the last million ends as stalled: h is below
/// the rounding of that time, or a method without a check of its own has a monitor that is not positive.
/// Nothing loops for ever.
/// @throws std::invalid_argument for h that is zero or not finite, or negative with an end time, or an
/// `until` that sets no end.
template <class State, class M, class Observer = NoObserver>
Run integrate(M& method, State& state, double h, Until until, Observer&& observer = {}) {
  static_assert(Method<M, State>,
                "The method has no step(state, h) for this state: is the state of another dimension?");
  require(std::isfinite(h) && h != 0.0, "Step size h", h, "finite and not zero");
  require(!std::isnan(until.time), "End time", until.time, "a number");
  require(until.steps >= 0, "Number of steps", until.steps, "at least 0");
  require(until.time < std::numeric_limits<double>::infinity() ||
              until.steps < std::numeric_limits<long>::max(),
          "End of the run", "not set", "a time or a number of steps");
  const bool timed = until.time < std::numeric_limits<double>::infinity();
  require(h > 0.0 || !timed, "Step size h", h, "positive where the run ends at a time");
  Run run;
  constexpr long patience = 1 << 20;
  double clock = state.t;
  // Working copies, so that a short step can keep them in registers.
  State current = state;
  const auto end = [&](Outcome outcome, double residual) {
    state = current;
    run.outcome = outcome;
    run.message = detail::describe_end(outcome, state, run.steps, residual);
    return run;
  };
  while (current.t < until.time && run.steps < until.steps) {
    State next = current;
    const StepReport report = method.step(next, h);
    if (report.outcome != Outcome::ok) return end(report.outcome, report.residual);
    if (!next.finite()) return end(Outcome::non_finite, 0.0);
    current = next;
    ++run.steps;
    run.evaluations += report.evaluations;
    if (run.steps % patience == 0 && timed) {
      if (!((current.t - clock) * (0x1p53 / patience) > until.time - current.t))
        return end(Outcome::stalled, 0.0);
      clock = current.t;
    }
    if (!detail::goes_on(observer, current, run.steps)) return end(Outcome::stopped, 0.0);
  }
  if (timed && current.t < until.time) return end(Outcome::step_limit, 0.0);
  state = current;
  return run;
}

}  // namespace avi
