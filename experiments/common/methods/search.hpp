#pragma once
#include "common/methods/method_of_orbit.hpp"
#include "common/methods/phase.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

// Runs that may fail, and searches for the step with which a run succeeds.

namespace experiment {

/// How far a run goes, and which errors end it.
struct Limits {
  double time;
  long steps;
  double energy_error;            ///< Bound on |H - H_0| / |H_0|; beyond it the run is given up.
  double phase_error = HUGE_VAL;  ///< Bound on the phase error at the end, for Kepler's problem, in radians.
};

/// How a run ended.
struct Attempt {
  avi::Run run;
  State2 end;                 ///< The last valid state.
  double energy_error = 0.0;  ///< Largest |H - H_0| / |H_0| after any step.
  bool late = false;          ///< The run reached the end time, but with a phase error beyond its bound.

  /// True if the run reached the end within all bounds.
  [[nodiscard]] bool good() const { return run.outcome == avi::Outcome::ok && !late; }
  /// `ok`; `energy` or `phase` if that bound was exceeded; otherwise the name of the outcome.
  [[nodiscard]] std::string ending() const {
    if (run.outcome == avi::Outcome::stopped) return "energy";
    return run.outcome == avi::Outcome::ok && late ? "phase" : std::string(avi::name(run.outcome));
  }
};

/// One run with step h.
inline Attempt attempt(const Method2& runner, const State2& start, double h, const Limits& limits) {
  Attempt made{.run = {}, .end = start};
  const double first = runner.energy(start);
  avi::AnyMethod<2> method = runner.make(start);
  made.run = avi::integrate(method, made.end, h, {.time = limits.time, .steps = limits.steps},
                            [&](const State2& z, long) {
                              const double error = std::abs((runner.energy(z) - first) / first);
                              if (!(error <= made.energy_error)) made.energy_error = error;
                              return error <= limits.energy_error;
                            });
  made.late =
      std::isfinite(limits.phase_error) && !(std::abs(phase_error(start, made.end)) <= limits.phase_error);
  return made;
}

/// The result of the search for the largest step.
struct Largest {
  double h = std::nan("");  ///< NaN if no run succeeded; see largest_step().
  Attempt at;               ///< The run with h.
  double h_beyond = std::nan("");
  Attempt beyond;  ///< The shortest step found to fail, and its run.
};

/// The largest step with which a run succeeds. h is halved from `coarse` until a run from `start` succeeds,
/// and then bisected in log h to the relative `precision` (0.02: two per cent). There is no result if one
/// of the runs that fail while h is halved reaches the limit on steps, or h falls below 1e-15 `coarse`.
inline Largest largest_step(const Method2& runner, const State2& start, double coarse, const Limits& limits,
                            double precision = 0.02) {
  Largest found;
  for (double h = coarse;; h *= 0.5) {
    Attempt made = attempt(runner, start, h, limits);
    if (made.good()) {
      found.h = h;
      found.at = std::move(made);
      break;
    }
    found.h_beyond = h;
    found.beyond = std::move(made);
    if (found.beyond.run.outcome == avi::Outcome::step_limit || h < coarse * 1e-15) return found;
  }
  if (std::isnan(found.h_beyond)) return found;
  while (found.h_beyond > (1.0 + precision) * found.h) {
    const double h = std::sqrt(found.h * found.h_beyond);
    Attempt made = attempt(runner, start, h, limits);
    (made.good() ? found.h : found.h_beyond) = h;
    (found.h == h ? found.at : found.beyond) = std::move(made);
  }
  return found;
}

/// Settings of matched_step().
struct Match {
  double order;                  ///< The error is roughly proportional to this power of the step.
  double within = 0.02;          ///< Accepted |log(error / target)|.
  int tries = 60;                ///< Largest number of runs.
  double longest = HUGE_VAL;     ///< Largest factor for a step; a longer step may break down.
  double too_coarse = HUGE_VAL;  ///< For errors above this multiple of the target, h is simply halved.
};

/// The step h at which error(h) equals `target`. h is corrected in logarithms by means of the order. If that
/// would leave the interval between the last steps below and above the target, the middle of the interval (in
/// log h) is used. @return the step with the nearest error; NaN if no error was near enough to be compared,
/// or if error(h) is NaN, which ends the search
inline double matched_step(const std::function<double(double h)>& error, double target, double h,
                           const Match& match) {
  double best = std::nan(""), distance = HUGE_VAL, below = best, above = best;
  for (int k = 0; k < match.tries; ++k) {
    const double ratio = error(h) / target;
    if (std::isnan(ratio)) return std::nan("");
    (ratio > 1.0 ? above : below) = h;
    if (ratio > match.too_coarse) {
      h *= 0.5;
    } else {
      const double off = std::abs(std::log(ratio));
      if (off < distance) distance = off, best = h;
      if (off < match.within) break;
      h *= std::min(std::pow(ratio, -1.0 / match.order), match.longest);
    }
    // Near the limit of stability the error grows much faster than its order suggests, and the correction
    // would jump from one side of the target to the other for ever.
    if (!(h > std::min(below, above) && h < std::max(below, above)) && std::isfinite(below * above))
      h = std::sqrt(below * above);
  }
  return best;
}

}  // namespace experiment
