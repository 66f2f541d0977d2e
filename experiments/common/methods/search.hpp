#pragma once
#include "common/methods/method_of_orbit.hpp"

#include <cmath>
#include <functional>
#include <string>

/// @file
/// Runs that may fail, and the step with which one does what is wanted.

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
  [[nodiscard]] std::string ending() const;
};

/// A whole run with step h.
Attempt attempt(const Method2& runner, const State2& start, double h, const Limits& limits);

/// The result of the search for the largest step.
struct Largest {
  double h = std::nan("");  ///< NaN where every run failed down to the one that met the cap on steps.
  Attempt at;               ///< The run with h.
  double h_beyond = std::nan("");
  Attempt beyond;  ///< The shortest step found to fail, and its run.
};

/// The largest step with which a run succeeds: halves h from `coarse` until a run from `start` does, then
/// bisects in log h until the step is known within `precision`. None where a run meets the cap on steps.
Largest largest_step(const Method2& runner, const State2& start, double coarse, const Limits& limits,
                     double precision = 0.02);

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
double matched_step(const std::function<double(double h)>& error, double target, double h,
                    const Match& match);

}  // namespace experiment
