#pragma once
#include "avi/problems/kepler.hpp"
#include "avi/solver.hpp"
#include "fuzz/step.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>

/// @file
/// Any numbers as what solve() is asked for: refused with a sentence, or an end that says what it is.

namespace fuzz {

inline void check(const avi::Solution<2>& found, const avi::State<2>& start, double end,
                  const std::vector<double>& times, long steps) {
  if (found.ok() != found.run.message.empty()) throw std::logic_error("A run without its end.");
  if (found.run.steps > steps) throw std::logic_error("A run of more steps than it may take.");
  if (found.kept() && (!found.ok() || !found.state.finite()))
    throw std::logic_error("A promise kept by a run that failed.");
  const double sense = end < start.t ? -1.0 : 1.0;
  if (found.ok() && !(sense * found.state.t <= sense * end))
    throw std::logic_error("A run that went past its end.");
  if (found.states.size() > times.size()) throw std::logic_error("More states than times.");
  for (std::size_t i = 0; i < found.states.size(); ++i)
    if (found.states[i].t != times[i] || !found.states[i].finite())
      throw std::logic_error("A state at another time, or none.");
  for (const auto& event : found.events)
    if (!event.state.finite() || event.index < 0 || event.index > 1)
      throw std::logic_error("An event that is none.");
  if (found.report().empty()) throw std::logic_error("Nothing to report.");
}

inline void door(const std::uint8_t* data, std::size_t size) {
  using namespace avi;
  Numbers in(data, size);
  const int which = in.byte();
  const State<2> z{.q = {in.real(), in.real()}, .p = {in.real(), in.real()}, .t = in.real()};
  const double end = in.real(), tolerance = in.real(), level = in.real();
  std::vector<double> times;
  for (int i = in.byte() % 4; i > 0; --i)
    times.push_back(in.real());
  constexpr const char* names[] = {"", "fixed", "energy", "energy^1.5", "poles", "acceleration", "none"};
  SolveOptions options{.check = (which & 8) != 0,
                       .sweeps = 20000,
                       .steps = 200,
                       .order = in.byte() % 20 - 1,
                       .monitor = names[in.byte() % 7],
                       .h = in.real(),
                       .dense = (which & 16) != 0};
  if (which & 32) options.order = 0, options.monitor = {}, options.h = 0.0;
  const EventRules rules{.direction = in.byte() % 4 - 1, .count = in.byte() % 4, .stop = in.byte() % 2 == 0};
  if (which & 4) {
    options.events.push_back(when([=](const auto& q, const auto&) { return q[0] - level; }, rules));
    options.events.push_back(
        when([=](const auto& q, const auto& t, const auto& p) { return q[1] * p[0] - level * t; }));
  }
  const auto driven = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * q[0] * q[0] - q[1] * cos(t);
  };
  try {
    switch (which % 4) {
    case 0:
      return check(solve(Kepler(), z, end, tolerance, options), z, end, {}, 200);
    case 1:
      return check(solve(Kepler(), z, times, tolerance, options), z, times.empty() ? z.t : times.back(),
                   times, 200);
    case 2:
      return check(solve(driven, z, times, tolerance, options), z, times.empty() ? z.t : times.back(), times,
                   200);
    default:
      return check(Solver(driven, z, end, tolerance, options).run(z, times), z,
                   times.empty() ? z.t : times.back(), times, 200);
    }
  } catch (const std::invalid_argument& refusal) {
    if (std::string(refusal.what()).empty()) throw std::logic_error("A refusal without a sentence.");
  }
}

}  // namespace fuzz
