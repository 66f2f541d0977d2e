#pragma once
#include "common/methods/method_of_orbit.hpp"
#include "common/methods/phase.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

// Runs that may fail, and the step with which one does what is wanted.

namespace experiment {

/// How far a run goes, and what it must not exceed on the way.
struct Limits {
  double time;
  long steps;
  double energy_error;            ///< |H - H_0| / |H_0| beyond which the run is given up.
  double phase_error = HUGE_VAL;  ///< Error of the phase at the end, on Kepler's problem, in radians.
};

/// How a run ended.
struct Attempt {
  avi::Run run;
  State2 end;                 ///< The last good state.
  double energy_error = 0.0;  ///< Largest |H - H_0| / |H_0| after any step.
  bool late = false;          ///< Reached the end, but elsewhere on its orbit.

  /// Reached the end within every bound.
  [[nodiscard]] bool good() const { return run.outcome == avi::Outcome::ok && !late; }
  /// `ok`, `energy` or `phase` where that bound was exceeded, else the outcome's name.
  [[nodiscard]] std::string ending() const {
    if (run.outcome == avi::Outcome::stopped) return "energy";
    return run.outcome == avi::Outcome::ok && late ? "phase" : std::string(avi::name(run.outcome));
  }
};

/// A whole run with step h.
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
  double h = std::nan("");  ///< NaN where every run failed down to the one that met the cap on steps.
  Attempt at;               ///< The run with h.
  double h_beyond = std::nan("");
  Attempt beyond;  ///< The shortest step found to fail, and its run.
};

/// The largest step with which a run succeeds: halves h from `coarse` until a run from `start` does, then
/// bisects in log h until the step is known within `precision` (0.02: two per cent). Ends without a result
/// where a run meets the cap on steps.
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

/// How the search for a given error goes on.
struct Match {
  double order;                  ///< The error is about proportional to this power of the step.
  double within = 0.02;          ///< Accepted |log(error / target)|.
  int tries = 60;                ///< Runs at the most.
  double longest = HUGE_VAL;     ///< A step is multiplied by this at the most; a longer one may break down.
  double too_coarse = HUGE_VAL;  ///< Errors above this many targets say only that h is to be halved.
};

/// The step h at which error(h) is `target`: corrected on logarithms by the order, and halfway (in log h)
/// between the last steps below and above the target where that would leave them. Returns the step whose
/// error came nearest, NaN where none was near enough to be judged or error(h) is NaN, which gives up.
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
    // Where the error grows much faster than its order, as near the limit of stability, the correction would
    // jump from one side of the target to the other for ever.
    if (!(h > std::min(below, above) && h < std::max(below, above)) && std::isfinite(below * above))
      h = std::sqrt(below * above);
  }
  return best;
}

}  // namespace experiment
