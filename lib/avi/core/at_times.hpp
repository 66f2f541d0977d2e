#pragma once
#include "avi/core/require.hpp"
#include "avi/core/step.hpp"

#include <cmath>
#include <utility>
#include <vector>

/// @file
/// Output on a grid of times.

namespace avi {

/// Observer for integrate(): action(state) is called at each of the times that the run passes, with a state
/// as accurate as the run, whose t is that time to the bit as Step::at() has it; the run itself is not
/// touched. Times decrease where h < 0; one that equals the start is reported with the first step. The
/// action answers as an observer of integrate() does, and may so end the run at the end of that step; it is
/// called at the other times of the step all the same, and a run that goes on from there with this observer
/// at those that are left.
/// @throws std::invalid_argument unless the times are finite and strictly monotonic; the observer, where one
/// lies before the start, or they go the other way than the run.
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
    const double sense = std::copysign(1.0, step.h);  // of time, which may stand still
    const double rounding = detail::rounding_of_time(step.before.t, step.after.t);
    Answer first;  // that is not ok; a run that goes on later begins after all of this step
    for (; next < times.size() && sense * (times[next] - step.after.t) <= rounding; ++next) {
      const double t = times[next];
      // Later ones follow the one before them unless the run goes the other way.
      require(sense * t >= sense * step.before.t, "Output time", t,
              next == 0 ? "not before the start of the run"
                        : "beyond the one before it in the direction of the run");
      const Located<State> there = step.at(t);
      Answer answer = there.ok() ? detail::answer(detail::notify(action, there.state))
                                 : Answer{there.report.outcome, there.reason};
      if (first.outcome == Outcome::ok) first = std::move(answer);
    }
    return first;
  };
}

}  // namespace avi
