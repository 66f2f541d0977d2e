#pragma once
#include "avi/core/event.hpp"
#include "avi/core/integrate.hpp"

#include <cmath>

/// @file
/// integrate_to(): runs that end exactly at a time or at an event.

namespace avi {

/// Ends a run exactly at an event. The step that contains it is replaced by a shorter one that ends there, on
/// g = 0 or just beyond it, to rounding. Every step, including the last, is a step of the method, and so is
/// symplectic where the method is. If `until` comes first, the run ends as Outcome::step_limit, after a step
/// that may go past until.time. Observers are called as in integrate(). A run that starts where this one
/// ended does not find the same event again.
/// @throws std::invalid_argument as integrate(), and for a tolerance of the event that is negative, infinite
/// or NaN.
template <class G, class State, class M, class... Observers>
[[nodiscard]] Run integrate_to(M& method, State& state, double h, const Event<G>& event, Until until,
                               Observers&&... observers) {
  return detail::run(method, state, h, until, detail::EventGoal<G>(event), observers...);
}

/// Ends a run exactly at the physical time until.time, which must lie before the start where h < 0. state.t
/// is then that time exactly, as Step::at() attains it. The last step is replaced by a shorter one that ends
/// there. A run that reaches until.steps or until.seconds first ends as step_limit or time_limit. Observers
/// are called as in integrate().
/// @throws std::invalid_argument as integrate(), or unless until.time is finite and lies in the direction of
/// h.
template <class State, class M, class... Observers>
[[nodiscard]] Run integrate_to(M& method, State& state, double h, Until until, Observers&&... observers) {
  require_finite("End time", until.time);
  return detail::run(method, state, h, until, detail::Arrival{until.time, std::copysign(1.0, h)},
                     observers...);
}

/// Ends a run exactly at the physical time t_end; the same as with Until{.time = t_end}.
/// @throws std::invalid_argument as the overload with an Until.
template <class State, class M, class... Observers>
[[nodiscard]] Run integrate_to(M& method, State& state, double h, double t_end, Observers&&... observers) {
  return integrate_to(method, state, h, Until{.time = t_end}, observers...);
}

}  // namespace avi
