#pragma once
#include "avi/core/dot.hpp"

/// @file
/// Functions that tests of avi::minimise() share.

namespace objectives {

/// sum_i (i + 1) x_i^2 / 2.
inline double bowl(const avi::VectorX& x, avi::VectorX& g) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    g[i] = (1.0 + static_cast<double>(i)) * x[i];
  return 0.5 * avi::dot(x, g);
}

/// Rosenbrock's valley, minimum 0 at (1, 1).
inline double rosenbrock(const avi::VectorX& x, avi::VectorX& g) {
  const double a = x[1] - x[0] * x[0], b = 1.0 - x[0];
  g[0] = -400.0 * a * x[0] - 2.0 * b;
  g[1] = 200.0 * a;
  return 100.0 * a * a + b * b;
}

}  // namespace objectives
