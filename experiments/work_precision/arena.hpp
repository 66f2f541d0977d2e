#pragma once
#include "work_precision/clock.hpp"
#include "work_precision/family.hpp"

#include "avi/core/integrate.hpp"
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

/// make(problem, start) gives a fresh method; the setting is its step size.
template <class P, class Make>
Family ours(const Arena<P>& arena, std::string method, int order, Origin origin, std::string knob,
            std::vector<double> settings, Make make) {
  Family family{std::move(method), order, origin, std::move(knob), std::move(settings), {}};
  family.run = [arena, make](const Request& request) {
    constexpr int n = P::dimension;
    const avi::State<n>& start = arena.at(request.start);
    auto stepper = make(arena.problem, start);
    const avi::Until until{.time = arena.horizon, .steps = request.step_cap};
    avi::State<n> z = start;
    avi::Run run;
    Result result;
    if (request.watch_energy) {
      const double energy = arena.problem(z.q, z.p);
      run = avi::integrate(stepper, z, request.setting, until, [&](const avi::State<n>& s, long) {
        result.energy_error = std::max(result.energy_error, std::abs(arena.problem(s.q, s.p) - energy));
      });
    } else {
      result.seconds = block_seconds(
          [&] {
            z = start;
            run = avi::integrate(stepper, z, request.setting, until);
          },
          request.repeats);
    }
    result.ok = run.outcome == avi::Outcome::ok;
    result.q = z.q;
    result.t = z.t;
    result.steps = run.steps;
    result.evaluations = run.evaluations;
    if constexpr (requires { stepper.value_steps(); })
      result.polynomial = static_cast<double>(stepper.value_steps()) /
                          static_cast<double>(stepper.value_steps() + stepper.full_steps());
    return result;
  };
  return family;
}

}  // namespace experiment::work_precision
