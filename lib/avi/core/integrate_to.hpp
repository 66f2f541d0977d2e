#pragma once
#include "avi/core/event.hpp"
#include "avi/core/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// Runs that end exactly at a time or at an event.

namespace avi {

/// Ends a run exactly at an event: the step in which it happens is replaced by the shorter one that ends
/// there. Every step, the last one included, is a step of the method and so symplectic where that is.
/// `until` ends a run without the event, as Outcome::step_limit; observers as in integrate().
/// @throws std::invalid_argument as integrate().
template <class G, class State, class M, class... Observers>
[[nodiscard]] Run integrate_to(M& method, State& state, double h, const Event<G>& event, Until until,
                               Observers&&... observers) {
  return detail::run(method, state, h, until, event, observers...);
}

/// Ends a run exactly at the physical time t_end, which lies before the start where h < 0. The last step is
/// replaced by the shorter one that ends there; observers as in integrate().
/// @throws std::invalid_argument as integrate(), or unless t_end lies in the direction of h.
template <class State, class M, class... Observers>
[[nodiscard]] Run integrate_to(M& method, State& state, double h, double t_end, Observers&&... observers) {
  require(std::isfinite(h) && h != 0.0, "Step size h", h, "finite and not zero");
  require(std::isfinite(t_end) && (h > 0.0 ? t_end >= state.t : t_end <= state.t), "End time", t_end,
          h > 0.0 ? "finite and not before the start where h > 0"
                  : "finite and not after the start where h < 0");
  if (t_end == state.t) return {};
  const Event arrival{[=](const State& z) { return z.t - t_end; }, Crossing::either,
                      std::numeric_limits<double>::epsilon() * std::max(std::abs(state.t), std::abs(t_end))};
  return detail::run(method, state, h, {.time = t_end}, arrival, observers...);
}

}  // namespace avi
