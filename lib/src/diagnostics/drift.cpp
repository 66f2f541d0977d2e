#include "avi/diagnostics/drift.hpp"

#include "avi/core/require.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace avi {

double corrected_t(const DriftFit& fit) {
  const double r = std::max(0.0, fit.correlation);
  return fit.t_statistic * std::sqrt((1.0 - r) / (1.0 + r));
}

DriftFit fit_drift(std::span<const double> times, std::span<const double> values, int blocks) {
  require(times.size() == values.size(), "Number of values", values.size(), "the number of times");
  require(blocks >= 0, "Number of blocks", blocks, "at least 0");
  const std::size_t count = blocks > 0 ? static_cast<std::size_t>(blocks) : times.size();
  require(count >= 3 && count <= times.size(), "Number of points", count,
          "at least 3 and at most the length of the series");
  for (const double time : times)
    require_finite("Time of a point", time);
  std::vector<double> t(count), x(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * times.size() / count, end = (k + 1) * times.size() / count;
    for (std::size_t i = begin; i < end; ++i) {
      t[k] += times[i] / static_cast<double>(end - begin);
      x[k] += values[i] / static_cast<double>(end - begin);
    }
  }
  const double n = static_cast<double>(count);
  double mean_t = 0.0, mean_x = 0.0, tt = 0.0, tx = 0.0, rest = 0.0;
  for (std::size_t k = 0; k < count; ++k)
    mean_t += t[k] / n, mean_x += x[k] / n;
  // Averages of equal times may differ by rounding.
  const auto [first, last] = std::minmax_element(t.begin(), t.end());
  const double length = std::ceil(static_cast<double>(times.size()) / n);
  const double rounding = blocks > 0 ? length * std::numeric_limits<double>::epsilon() *
                                           std::max(std::abs(*first), std::abs(*last))
                                     : 0.0;
  const double spread = *last - *first <= rounding ? 0.0 : *last - *first;
  require(spread > 0.0 && std::isfinite(spread), "Spread of the times", spread, "positive and finite");
  // Numbers are taken in units of their size, powers of two, so that their squares are in range whatever the
  // units of the series.
  const auto centre = [&](std::vector<double>& of, double mean) {
    double size = 0.0;
    for (double& number : of)
      size = std::max(size, std::abs(number -= mean));
    const double unit = size > 0.0 && std::isfinite(size) ? std::ldexp(1.0, std::ilogb(size)) : 1.0;
    for (double& number : of)
      number /= unit;
    return unit;
  };
  const double unit_t = centre(t, mean_t), unit_x = centre(x, mean_x);
  for (std::size_t k = 0; k < count; ++k)
    tt += t[k] * t[k], tx += t[k] * x[k];
  const double slope = tx / tt;
  double before = 0.0, together = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double residual = x[k] - slope * t[k];
    together += residual * before;
    before = residual;
    rest += residual * residual;
  }
  const double error = std::sqrt(rest / (n - 2.0) / tt), unit = unit_x / unit_t;
  DriftFit fit{.slope = slope * unit, .standard_error = error * unit, .points = static_cast<int>(count)};
  if (slope != 0.0) fit.t_statistic = slope / error;
  if (rest > 0.0) fit.correlation = together / rest;
  return fit;
}

}  // namespace avi
