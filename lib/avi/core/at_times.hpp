#pragma once
#include "avi/core/require.hpp"
#include "avi/core/step.hpp"

#include <cmath>
#include <utility>
#include <vector>

/// @file
/// Output at given times during a run.

namespace avi {

/// An observer for integrate() that calls action(state) at each of the given times as the run passes it. The
/// state is as accurate as the run, its t is that time exactly where Step::at() can attain it, and the run
/// itself is not affected. Where h < 0 the times must decrease. A time equal to the start is reported with
/// the first step.
///
/// The action returns what an observer of integrate() may return, and so can end the run at the end of the
/// current step. It is then still called for the remaining times inside that step. If the run is later
/// resumed with the same observer, it continues with the times that are left.
/// @throws std::invalid_argument unless the times are finite and strictly monotonic; the observer throws it
/// for a time before the start of the run, or times in the opposite direction to the run.
template <class Action>
[[nodiscard]] auto at_times(std::vector<double> times, Action action) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    require(std::isfinite(times[i]), "Output time", times[i], "finite");
    if (i > 0)
      require(times[1] > times[0] ? times[i] > times[i - 1] : times[i] < times[i - 1], "Output time",
              times[i], "beyond the one before it, ", times[i - 1]);
  }
  return [times = std::move(times), action = std::move(action),
          next = std::size_t{0}]<class M, class State>(const Step<M, State>& step, long) mutable -> Answer {
    const double sense = std::copysign(1.0, step.h);  // direction of time, also where it stands still
    const double rounding = detail::rounding_of_time(step.before.t, step.after.t);
    Answer first;  // first answer that is not ok; a resumed run begins after the whole step
    for (; next < times.size() && sense * (times[next] - step.after.t) <= rounding; ++next) {
      const double t = times[next];
      // Later times follow the earlier ones, unless the run goes in the opposite direction.
      require(sense * t >= sense * step.before.t, "Output time", t,
              next == 0 ? "not before the start of the run"
                        : "beyond the one before it in the direction of the run");
      const Located<State> there = step.at(t);
      Answer answer =
          there.ok() ? detail::notify(action, there.state) : Answer{there.report.outcome, there.reason};
      if (first.ok()) first = std::move(answer);
    }
    return first;
  };
}

}  // namespace avi
