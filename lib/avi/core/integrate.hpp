#pragma once
#include "avi/core/event.hpp"
#include "avi/core/require.hpp"
#include "avi/core/state.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// integrate(): the loop over the steps of any method.

namespace avi {

/// When a run ends: at the first step whose physical time reaches `time` (from above where h < 0), or after
/// `steps` steps. After `seconds` it ends as Outcome::time_limit.
struct Until {
  double time = std::numeric_limits<double>::infinity();  ///< Physical time; infinity sets no end.
  long steps = std::numeric_limits<long>::max();          ///< Number of steps; the largest long sets no end.
  double seconds =
      std::numeric_limits<double>::infinity();  ///< Wall-clock time in seconds; read only now and then.
};

/// A method advances a state by one step of size h, in fictive time where it is adaptive. If the report is
/// not ok, the state must be unchanged.
template <class M, class State>
concept Method = requires(M& method, State& state, double h) {
  { method.step(state, h) } -> std::same_as<StepReport>;
};

namespace detail {
/// The sentence for Run::message. @param q, p where the run ended; if empty, the sentence omits them
[[nodiscard]] std::string describe_end(Outcome outcome, double t, long steps, double residual,
                                       const std::string& reason, std::span<const double> q,
                                       std::span<const double> p);
template <class State>
[[gnu::cold]] std::string describe_end(Outcome outcome, const State& state, long steps, double residual,
                                       const std::string& reason) {
  std::vector<double> q, p;
  if constexpr (requires { state.q.begin(), state.p.begin(); }) {
    q.assign(state.q.begin(), state.q.end());
    p.assign(state.p.begin(), state.p.end());
  }
  return describe_end(outcome, static_cast<double>(state.t), steps, residual, reason, q, p);
}

/// Why a step failed, as a clause; empty for a step that did not converge, whose residual is reported
/// instead.
template <class State>
std::string reason_of(const StepReport& report, [[maybe_unused]] const State& z) {
  if (report.outcome == Outcome::bad_monitor) return "g = dt/dtau is not positive in the next step";
  if (report.outcome == Outcome::diverged) return "the next step leads where the method is not defined";
  if (report.outcome != Outcome::non_finite) return {};
  if constexpr (requires { not_finite(z); })
    if (report.bad_entry >= 0)
      return "after the next step " + name_of_entry(z, report.bad_entry) + " is not finite";
  return "a number in the next step is not finite";
}

/// Why a run ends where the next state is not finite, as a clause.
template <class State>
std::string reason_after([[maybe_unused]] const State& next) {
  if constexpr (requires { not_finite(next); }) return "after the next step " + not_finite(next);
  return {};
}

template <class Observer, class State>
inline constexpr bool of_states = std::invocable<Observer&, const State&, long>;
/// An observer for a run of this method. One that takes states is not tested with a Step, because
/// instantiating its body with one may fail.
template <class Observer, class M, class State>
concept ObserverOf = (of_states<Observer, State>) || (std::invocable<Observer&, const Step<M, State>&, long>);

/// The goal of a run that ends only by its `until`.
struct NoGoal {
  static constexpr std::string_view missed = "the cap on steps came before the end time";
};

/// The goal of ending exactly at a physical time. A step that ends within the rounding error of the clock
/// before it counts as arrived, since a further step would be as small as that error.
struct Arrival {
  double time;   ///< Time at which to end.
  double sense;  ///< 1, or -1 where time runs backwards.
  static constexpr std::string_view missed = "the cap on steps came before the end time";
  template <class M, class State>
  std::optional<Located<State>> look(const Step<M, State>& step, bool) const {
    const double rounding = rounding_of_time(step.before.t, step.after.t);
    if (!(sense * (time - step.after.t) <= rounding)) return {};
    return step.at(time);
  }
};

/// The goal of ending at an event.
template <class G>
struct EventGoal : EventWatch<G> {
  using EventWatch<G>::EventWatch;
  static constexpr std::string_view missed = "the event has not happened before the end of the run";
};

/// Looks up from the loop now and then: does time still advance, and are the seconds over?
class Lookout {
 public:
  /// @param until the end of the run, valid: see require_run() @param t time of the start
  Lookout(const Until& until, double t)
      : until_(until), sense_(std::copysign(1.0, until.time - t)), began_(now()), last_(began_), t_(t) {}
  static constexpr long patience = 1 << 20;  ///< Steps after which time must have gone on.
  /// Number of steps at which to look next.
  [[nodiscard]] long next() const { return std::min(stall_, clock_); }
  /// How the run must end after this number of steps; ok if it may go on. @param t time now
  [[nodiscard]] Answer look(long steps, double t) {
    if (stalled(steps, t))
      return {Outcome::stalled, "at the pace of the last million steps the end time is over 2^53 steps away"};
    if (time_is_up(steps)) return {Outcome::time_limit, "the seconds are over"};
    return {};
  }

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] bool timed() const { return std::isfinite(until_.seconds); }
  [[nodiscard]] Clock::time_point now() const { return timed() ? Clock::now() : Clock::time_point(); }
  /// True where the pace of the last steps leads to no end.
  [[nodiscard]] bool stalled(long steps, double t) {
    if (steps < stall_) return false;
    stall_ += patience;
    const double gone = sense_ * (t - std::exchange(t_, t));
    return std::isfinite(until_.time) && !(gone * (0x1p53 / patience) > sense_ * (until_.time - t));
  }
  /// Reads the clock about every millisecond.
  [[nodiscard]] bool time_is_up(long steps) {
    if (steps < clock_) return false;
    const auto time = now();
    const double gone = std::chrono::duration<double>(time - last_).count();
    stride_ = gone < 5e-4   ? std::min(2 * stride_, patience)
              : gone > 2e-3 ? std::max(stride_ / 2, 1L)
                            : stride_;
    clock_ = steps + stride_;
    last_ = time;
    return std::chrono::duration<double>(time - began_).count() >= until_.seconds;
  }
  Until until_;
  double sense_;  ///< Of time, towards the end.
  Clock::time_point began_, last_;
  double t_;  ///< Time at the last look for stalling.
  long stride_ = 1, stall_ = patience;
  long clock_ = timed() ? 1 : std::numeric_limits<long>::max();
};

/// Copies the state of the run back to the caller when the run ends, also by an exception.
template <class State>
struct Returned {
  State& state;          ///< The caller's state.
  const State& current;  ///< The run's state.
  ~Returned() { state = current; }
};

/// Checks the arguments of a run that do not involve its state.
void require_run(double h, const Until& until);

/// Checks the arguments of a run. In a problem where time is a coordinate, that one and the time of the state
/// agree only to rounding after output inside a step; for a time near 0 this is the rounding error of a step.
template <class M, class State>
void require_run(const M& method, const State& state, double h, const Until& until) {
  require_run(h, until);
  require_finite("Time of the start", state.t);
  if constexpr (requires { require_dimension(state); }) require_dimension(state);
  if constexpr (requires { method.problem().clock(state.q, state.t); }) {
    const double inside = method.problem().clock(state.q, state.t);
    require(!(std::abs(inside - state.t) > 1e-8 * (std::abs(state.t) + std::abs(h))), "Time t of the start",
            state.t, "that among its coordinates, ", inside);
  }
  const double sense = std::copysign(1.0, h);
  require(!(std::isfinite(until.time) && sense * until.time < sense * state.t), "Step size h", h,
          h > 0.0 ? "negative where the run ends at a time behind"
                  : "positive where the run ends at a time ahead");
}

/// Shows an observer the k-th step, with the state at its end.
template <class Observer, class M, class State>
Answer show(Observer& observer, const Step<M, State>& step, long k) {
  if constexpr (of_states<Observer, State>)
    return notify(observer, step.after, k);
  else
    return notify(observer, step, k);
}

/// The loop of integrate() and integrate_to(). A step that crosses the goal is replaced by a shorter one that
/// ends there, which completes the run.
template <class Goal, class State, class M, class... Observers>
Run run(M& method, State& state, double h, const Until& until, Goal goal, Observers&... observers) {
  static_assert(!std::is_const_v<M>, "The method is constant; a run changes what it remembers.");
  static_assert(!std::is_const_v<State>, "The state is constant; a run moves it.");
  static_assert(Method<M, State>,
                "The method has no step(state, h) for this state: is the state of another dimension?");
  static_assert((ObserverOf<Observers, M, State> && ...),
                "An observer must be callable as observer(state, k) or as observer(step, k).");
  require_run(method, state, h, until);
  constexpr bool aims = !std::same_as<Goal, NoGoal>;
  constexpr bool looks_inside = aims || !(of_states<Observers, State> && ...);
  const double sense = std::copysign(1.0, h);  // of time
  const double end_time =
      std::isfinite(until.time) ? sense * until.time : std::numeric_limits<double>::infinity();
  Run run;
  Lookout lookout(until, state.t);
  long look_up = lookout.next();
  Answer answer;  // the first that is not ok
  // Working copies, so that a short step can keep them in registers.
  State current = state;
  const Returned<State> returned{state, current};
  const auto end = [&](Outcome outcome, const std::string& reason, double residual = 0.0) {
    run.outcome = outcome;
    if (outcome != Outcome::ok) run.message = describe_end(outcome, current, run.steps, residual, reason);
    return run;
  };
  if constexpr (requires { not_finite(current); })
    if (!current.finite()) return end(Outcome::non_finite, "at the start " + not_finite(current));
  while (sense * current.t < end_time && run.steps < until.steps) {
    State next = current;
    // A copy is needed only where a step depends on more than the state and may have to be repeated.
    const std::conditional_t<looks_inside && !one_step<M>, M, M&> before = method;
    const StepReport report = method.step(next, h);
    if (report.outcome != Outcome::ok)
      return end(report.outcome, reason_of(report, current), report.residual);
    if (!next.finite()) return end(Outcome::non_finite, reason_after(next));
    run.evaluations += report.evaluations;
    double size = h;
    bool arrived = false;
    if constexpr (aims) {
      std::optional<Located<State>> there =
          goal.look(Step<M, State>{before, current, next, h}, run.steps == 0);
      if (there) run.evaluations += there->evaluations;
      if (there && !(there->ok() && sense * there->state.t > end_time)) {
        arrived = true;
        if (!there->ok()) return end(there->report.outcome, there->reason, there->report.residual);
        next = there->state;
        size = there->h;
        // The method has to take the shorter step as well, because dense output will ask for its polynomial.
        if (size != h) {
          if constexpr (!one_step<M>) method = before;
          State again = current;
          run.evaluations += method.step(again, size).evaluations;
        }
      }
    }
    ++run.steps;
    try {
      [[maybe_unused]] const auto look = [&](auto& observer) {
        Answer now = show(observer, Step<M, State>{before, current, next, size}, run.steps);
        if (answer.ok()) answer = std::move(now);
      };
      (look(observers), ...);
    } catch (...) {  // the step is complete, and other observers may have recorded it
      current = next;
      throw;
    }
    current = next;
    if (run.steps >= look_up && answer.ok() && !arrived) {
      answer = lookout.look(run.steps, current.t);
      look_up = lookout.next();
    }
    if (!answer.ok() || arrived) return end(answer.outcome, answer.reason);
  }
  constexpr bool any_time_is_short = aims && !std::same_as<Goal, Arrival>;  // an event goal was missed
  const bool short_of_end = any_time_is_short || (std::isfinite(until.time) && sense * current.t < end_time);
  return end(short_of_end ? Outcome::step_limit : Outcome::ok, std::string(Goal::missed));
}
}  // namespace detail

