#pragma once
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

/// Derivative of f at 0 by differences of fourth order, h apart.
double difference(const auto& f, double h) {
  return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}

/// By how much an entry of `gradient` is not the slope of f at x by such differences, at most.
double gradient_defect(const auto& f, const auto& x, const auto& gradient, double h) {
  double worst = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto along = [&](double shift) {
      auto moved = x;
      moved[i] += shift;
      return f(moved);
    };
    worst = std::max(worst, std::abs(difference(along, h) - gradient[i]));
  }
  return worst;
}
