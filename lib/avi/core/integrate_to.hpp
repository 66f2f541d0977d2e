#pragma once
#include "avi/core/event.hpp"
#include "avi/core/integrate.hpp"

#include <cmath>

/// @file
/// Runs that end exactly at a time or at an event.

namespace avi {

/// Ends a run exactly at an event: the step in which it happens is replaced by the shorter one that ends
/// there, on g = 0 or beyond it to rounding. Every step, the last one included, is a step of the method and
/// so symplectic where that is. `until` ends a run without the event, or before it, as Outcome::step_limit;
/// observers as in integrate(). A run that starts where this one ended does not find the same event again.
/// @throws std::invalid_argument as integrate(), and for a tolerance of the event that is negative, infinite
/// or NaN.
template <class G, class State, class M, class... Observers>
[[nodiscard]] Run integrate_to(M& method, State& state, double h, const Event<G>& event, Until until,
                               Observers&&... observers) {
  return detail::run(method, state, h, until, detail::EventGoal<G>(event), observers...);
}

/// Ends a run exactly at the physical time until.time, which lies before the start where h < 0: state.t is
/// that time to the bit, as Step::at() has it. The last step is replaced by the shorter one that ends there;
/// a run that has taken until.steps or until.seconds before ends as step_limit or time_limit. Observers as in
/// integrate().
/// @throws std::invalid_argument as integrate(), or unless until.time is finite and lies in the direction of
/// h.
template <class State, class M, class... Observers>
[[nodiscard]] Run integrate_to(M& method, State& state, double h, Until until, Observers&&... observers) {
  require_finite("End time", until.time);
  return detail::run(method, state, h, until, detail::Arrival{until.time, std::copysign(1.0, h)},
                     observers...);
}

/// Ends a run exactly at the physical time t_end; the same with {.time = t_end}.
/// @throws std::invalid_argument as the other one.
template <class State, class M, class... Observers>
[[nodiscard]] Run integrate_to(M& method, State& state, double h, double t_end, Observers&&... observers) {
  return integrate_to(method, state, h, Until{.time = t_end}, observers...);
}

}  // namespace avi
