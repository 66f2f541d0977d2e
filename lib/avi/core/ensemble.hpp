#pragma once
#include "avi/core/integrate_to.hpp"

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>
#include <tuple>
#include <vector>

/// @file
/// ensemble(): runs of one problem from many starts, on all cores.

namespace avi {

/// One run of ensemble().
template <class State>
struct Member {
  State state;  ///< The last valid state, also where an exception was thrown.
  Run run{};    ///< How the run ended; stopped, with the message, where an exception was thrown.
  std::exception_ptr error{};  ///< The exception thrown by make, H or an observer, if any.

  /// True where the run reached its end.
  [[nodiscard]] bool ok() const { return run.ok(); }
};

/// Settings of ensemble(): number of threads, progress and cancellation.
struct EnsembleSettings {
  int threads = 0;  ///< Number of threads; 0 for one per core.
  /// Called as progress(done, all) after each run, by one thread at a time.
  std::function<void(std::size_t, std::size_t)> progress{};
  std::stop_token cancel{};  ///< Once requested, runs end as Outcome::stopped after their current step.
};

namespace detail {
/// Calls follow(i) for each i below `count`, on several threads. Calls fail(i, sentence, error) for each i
/// whose follow() throws, or that was cancelled before it began. @throws whatever settings.progress throws.
template <class Follow, class Fail>
void share_out(std::size_t count, const EnsembleSettings& settings, const Follow& follow, const Fail& fail) {
  std::mutex mutex;
  std::size_t done = 0;
  std::exception_ptr thrown;  // by settings.progress
  const auto report = [&] {
    const std::lock_guard lock(mutex);
    ++done;
    if (!settings.progress || thrown) return;
    try {
      settings.progress(done, count);
    } catch (...) {
      thrown = std::current_exception();
    }
  };
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        if (settings.cancel.stop_requested())
          fail(i, "The ensemble was cancelled before this run began.", std::exception_ptr());
        else
          follow(i);
      } catch (const std::exception& error) {
        fail(i, error.what(), std::current_exception());
      } catch (...) {
        fail(i, "Something was thrown that is no std::exception.", std::current_exception());
      }
      report();
    }
  };
  {
    const std::size_t most = settings.threads > 0 ? static_cast<std::size_t>(settings.threads)
                                                  : std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> helpers;  // this thread works as well
    try {
      for (std::size_t k = 1; k < std::min(most, count); ++k)
        helpers.emplace_back(work);
    } catch (const std::system_error&) {  // no more threads available: the existing ones do all the work
    }
    work();
  }
  if (thrown) std::rethrow_exception(thrown);
}

/// The step size of member i: the same number for all, an entry of a list, or a function of the start.
template <class Sizes, class State>
double size_of_step(const Sizes& sizes, const State& start, std::size_t i) {
  if constexpr (std::convertible_to<const Sizes&, double>)
    return sizes;
  else if constexpr (std::invocable<const Sizes&, const State&>)
    return sizes(start);
  else
    return sizes[i];
}

/// Checks the arguments that concern all members.
template <class Sizes, class State>
void require_ensemble(const Sizes& sizes, const std::vector<State>& starts, const Until& until, int threads) {
  static_assert(std::convertible_to<const Sizes&, double> || std::invocable<const Sizes&, const State&> ||
                    std::same_as<Sizes, std::vector<double>>,
                "The step of an ensemble is a number, a std::vector<double> with one for each start, or a "
                "function that returns one for a start.");
  require(threads >= 0, "Number of threads", threads, "at least 0");
  if constexpr (std::convertible_to<const Sizes&, double>) {
    require_run(sizes, until);
  } else if constexpr (std::invocable<const Sizes&, const State&>) {
    require_run(1.0, until);
  } else {
    require(sizes.size() == starts.size(), "Number of steps", sizes.size(), "that of the starts, ",
            starts.size());
    require_run(1.0, until);
    for (const double h : sizes)
      require_run(h, until);
  }
}

/// The observer of member i: either one created for it by observer(i), or a common one that is called with i
/// as its first argument.
template <class State, class Observer>
decltype(auto) observer_of(Observer& observer, std::size_t i) {
  if constexpr (std::invocable<Observer&, std::size_t>)
    return observer(i);
  else if constexpr (std::invocable<Observer&, std::size_t, const State&, long>)
    return [&observer, i](const State& state, long k) { return observer(i, state, k); };
  else
    return [&observer, i]<class M>(const Step<M, State>& step, long k) { return observer(i, step, k); };
}
}  // namespace detail

/// Integrates from each of `starts` with a separate method, until `until`, on several threads: exactly to
/// until.time, as integrate_to(), or as integrate() where only steps or seconds are set. Members share
/// nothing, so each result is the same to the last bit for any number of threads. A member that fails ends
/// with its own outcome; one whose make, H or observer throws ends as Outcome::stopped, with the message and
/// `error`. The other members continue.
/// @param make called as make(start); returns the method for that start, such as
///   collocation(poincare(H, start, g), 16)
/// @param h one step size for all, a std::vector<double> with one for each start, or a function called as
/// h(start)
/// @param until end of each member's run; its seconds apply to each run separately
/// @param observers either called as observer(i, state, k) or observer(i, step, k) after step k of member i,
/// with the return values of an observer of integrate(); calls for different members may overlap in time,
/// those for one member come in order. Or called once for each member as observer(i), to return an observer
/// of integrate() for it: `[&](std::size_t i) { return at_times(times, [&, i](const auto& z) { ... }); }`,
/// on_event(), or a reference to the Trajectory of that member.
/// @throws std::invalid_argument for a negative number of threads, a step that is zero or not finite, another
///   number of steps than of starts, or an `until` that sets no end; whatever `progress` throws.
template <class State, class Make, class Sizes, class... Observers>
[[nodiscard]] std::vector<Member<State>> ensemble(const Make& make, const std::vector<State>& starts,
                                                  const Sizes& h, Until until, EnsembleSettings settings = {},
                                                  Observers&&... observers) {
  detail::require_ensemble(h, starts, until, settings.threads);
  std::vector<Member<State>> members;
  members.reserve(starts.size());
  for (const State& start : starts)
    members.push_back({.state = start});
  const auto follow = [&](std::size_t i) {
    Member<State>& member = members[i];
    auto method = make(member.state);
    const double size = detail::size_of_step(h, member.state, i);
    std::tuple<decltype(detail::observer_of<State>(observers, i))...> own{
        detail::observer_of<State>(observers, i)...};
    const auto cancelled = [&](const State&, long) { return !settings.cancel.stop_requested(); };
    member.run = std::apply(
        [&](auto&... each) {
          return std::isfinite(until.time)
                     ? integrate_to(method, member.state, size, until, each..., cancelled)
                     : integrate(method, member.state, size, until, each..., cancelled);
        },
        own);
  };
  const auto fail = [&](std::size_t i, std::string sentence, std::exception_ptr error = {}) {
    members[i].run.outcome = Outcome::stopped;
    members[i].run.message = std::move(sentence);
    members[i].error = std::move(error);
  };
  detail::share_out(starts.size(), settings, follow, fail);
  return members;
}

}  // namespace avi
