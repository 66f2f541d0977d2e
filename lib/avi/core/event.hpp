#pragma once
#include "avi/core/step.hpp"

#include <type_traits>
#include <utility>

/// @file
/// Zeros of a function of the state along a run.

namespace avi {

/// In which sense g passes through zero, as the run goes.
enum class Crossing {
  rising,   ///< From below.
  falling,  ///< From above.
  either    ///< Both.
};

/// An event: g(state) = 0. It is seen where g has changed its sign from the beginning of a step to its end,
/// so two events in one step go unseen. A run that starts on g = 0 does not begin with an event.
template <class G>
struct Event {
  G g;                                   ///< Continuous function of the state.
  Crossing crossing = Crossing::either;  ///< Which events count.
  double tolerance = 0.0;                ///< |g| that is small enough; 0 for round-off.

  /// Whether the event lies in (before, after].
  template <class State>
  [[nodiscard]] bool crossed(const State& before, const State& after) const {
    const double first = g(before), last = g(after);
    const bool rises = first < 0.0 && last >= 0.0, falls = first > 0.0 && last <= 0.0;
    return (rises && crossing != Crossing::falling) || (falls && crossing != Crossing::rising);
  }
};
/// Event{g}, Event{g, crossing}, Event{g, crossing, tolerance}.
template <class G, class... Options>
Event(G, Options...) -> Event<G>;

/// Observer of steps that calls action(state) with the state of every event; see on_event().
template <class G, class Action>
class OnEvent {
 public:
  /// Of this event. @param action called with a state; returns nothing, or false to end the run
  OnEvent(Event<G> event, Action action) : event_(std::move(event)), action_(std::move(action)) {}

  /// Looks for the event in a step.
  template <class M, class State>
  Outcome operator()(const Step<M, State>& step, long) const {
    if (!event_.crossed(step.before, step.after)) return Outcome::ok;
    const Located<State> there = step.locate(event_.g, event_.tolerance);
    if (there.report.outcome != Outcome::ok) return there.report.outcome;
    if constexpr (std::is_same_v<std::invoke_result_t<Action&, const State&>, bool>) {
      return action_(there.state) ? Outcome::ok : Outcome::stopped;
    } else {
      action_(there.state);
      return Outcome::ok;
    }
  }

 private:
  Event<G> event_;
  mutable Action action_;  // may count what it sees
};

/// Observer for integrate(): action(state) is called with the state of every event, which lies on g = 0 to
/// round-off and is as accurate as the run; the run itself is not touched. Where action returns bool, false
/// ends the run at the end of that step; to end it at the event itself, use integrate_to().
template <class G, class Action>
OnEvent<G, Action> on_event(Event<G> event, Action action) {
  return {std::move(event), std::move(action)};
}

}  // namespace avi
