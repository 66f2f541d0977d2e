#pragma once
#include "avi/core/require.hpp"
#include "avi/core/step.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

/// @file
/// Zeros of a function of the state during a run.

namespace avi {

/// In which direction g passes through zero, in the direction of the run.
enum class Crossing {
  rising,   ///< From below.
  falling,  ///< From above.
  either    ///< Both.
};

/// An event: g(state) = 0. It is detected where g changes sign between the two ends of a step, so two events
/// in one step are missed. A run that starts on an event does not report it again: at the start g counts as
/// zero within the tolerance or the rounding error of the state. A run can thus continue from the event at
/// which the last one ended, in either direction of time. Where g changes sign by a jump or a pole, such as
/// an angle at 2 pi or a tangent, the run ends as not_converged; where g is NaN, as non_finite.
template <class G>
struct Event {
  G g;                                   ///< Continuous function of the state.
  Crossing crossing = Crossing::either;  ///< Which crossings count.
  double tolerance = 0.0;                ///< |g| that counts as zero; 0 for round-off.

  /// True where g crosses zero between two values, the second included, in a direction that counts.
  [[nodiscard]] bool crosses(double first, double last) const {
    const bool rises = first < 0.0 && last >= 0.0, falls = first > 0.0 && last <= 0.0;
    return (rises && crossing != Crossing::falling) || (falls && crossing != Crossing::rising);
  }
};
/// Deduces the type in Event{g}, Event{g, crossing}, Event{g, crossing, tolerance}.
template <class G, class... Options>
Event(G, Options...) -> Event<G>;

namespace detail {
/// Rounding error of g at a state: by how much g changes when each entry changes by its rounding error, or by
/// the rounding error of what a step adds to it if that is larger.
template <class G, class State>
double rounding_of(const G& g, const State& z, const State& after) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  double sum = 0.0;
  if constexpr (requires { z.q[0], z.p[0], z.t; }) {
    const double at = g(z);
    State moved = z;
    const auto shift = [&](double& entry, double end) {
      const double kept = entry;
      entry += epsilon * std::max(std::abs(kept), std::abs(end - kept));
      sum += std::abs(g(moved) - at);
      entry = kept;
    };
    for (Eigen::Index i = 0; i < z.q.size(); ++i) {
      shift(moved.q[i], after.q[i]);
      shift(moved.p[i], after.p[i]);
    }
    shift(moved.t, after.t);
  }
  return 8.0 * sum;
}

/// Detects an event from step to step.
template <class G>
class EventWatch {
 public:
  /// @throws std::invalid_argument for a tolerance that is negative, infinite or NaN.
  explicit EventWatch(Event<G> event) : event_(std::move(event)) {
    require(std::isfinite(event_.tolerance) && event_.tolerance >= 0.0, "Tolerance of the event",
            event_.tolerance, "finite and not negative");
  }

  /// The state at the event if this step contains it, or the reason why it could not be found; otherwise
  /// empty. @param first true for the first step of the run
  template <class M, class State>
  std::optional<Located<State>> look(const Step<M, State>& step, bool first) {
    const double begin = event_.g(step.before), end = event_.g(step.after);
    if (std::isnan(begin) || std::isnan(end)) {
      const State& where = std::isnan(begin) ? step.before : step.after;
      Located<State> none{.state = where, .report = {.outcome = Outcome::non_finite, .evaluations = 0}};
      none.reason = detail::joined({"g of the event is nan at t = ", where.t});
      return none;
    }
    if (first) {
      level_ = event_.tolerance;
      // Add the rounding error only where it is small against the change of g in the step.
      if (std::abs(begin) <= 1e-3 * std::abs(end - begin))
        level_ = std::max(level_, rounding_of(event_.g, step.before, step.after));
      leaving_ = std::abs(begin) <= level_;
    }
    if (leaving_ || begin == 0.0) return leave(step, end);
    if (!event_.crosses(begin, end)) return {};
    return step.locate(0.0, begin, event_.g, event_.tolerance);
  }

 private:
  /// For a step that begins on the event: waits until g leaves zero, and counts only a later change of its
  /// sign.
  template <class M, class State>
  std::optional<Located<State>> leave(const Step<M, State>& step, double end) {
    if (!leaving_) level_ = event_.tolerance;
    leaving_ = std::abs(end) <= level_;
    if (leaving_) return {};
    long evaluations = 0;
    for (const double fraction : {0x1p-26, 0x1p-20, 0x1p-14, 0x1p-8, 0x1p-4}) {
      Located<State> near = step.part(fraction);
      near.evaluations = evaluations += near.evaluations;
      if (!near.ok()) return near;
      const double g = event_.g(near.state);
      if (!(std::abs(g) > level_)) continue;
      if (!event_.crosses(g, end)) return {};
      Located<State> there = step.locate(fraction, g, event_.g, event_.tolerance);
      there.evaluations += evaluations;
      return there;
    }
    return {};
  }

  Event<G> event_;
  double level_ = 0.0;    // |g| that counts as zero at the start of the run
  bool leaving_ = false;  // g has not left zero yet
};
}  // namespace detail

/// An observer for integrate() that calls action(state) at every event. The state lies on g = 0 to round-off
/// and is as accurate as the run, which is not affected. The action returns what an observer of integrate()
/// may return, and so can end the run at the end of the current step; integrate_to() ends it at the event
/// itself.
/// @throws std::invalid_argument for a tolerance that is negative, infinite or NaN.
template <class G, class Action>
[[nodiscard]] auto on_event(Event<G> event, Action action) {
  return [watch = detail::EventWatch<G>(std::move(event)), action = std::move(action)]<class M, class State>(
             const Step<M, State>& step, long k) mutable -> Answer {
    const std::optional<Located<State>> there = watch.look(step, k == 1);
    if (!there) return {};
    if (!there->ok()) return {there->report.outcome, there->reason};
    return detail::notify(action, there->state);
  };
}

}  // namespace avi
