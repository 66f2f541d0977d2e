#pragma once
#include "common/methods/phase.hpp"
#include "common/methods/runner.hpp"

#include <cmath>
#include <string>

/// @file
/// Runs that may fail.

namespace experiment {

/// How far a run goes, and what it must not exceed on the way.
struct Limits {
  double time;
  long steps;
  double energy_error;            ///< |H - H_0| / |H_0| beyond which the run is given up.
  double phase_error = HUGE_VAL;  ///< Of the end, on Kepler's problem, in radians.
};

/// How a run ended.
struct Attempt {
  avi::Run run;
  State2 end;                    ///< The last good state.
  double energy_error = 0.0;     ///< Largest |H - H_0| / |H_0| after any step.
  double least_step = HUGE_VAL;  ///< In physical time, the last step left out.
  bool late = false;             ///< Reached the end, but elsewhere on its orbit.

  /// Reached the end within every bound.
  [[nodiscard]] bool good() const { return run.outcome == avi::Outcome::ok && !late; }
  /// `ok`, `energy` or `phase` where that bound was exceeded, else the outcome's name.
  [[nodiscard]] std::string ending() const;
};

/// A whole run with step h.
Attempt attempt(const Runner& runner, const State2& start, double h, const Limits& limits);

}  // namespace experiment
