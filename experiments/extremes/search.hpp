#pragma once
#include "extremes/attempt.hpp"

#include <algorithm>

/// @file
/// The largest step with which a run succeeds.

namespace experiment {

/// What the search found.
struct Largest {
  double h = std::nan("");  ///< NaN when every step down to where the cap on steps ended the run failed.
  Attempt at;               ///< The run with h.
  double h_beyond = std::nan("");
  Attempt beyond;  ///< The shortest step found to fail, and its run.
};

/// Halves h from `coarse` until a run from `start` succeeds, then bisects in log h until the step is known
/// within `precision` (0.02: two per cent). Ends without a result where a run meets the cap on steps.
inline Largest largest_step(const Runner& run, const State2& start, double coarse, const Limits& limits,
                            double precision = 0.02) {
  Largest found;
  for (double h = coarse;; h *= 0.5) {
    Attempt attempt = run(start, h, limits);
    if (attempt.good()) {
      found.h = h;
      found.at = std::move(attempt);
      break;
    }
    found.h_beyond = h;
    found.beyond = std::move(attempt);
    if (found.beyond.run.outcome == avi::Outcome::step_limit || h < coarse * 1e-15) return found;
  }
  if (std::isnan(found.h_beyond)) return found;
  while (found.h_beyond > (1.0 + precision) * found.h) {
    const double h = std::sqrt(found.h * found.h_beyond);
    Attempt attempt = run(start, h, limits);
    (attempt.good() ? found.h : found.h_beyond) = h;
    (found.h == h ? found.at : found.beyond) = std::move(attempt);
  }
  return found;
}

}  // namespace experiment
