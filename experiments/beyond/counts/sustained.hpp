#pragma once
#include "bregman/setting.hpp"

#include <algorithm>
#include <cmath>

// When the stopping test holds permanently, as opposed to the first time.

namespace experiment {

/// A witness that applies the stopping test to a run without end (delta = 0 in its Stopping). It ends the run
/// once the test has held for as many iterations as had passed before, or at `cap`.
struct Sustained {
  static constexpr double delta = 1e-10;
  long cap = 4'000'000;

  long first = 0;          ///< Iteration at which the test first held; 0: never.
  long last_failure = 0;   ///< Last iteration at which the test did not hold.
  double rebound = 0.0;    ///< Largest f within the 5 % of iterations after the first passage.
  double at_first = 0.0;   ///< f at the first passage.
  bool confirmed = false;  ///< The test held for as long as the run had lasted before.
  double before = std::nan("");

  bool operator()(const avi::Iterate& at, long k, long) {
    const bool holds = std::abs(at.value - before) < delta && avi::norm(at.gradient) < delta;
    before = at.value;
    if (!holds) last_failure = k;
    if (holds && first == 0) {
      first = k;
      at_first = at.value;
    }
    if (first > 0 && k > first && k <= 1.05 * first) rebound = std::max(rebound, at.value);
    confirmed = first > 0 && k >= 2 * last_failure && k > first + first / 20;
    return !confirmed && k < cap;
  }

  /// First iteration from which the test always holds.
  [[nodiscard]] long sustained() const { return last_failure + 1; }
};

}  // namespace experiment
