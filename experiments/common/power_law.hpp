#pragma once
#include "avi/diagnostics/drift.hpp"

#include <cmath>
#include <functional>
#include <vector>

// The exponent of a power law.

namespace experiment {

/// Fits y ~ x^a: the exponent a with its standard error, by least squares of the logarithms; NaN for fewer
/// than three points. @param counts says of (x, y) whether the point counts; without it all do
inline avi::DriftFit power_law(const std::vector<double>& x, const std::vector<double>& y,
                               const std::function<bool(double x, double y)>& counts = {}) {
  std::vector<double> log_x, log_y;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!counts || counts(x[i], y[i])) {
      log_x.push_back(std::log(x[i]));
      log_y.push_back(std::log(y[i]));
    }
  if (log_x.size() >= 3) return avi::fit_drift(log_x, log_y);
  return {.slope = std::nan(""), .standard_error = std::nan(""), .points = static_cast<int>(log_x.size())};
}

}  // namespace experiment
