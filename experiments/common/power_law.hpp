#pragma once
#include "avi/diagnostics/drift.hpp"

#include <cmath>
#include <limits>
#include <vector>

// Powers with which something grows.

namespace experiment {

/// The power of x in y with its standard error, by least squares through the logarithms; NaN for both below
/// three points.
inline avi::DriftFit power_law(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (x.size() < 3) return {.slope = nan, .standard_error = nan, .points = static_cast<int>(x.size())};
  std::vector<double> log_x, log_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    log_x.push_back(std::log(x[i]));
    log_y.push_back(std::log(y[i]));
  }
  return avi::fit_drift(log_x, log_y);
}

}  // namespace experiment
