#pragma once
#include "avi/core/bracketed_root.hpp"
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

/// @file
/// Step: a step that was taken, with access to the states inside it.

namespace avi {

namespace detail {
/// False for a method that declares `one_step = false`, because its step depends on more than the state.
template <class M>
inline constexpr bool one_step = true;
template <class M>
requires requires { M::one_step; }
inline constexpr bool one_step<M> = M::one_step;
}  // namespace detail

/// A state found inside a step, and how it was found.
template <class State>
struct Located {
  State state;           ///< The state at the zero, or at the time or part that was asked for.
  double h = 0.0;        ///< Size of the step that leads there from the beginning of the whole step.
  StepReport report{};   ///< Report of that step; unless it is ok, `state` is meaningless.
  long evaluations = 0;  ///< Evaluations in all steps that were tried.
  std::string reason{};  ///< Why there is no state, as a clause for the message of a run.

  /// True where the state was found.
  [[nodiscard]] bool ok() const { return report.ok(); }
};

namespace detail {
/// Sets the time of a state that already agrees with t to rounding. Where time is also a coordinate, both are
/// set.
template <class M, class State>
void set_time(const M& method, State& z, double t) {
  if constexpr (requires { method.problem().set_time(z, t); })
    method.problem().set_time(z, t);
  else
    z.t = t;
}

/// Calls an observer, and returns its result as an Answer.
template <class Observer, class... Seen>
Answer notify(Observer& observer, const Seen&... seen) {
  using Result = std::remove_cvref_t<std::invoke_result_t<Observer&, const Seen&...>>;
  if constexpr (std::same_as<Result, Answer>) {
    return observer(seen...);
  } else if constexpr (std::same_as<Result, Outcome>) {
    return {.outcome = observer(seen...)};
  } else if constexpr (std::same_as<Result, bool>) {
    return {.outcome = observer(seen...) ? Outcome::ok : Outcome::stopped};
  } else {
    observer(seen...);
    return {};
  }
}

/// The rounding error of the largest entry, as a bound on the noise of a function that is zero up to
/// rounding.
template <class State>
double rounding_of_entries([[maybe_unused]] const State& z) {
  double most = 0.0;
  if constexpr (requires { z.q.size(), z.p.size(); })
    for (Eigen::Index i = 0; i < z.q.size(); ++i)
      most = std::max({most, std::abs(z.q[i]), std::abs(z.p[i])});
  return std::numeric_limits<double>::epsilon() * most;
}

/// Rounding error of a time between a and b.
inline double rounding_of_time(double a, double b) {
  return std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
}
}  // namespace detail

/// A step that was taken, as shown to observers of steps.
template <class M, class State>
struct Step {
  const M& method;      ///< As before the step if that matters (one_step = false), otherwise as it is now.
  const State& before;  ///< State at the beginning of the step.
  const State& after;   ///< State at the end of the step.
  double h;             ///< Size of the step, in fictive time where the method is adaptive.

  /// The state where f(state) = 0 in the rest of the step after its fraction `begin`, in [0, 1), where f has
  /// the value f_begin. A copy of the method repeats the step with smaller sizes until f vanishes to
  /// rounding, so the state is as accurate as the ends of the step, and the run is not affected. This takes 5
  /// to 10 steps. f_begin and f(after) must have different signs, or f(after) must be zero; of several zeros
  /// one is found. The state lies on the zero or beyond it, where f has the sign of f(after), so that a
  /// search that continues from there does not find the same zero again.
  ///
  /// If f changes sign by a jump or a pole instead of a zero, the result is not_converged; if f is NaN,
  /// non_finite. `reason` then contains the numbers.
  /// @param f continuous function of the state @param tolerance |f| that counts as zero; 0 for rounding
  /// @throws std::invalid_argument for a tolerance that is negative, infinite or NaN, and where f has the
  /// same sign at both ends.
  template <class F>
  [[nodiscard]] Located<State> locate(double begin, double f_begin, F&& f, double tolerance) const {
    require(std::isfinite(tolerance) && tolerance >= 0.0, "Tolerance of the zero", tolerance,
            "finite and not negative");
    return search(begin, f_begin, f, tolerance, Side::beyond);
  }

