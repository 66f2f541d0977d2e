#pragma once
#include "avi/diagnostics/drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

/// @file
/// When an energy counts as free of drift.

namespace experiment {

/// Energy errors at the times of a run.
struct ErrorSeries {
  std::vector<double> times, errors;
};

/// Does the energy drift?
struct DriftVerdict {
  /// Of the second half of a run of twice the length; not a number where none was needed.
  avi::DriftFit again{.slope = std::numeric_limits<double>::quiet_NaN(),
                      .standard_error = 1.0,
                      .t_statistic = std::numeric_limits<double>::quiet_NaN()};
  bool none = false;   ///< No drift beyond rounding.
  bool twice = false;  ///< The second run decided.
};

/// There is no drift where the slope of the first run up to `end` is within three of its standard errors, or
/// its change below `rounding`. Else the run is followed for twice its time, and what counts is the slope of
/// its second half: a drift goes on, a slow swing does not. @param longer returns the errors of that run
template <class Longer>
DriftVerdict judge_drift(const avi::DriftFit& first, double end, double rounding, const Longer& longer) {
  DriftVerdict verdict;
  const auto still = [](const avi::DriftFit& fit) { return std::abs(avi::corrected_t(fit)) < 3.0; };
  verdict.none = still(first) || std::abs(first.slope * end) < rounding;
  if (verdict.none) return verdict;
  verdict.twice = true;
  const ErrorSeries run = longer();
  const auto half = std::lower_bound(run.times.begin(), run.times.end(), end);
  const auto from = static_cast<std::size_t>(half - run.times.begin());
  verdict.again = avi::fit_drift(std::span(run.times).subspan(from), std::span(run.errors).subspan(from), 20);
  verdict.none = still(verdict.again);
  return verdict;
}

}  // namespace experiment