/// Applies `method` with constant step h until `until` is met. The last step goes past until.time and is not
/// shortened; integrate_to() ends exactly there. With h < 0 time runs backwards.
///
/// Each observer is called after step k = 1, 2, ..., either as observer(state, k) or as observer(step, k)
/// with a Step, which gives access to states inside it. It returns nothing; or false to end the run as
/// stopped; or an Outcome, or an Answer with a reason, that ends the run unless it is ok. The state is always
/// the last valid one. If H or an observer throws, it is the state after the last step that was reported to
/// an observer.
///
/// A run towards a time that is more than 2^53 steps away, at the pace of the last million steps, ends as
/// stalled. Then h is below the rounding error of that time, or the monitor is not positive and the method
/// does not check it. No run is endless; until.seconds limits those that would take too long.
/// @throws std::invalid_argument for an h that is zero, not finite or leads away from until.time; an `until`
/// that sets no end; a start whose time is not finite or, in a problem of time_dependent(), differs from the
/// one among its coordinates; or, for a dimension given at run time, q and p that are empty or differ in
/// size.
template <class State, class M, class... Observers>
[[nodiscard]] Run integrate(M& method, State& state, double h, Until until, Observers&&... observers) {
  return detail::run(method, state, h, until, detail::NoGoal{}, observers...);
}

/// @cond
// An overload for calls with wrong arguments, which compiles only as far as its message.
template <class M, class State, class Number, class... Observers>
requires std::is_arithmetic_v<Number> Run integrate(const M&, const State&, double, Number,
                                                    const Observers&...) {
  static_assert(Method<M, State>,
                "integrate() takes a method, such as collocation(poincare(H, start), 8), and runs it; "
                "solve(H, start, t_end, tolerance) takes a Hamiltonian and chooses everything else.");
  static_assert(
      !std::is_arithmetic_v<Number>,
      "The end of integrate(method, state, h, until) is an Until, such as {.time = 10.0} or {.steps = "
      "100}; integrate_to(method, state, h, t_end) ends exactly at a time.");
  return {};
}
/// @endcond

}  // namespace avi
