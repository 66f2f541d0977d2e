#pragma once
#include "avi/core/bracketed_root.hpp"
#include "avi/core/outcome.hpp"

#include <cmath>
#include <limits>
#include <optional>

/// @file
/// One step that was taken, and the states inside it.

namespace avi {

namespace detail {
/// A method whose step depends on more than the state declares `one_step = false`.
template <class M>
inline constexpr bool one_step = true;
template <class M>
requires requires { M::one_step; }
inline constexpr bool one_step<M> = M::one_step;
}  // namespace detail

/// A state inside a step, and how it was found.
template <class State>
struct Located {
  State state;           ///< At the zero.
  double h = 0.0;        ///< The step that leads there from the beginning of the whole one.
  StepReport report{};   ///< Of that step; unless it is ok, `state` means nothing.
  long evaluations = 0;  ///< Of all the steps that were tried.
};

/// A step that was taken: what an observer of steps is shown.
template <class M, class State>
struct Step {
  const M& method;      ///< As it was before the step, if that matters (one_step = false), else as it is now.
  const State& before;  ///< Where the step began.
  const State& after;   ///< Where it ended.
  double h;             ///< Its size (fictive time where the method is adaptive).

  /// The state inside the step where f(state) = 0. A copy of the method repeats the step with smaller sizes
  /// until f vanishes to round-off, so the point is as accurate as the ends of the step and the run is not
  /// touched. It takes 5 to 10 steps. f(before) and f(after) must have different signs, or f(after) be zero;
  /// of several zeros one is found.
  /// @param f continuous function of the state @param tolerance |f| that is small enough
  template <class F>
  [[nodiscard]] Located<State> locate(F&& f, double tolerance = 0.0) const {
    const double first = f(before), last = f(after);
    Located<State> found{.state = after, .h = h};
    if (!(std::abs(last) > tolerance)) return found;
    const double sign = std::copysign(1.0, last);
    std::optional<M> repeated;
    const auto value = [&](double part) {
      if (!detail::one_step<M> || !repeated) repeated.emplace(method);
      found.state = before;
      found.h = part * h;
      found.report = repeated->step(found.state, found.h);
      found.evaluations += found.report.evaluations;
      if (found.report.outcome != Outcome::ok) return std::numeric_limits<double>::quiet_NaN();
      return sign * f(found.state);
    };
    bracketed_root(value, 0.0, sign * first, 1.0, sign * last, tolerance);
    return found;
  }
};

}  // namespace avi
