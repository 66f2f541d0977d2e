#pragma once
#include "avi/core/require.hpp"
#include "avi/core/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

/// @file
/// Output on a grid of times.

namespace avi {

/// Observer of steps that calls action(state) at given physical times; see at_times().
template <class Action>
class AtTimes {
 public:
  /// At these times. @throws std::invalid_argument unless they are finite and strictly monotonic.
  AtTimes(std::vector<double> times, Action action) : times_(std::move(times)), action_(std::move(action)) {
    for (std::size_t i = 0; i < times_.size(); ++i) {
      require(std::isfinite(times_[i]), "Output time", times_[i], "finite");
      if (i > 0)
        require((times_[i] - times_[i - 1]) * (times_[1] - times_[0]) > 0.0, "Output time", times_[i],
                "beyond the one before it");
    }
  }

  /// Looks for the next times in a step. @throws std::invalid_argument where one lies before the start, or
  /// they go the other way than the run.
  template <class M, class State>
  Outcome operator()(const Step<M, State>& step, long) {
    const double sense = step.after.t > step.before.t ? 1.0 : -1.0;
    const double rounding =
        std::numeric_limits<double>::epsilon() * std::max(std::abs(step.before.t), std::abs(step.after.t));
    for (; next_ < times_.size() && sense * (times_[next_] - step.after.t) <= rounding; ++next_) {
      const double t = times_[next_];
      // Later ones follow the one before them unless the run goes the other way.
      require(sense * t >= sense * step.before.t, "Output time", t,
              next_ == 0 ? "not before the start of the run"
                         : "beyond the one before it in the direction of the run");
      if (t == step.before.t) {
        action_(step.before);
        continue;
      }
      const Located<State> there = step.locate([t](const State& z) { return z.t - t; }, rounding);
      if (there.report.outcome != Outcome::ok) return there.report.outcome;
      action_(there.state);
    }
    return Outcome::ok;
  }

 private:
  std::vector<double> times_;
  Action action_;
  std::size_t next_ = 0;
};

/// Observer for integrate(): action(state) is called at each of the times that the run passes, with a state
/// as accurate as the run; the run itself is not touched. Times decrease where h < 0; one that equals the
/// start is reported with the first step.
/// @throws std::invalid_argument unless the times are finite and strictly monotonic.
template <class Action>
AtTimes<Action> at_times(std::vector<double> times, Action action) {
  return {std::move(times), std::move(action)};
}

}  // namespace avi
