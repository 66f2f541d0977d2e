#pragma once
#include "beyond/speed/work_precision/clock.hpp"
#include "beyond/speed/work_precision/family.hpp"
#include "common/methods/runner.hpp"

#include "avi/core/state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

/// @file
/// A problem with its starts, and families of our own methods on it.

namespace experiment::work_precision {

template <class P>
struct Arena {
  using Problem = P;
  static constexpr int n = P::dimension;
  P problem;
  double horizon;
  std::array<avi::State<n>, starts> start;

  /// The start and eight neighbours: its first coordinate moved by -4e-14 ... 4e-14.
  Arena(P problem_, double horizon_, const avi::State<n>& middle)
      : problem(std::move(problem_)), horizon(horizon_) {
    for (int k = 0; k < starts; ++k) {
      start[static_cast<std::size_t>(k)] = middle;
      start[static_cast<std::size_t>(k)].q[0] += (k - starts / 2) * 1e-14;
    }
  }

  [[nodiscard]] const avi::State<n>& at(int k) const { return start[static_cast<std::size_t>(k)]; }
};

/// One run of a method of ours, as a request wants it.
template <int n>
Result run_as(const Request& request, const RunnerOf<n>& runner, double horizon, const avi::State<n>& start) {
  const avi::Until until{.time = horizon, .steps = request.step_cap};
  avi::State<n> z = start;
  avi::Run run;
  Result result;
  if (request.watch_energy) {
    const double energy = runner.energy(start);
    run = runner.advance(start, z, request.setting, until, [&](const avi::State<n>& s) {
      result.energy_error = std::max(result.energy_error, std::abs(runner.energy(s) - energy));
      return true;
    });
  } else {
    const auto timed = runner.prepare(start);
    result.seconds = block_seconds(
        [&] {
          z = start;
          run = timed(z, request.setting, until);
        },
        request.repeats);
  }
  result.ok = run.outcome == avi::Outcome::ok;
  result.q = z.q;
  result.t = z.t;
  result.steps = run.steps;
  result.evaluations = run.evaluations;
  return result;
}

/// make(problem, start) gives a fresh method; the setting is its step size.
template <class P, class Make>
Family ours(const Arena<P>& arena, std::string method, int order, Origin origin, std::string knob,
            std::vector<double> settings, Make make) {
  const RunnerOf<P::dimension> runner(
      arena.problem, [problem = arena.problem, make](const auto& start) { return make(problem, start); });
  return {std::move(method),
          order,
          origin,
          std::move(knob),
          std::move(settings),
          [arena, runner](const Request& request) {
            return run_as(request, runner, arena.horizon, arena.at(request.start));
          }};
}

}  // namespace experiment::work_precision
