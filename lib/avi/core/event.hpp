#pragma once
#include "avi/core/step.hpp"

#include <concepts>
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

namespace detail {
/// Shows something to who may answer. @return ok unless the answer is another Outcome, or false for stopped
template <class Observer, class... Seen>
Outcome ask(Observer& observer, const Seen&... seen) {
  using Answer = std::invoke_result_t<Observer&, const Seen&...>;
  if constexpr (std::same_as<Answer, Outcome>) {
    return observer(seen...);
  } else if constexpr (std::same_as<Answer, bool>) {
    return observer(seen...) ? Outcome::ok : Outcome::stopped;
  } else {
    observer(seen...);
    return Outcome::ok;
  }
}
}  // namespace detail

/// Observer for integrate(): action(state) is called with the state of every event, which lies on g = 0 to
/// round-off and is as accurate as the run; the run itself is not touched. The action answers as an observer
/// of integrate() does, and may so end the run at the end of that step; to end it at the event itself, use
/// integrate_to().
template <class G, class Action>
auto on_event(Event<G> event, Action action) {
  return [event = std::move(event), action = std::move(action)]<class M, class State>(
             const Step<M, State>& step, long) mutable -> Outcome {
    if (!event.crossed(step.before, step.after)) return Outcome::ok;
    const Located<State> there = step.locate(event.g, event.tolerance);
    return there.report.outcome != Outcome::ok ? there.report.outcome : detail::ask(action, there.state);
  };
}

}  // namespace avi
