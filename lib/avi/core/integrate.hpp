#pragma once
#include "avi/core/event.hpp"
#include "avi/core/require.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <sstream>
#include <type_traits>

/// @file
/// The only time loop of the library.

namespace avi {

/// Where a run ends: at the first step whose physical time reaches `time` (from above where h < 0), or after
/// `steps` steps.
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

namespace detail {
template <class State>
std::string describe_end(Outcome outcome, const State& state, long steps, double residual) {
  std::ostringstream sentence;
  sentence.precision(17);
  sentence << "The run ended as " << name(outcome) << " after " << steps << " steps, at t = " << state.t;
  [[maybe_unused]] const auto list = [&](const char* what, const auto& x) {  // faster to compile than Eigen's
    for (decltype(x.size()) i = 0; i < x.size(); ++i)
      sentence << (i == 0 ? what : " ") << x[i];
    sentence << ")";
  };
  if constexpr (requires { state.q.size(), state.p.size(); })
    if (outcome == Outcome::not_converged) list(", q = (", state.q), list(", p = (", state.p);
  if (outcome == Outcome::not_converged) sentence << ", with residual " << residual;
  sentence << ".";
  return sentence.str();
}

template <class Observer, class State>
inline constexpr bool of_states = std::invocable<Observer&, const State&, long>;
/// An observer of a method's run; one of states is not tried on a step, of which its body may ask too much.
template <class Observer, class M, class State>
concept ObserverOf = (of_states<Observer, State>) || (std::invocable<Observer&, const Step<M, State>&, long>);

/// A run without a goal ends by its `until` alone.
struct NoGoal {};

/// The loop of integrate() and integrate_to(). Where the step crosses the goal, it is replaced by the shorter
/// one that ends there, and the run is over.
template <class Goal, class State, class M, class... Observers>
Run run(M& method, State& state, double h, const Until& until, const Goal& goal, Observers&... observers) {
  static_assert(Method<M, State>,
                "The method has no step(state, h) for this state: is the state of another dimension?");
  static_assert((ObserverOf<Observers, M, State> && ...),
                "An observer must be callable as observer(state, k) or as observer(step, k).");
  require(std::isfinite(h) && h != 0.0, "Step size h", h, "finite and not zero");
  require(!std::isnan(until.time), "End time", until.time, "a number");
  require(until.steps >= 0, "Number of steps", until.steps, "at least 0");
  constexpr bool aims = !std::same_as<Goal, NoGoal>;
  constexpr bool looks_inside = aims || !(of_states<Observers, State> && ...);
  const bool timed = std::isfinite(until.time);
  require(timed || until.steps < std::numeric_limits<long>::max(), "End of the run", "not set",
          "a time or a number of steps");
  const double sense = std::copysign(1.0, h);  // of time
  require(!timed || !(sense * until.time < sense * state.t), "Step size h", h,
          h > 0.0 ? "negative where the run ends at a time behind"
                  : "positive where the run ends at a time ahead");
  const double end_time = timed ? sense * until.time : std::numeric_limits<double>::infinity();
  Run run;
  constexpr long patience = 1 << 20;
  double clock = state.t;
  // Working copies, so that a short step can keep them in registers.
  State current = state;
  const auto end = [&](Outcome outcome, double residual = 0.0) {
    state = current;
    run.outcome = outcome;
    if (outcome != Outcome::ok) run.message = describe_end(outcome, state, run.steps, residual);
    return run;
  };
  while (sense * current.t < end_time && run.steps < until.steps) {
    State next = current;
    // A copy only where the step depends on more than the state and may have to be repeated.
    const std::conditional_t<looks_inside && !one_step<M>, M, M&> before = method;
    const StepReport report = method.step(next, h);
    if (report.outcome != Outcome::ok) return end(report.outcome, report.residual);
    if (!next.finite()) return end(Outcome::non_finite);
    run.evaluations += report.evaluations;
    double size = h;
    bool arrived = false;
    if constexpr (aims) {
      arrived = goal.crossed(current, next);
      if (arrived) {
        const Located<State> there = Step<M, State>{before, current, next, h}.locate(goal.g, goal.tolerance);
        run.evaluations += there.evaluations;
        if (there.report.outcome != Outcome::ok) return end(there.report.outcome, there.report.residual);
        next = there.state;
        size = there.h;
      }
    }
    ++run.steps;
    Outcome outcome = Outcome::ok;  // the first answer that is not ok
    [[maybe_unused]] const auto look = [&](auto& observer) {
      Outcome answer;
      if constexpr (of_states<decltype(observer), State>)
        answer = ask(observer, next, run.steps);
      else
        answer = ask(observer, Step<M, State>{before, current, next, size}, run.steps);
      if (outcome == Outcome::ok) outcome = answer;
    };
    (look(observers), ...);
    current = next;
    if (outcome != Outcome::ok || arrived) return end(outcome);
    if (run.steps % patience == 0 && timed) {
      if (!(sense * (current.t - clock) * (0x1p53 / patience) > sense * (until.time - current.t)))
        return end(Outcome::stalled);
      clock = current.t;
    }
  }
  return end(aims || (timed && sense * current.t < end_time) ? Outcome::step_limit : Outcome::ok);
}
}  // namespace detail

/// Applies `method` with constant step h until `until` is met; the last step passes until.time, it is not
/// cut (integrate_to() ends exactly there). With h < 0 time runs backwards.
///
/// Each observer is called after step k = 1, 2, ..., as observer(state, k), or as observer(step, k) with the
/// Step, inside which it can look. It returns nothing, or false to end the run as stopped, or the Outcome
/// that is to end it unless ok. The state is always the last good one.
/// A run to a time that is over 2^53 steps away at the pace of the last million ends as stalled: h is below
/// the rounding of that time, or a method without a check of its own has a monitor that is not positive.
/// Nothing loops for ever.
/// @throws std::invalid_argument for h that is zero, not finite or leads away from until.time, or an `until`
/// that sets no end.
template <class State, class M, class... Observers>
[[nodiscard]] Run integrate(M& method, State& state, double h, Until until, Observers&&... observers) {
  return detail::run(method, state, h, until, detail::NoGoal{}, observers...);
}

}  // namespace avi
