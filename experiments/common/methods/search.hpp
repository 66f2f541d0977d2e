#pragma once
#include "common/methods/attempt.hpp"

#include <functional>

/// @file
/// The step with which a run does what is wanted.

namespace experiment {

/// What the search for the largest step found.
struct Largest {
  double h = std::nan("");  ///< NaN when every step down to where the cap on steps ended the run failed.
  Attempt at;               ///< The run with h.
  double h_beyond = std::nan("");
  Attempt beyond;  ///< The shortest step found to fail, and its run.
};

/// The largest step with which a run succeeds: halves h from `coarse` until a run from `start` does, then
/// bisects in log h until the step is known within `precision` (0.02: two per cent). Ends without a result
/// where a run meets the cap on steps.
Largest largest_step(const Runner& runner, const State2& start, double coarse, const Limits& limits,
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