  /// The state inside the step at physical time t, found as by locate(). Its time equals t exactly, unless
  /// the clock of the method is too uneven for that at the level of rounding.
  /// @param t a time between the two ends, or beyond `after` by no more than the rounding error of the clock
  /// @throws std::invalid_argument for another t.
  [[nodiscard]] Located<State> at(double t) const {
    const double rounding = detail::rounding_of_time(before.t, after.t);
    const auto [first, last] = std::minmax(before.t, after.t);
    require((t >= first && t <= last) || std::abs(t - after.t) <= rounding, "Time inside the step", t,
            "between its ends, ", before.t, " and ", after.t);
    if (t == before.t) return {.state = before, .report = {.evaluations = 0}};
    const auto late = [t](const State& z) { return z.t - t; };
    Located<State> found = search(0.0, late(before), late, rounding, Side::either);
    if (found.ok() && std::abs(late(found.state)) <= rounding) detail::set_time(method, found.state, t);
    return found;
  }

  /// The state after this fraction of the step. @throws std::invalid_argument unless it is in [0, 1].
  [[nodiscard]] Located<State> part(double fraction) const {
    require(fraction >= 0.0 && fraction <= 1.0, "Part of the step", fraction, "in [0, 1]");
    std::optional<M> repeated;
    Located<State> there{.state = before};
    take(repeated, fraction, there);
    return there;
  }

 private:
  void take(std::optional<M>& repeated, double fraction, Located<State>& there) const {
    if (!detail::one_step<M> || !repeated) repeated.emplace(method);
    there.state = before;
    there.h = fraction * h;
    there.report = repeated->step(there.state, there.h);
    there.evaluations += there.report.evaluations;
  }

  template <class F>
  Located<State> search(double begin, double f_begin, const F& f, double tolerance, Side side) const {
    const double last = f(after);
    Located<State> found{.state = after, .h = h};
    const auto fail = [&](Outcome outcome, std::initializer_list<detail::Piece> reason) {
      found.report.outcome = outcome;
      found.reason = detail::joined(reason);
      return found;
    };
    if (std::isnan(f_begin) || std::isnan(last))
      return fail(Outcome::non_finite, {"g is nan at t = ", std::isnan(f_begin) ? before.t : after.t});
    if (std::abs(last) <= tolerance) return found;
    const double sign = std::copysign(1.0, last);
    require(sign * f_begin < 0.0, "f at the beginning of the step", f_begin,
            "of another sign than at its end, ", last);
    std::optional<M> repeated;
    Located<State> tried{.state = before}, under{.state = before};
    const auto value = [&](double fraction) {
      take(repeated, fraction, tried);
      if (!tried.ok()) return std::numeric_limits<double>::quiet_NaN();
      const double at = sign * f(tried.state);
      (at < 0.0 ? under : found) = tried;
      return at;
    };
    const Root root = bracketed_root(value, begin, sign * f_begin, 1.0, sign * last, tolerance, side);
    if (root.x < root.high) found = under;
    found.evaluations = tried.evaluations;
    if (std::isnan(root.value)) {
      if (tried.ok()) return fail(Outcome::non_finite, {"g is nan at t = ", tried.state.t});
      found.report = tried.report;
      found.reason = "a step to g = 0 failed";
      return found;
    }
    if (root.met) return found;
    // The sign changes between neighbouring states. This is a zero if f there is small compared with its
    // values at the ends, or if |f| has shrunk with the distance, as a continuous function does near a zero.
    const double gap = root.f_high - root.f_low;
    const bool narrow = root.closed && std::isfinite(gap);  // at a pole f may be infinite on one side
    bool zero = narrow && (gap <= 1e-8 * std::min(std::abs(f_begin), std::abs(last)) ||
                           gap <= 16.0 * detail::rounding_of_entries(found.state));
    if (narrow && !zero) {
      // Compare with points so far away that the clock, too, has many numbers in between.
      const double tick = detail::rounding_of_time(before.t, after.t) / std::abs(after.t - before.t);
      const double wide = std::max(0x1p-30, 16.0 * tick);
      const double down = std::max(begin, root.low - wide), up = std::min(1.0, root.high + wide);
      const Located<State> kept = found;
      const double f_down = down > begin ? value(down) : sign * f_begin,
                   f_up = up < 1.0 ? value(up) : sign * last;
      found = kept;
      found.evaluations = tried.evaluations;
      zero = f_up - f_down >= 4.0 * gap;
    }
    if (zero) return found;
    return fail(Outcome::not_converged,
                {"g changes its sign near t = ", found.state.t, ", but not through zero: from ",
                 sign * root.f_low, " to ", sign * root.f_high,
                 ", where |g| is not small, as at a jump or a pole"});
  }
};

}  // namespace avi
