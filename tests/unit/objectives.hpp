#pragma once
#include "avi/core/dot.hpp"

#include <algorithm>

/// @file
/// Functions that tests of avi::minimise() share.

namespace objectives {

/// sum_i (i + 1) x_i^2 / 2.
inline double bowl(const avi::VectorX& x, avi::VectorX& g) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    g[i] = (1.0 + static_cast<double>(i)) * x[i];
  return 0.5 * avi::dot(x, g);
}

/// Rosenbrock's valley in any dimension, minimum 0 at (1, ..., 1).
inline double rosenbrock(const avi::VectorX& x, avi::VectorX& g) {
  double f = 0.0;
  g.setZero();
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i) {
    const double a = x[i + 1] - x[i] * x[i], b = 1.0 - x[i];
    f += 100.0 * a * a + b * b;
    g[i] += -400.0 * a * x[i] - 2.0 * b;
    g[i + 1] += 200.0 * a;
  }
  return f;
}

/// The same as a formula.
inline const auto valley = [](const auto& x) {
  auto sum = x[0] * 0.0;
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i) {
    const auto a = x[i + 1] - x[i] * x[i], b = 1.0 - x[i];
    sum += 100.0 * a * a + b * b;
  }
  return sum;
};

/// sum_i (10 max(0, x_i - 1 - i)^2 + max(0, -x_i)^2) / 2, and a slope of -1/10 for odd i: the second
/// derivative jumps.
inline double hinges(const avi::VectorX& x, avi::VectorX& g) {
  double f = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double high = std::max(0.0, x[i] - 1.0 - static_cast<double>(i)), low = std::max(0.0, -x[i]),
                 slope = i % 2 == 0 ? 0.0 : -0.1;
    f += 5.0 * high * high + 0.5 * low * low + slope * x[i];
    g[i] = 10.0 * high - low + slope;
  }
  return f;
}

}  // namespace objectives
