#pragma once
#include "avi/diagnostics/drift.hpp"

#include <cmath>
#include <limits>
#include <vector>

// The exponent of a power law.

namespace experiment {

/// Fits y ~ x^a: the exponent a with its standard error, by least squares of the logarithms; NaN for fewer
/// than three points.
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
