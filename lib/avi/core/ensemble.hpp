#pragma once
#include "avi/core/integrate.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

/// @file
/// Many starts of one problem, each a run of its own, on all cores.

namespace avi {

/// One run of an ensemble.
template <class State>
struct Member {
  State state;  ///< Where it ended: the last good state.
  Run run;      ///< How. Outcome::stopped after 0 steps, with the sentence, where its start was refused.
};

/// Integrates each of `starts` with a method of its own, until `until`, on several threads. Each member is
/// integrate() of its start, the same to the last bit on any number of threads: members share nothing. One
/// that fails ends with its own outcome, the others go on.
/// @param make called as make(start), returns the method for that start, such as
///   collocation(poincare(H, start, g), 16); where it throws std::invalid_argument, the member ends at once
/// @param threads 0 for one thread per core
/// @param observers each called as observer(i, state, k) after step k of member i (and returns what an
/// observer of integrate() may return); calls for different members may come at the same time, those for one
/// member come in order
/// @throws std::invalid_argument for a negative number of threads and for what integrate() refuses; whatever
///   an observer throws.
template <class State, class Make, class... Observers>
std::vector<Member<State>> ensemble(const Make& make, const std::vector<State>& starts, double h, Until until,
                                    int threads = 0, Observers&&... observers) {
  require(threads >= 0, "Number of threads", threads, "at least 0");
  std::vector<Member<State>> members;
  members.reserve(starts.size());
  for (const State& start : starts)
    members.push_back({.state = start, .run = {}});
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> thrown(starts.size());
  const auto follow = [&](std::size_t i) {
    Member<State>& member = members[i];
    std::optional<std::decay_t<decltype(make(member.state))>> method;
    try {
      method.emplace(make(member.state));
    } catch (const std::invalid_argument& error) {
      member.run = {.outcome = Outcome::stopped, .message = error.what()};
      return;
    }
    member.run = integrate(*method, member.state, h, until,
                           [&](const State& state, long k) { return observers(i, state, k); }...);
  };
  const auto work = [&] {
    for (std::size_t i = next++; i < starts.size(); i = next++) {
      try {
        follow(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    }
  };
  {
    const std::size_t most =
        threads > 0 ? static_cast<std::size_t>(threads) : std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> helpers;  // this thread works too
    for (std::size_t k = 1; k < std::min(most, starts.size()); ++k)
      helpers.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& error : thrown)
    if (error) std::rethrow_exception(error);
  return members;
}

}  // namespace avi
