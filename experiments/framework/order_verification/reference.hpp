#pragma once
#include "avi/core/state.hpp"
#include "avi/transform/poincare.hpp"

#include <array>

/// @file
/// Where a transformed problem is at a given fictive time, by a method that shares nothing with an HTVI.

namespace experiment {

/// (q, p, t) in extended precision.
template <int n>
using ExtendedPoint = avi::Vector<long double, 2 * n + 1>;

/// The point at fictive time `horizon` by Gragg's midpoint rule, extrapolated to order 16 (Gragg 1965), in
/// extended precision: 200 steps leave less than 1e-16 on the problems of this experiment.
template <class Problem>
ExtendedPoint<Problem::dimension> extended_reference(const Problem& problem,
                                                     const avi::State<Problem::dimension>& start,
                                                     double horizon, int steps = 200) {
  constexpr int n = Problem::dimension, columns = 8;
  using Point = ExtendedPoint<n>;
  const auto field = [&](const Point& z) {
    const avi::Vector<long double, n> q = z.template head<n>(), p = z.template segment<n>(n);
    avi::Vector<long double, n> dq, dp;
    long double dt;
    problem.template field<avi::Field::full>(q, p, static_cast<long double>(problem.energy_momentum()), dq,
                                             dp, dt);
    Point dz;
    dz << dq, -dp, dt;
    return dz;
  };
  Point z;
  z << start.q.template cast<long double>(), start.p.template cast<long double>(),
      static_cast<long double>(start.t);
  const long double big = static_cast<long double>(horizon) / steps;
  for (int k = 0; k < steps; ++k) {
    std::array<Point, columns> row;
    for (int j = 0; j < columns; ++j) {
      const int parts = 2 * (j + 1);
      const long double h = big / parts;
      Point before = z, now = z + h * field(z);
      for (int i = 1; i < parts; ++i) {
        const Point next = before + 2.0L * h * field(now);
        before = now;
        now = next;
      }
      Point entry = 0.5L * (before + now + h * field(now));
      // Neville's scheme in h^2: row[i] holds the entry of column i of the row before.
      for (int i = 1; i <= j; ++i) {
        const long double ratio = static_cast<long double>(j + 1) / (j + 1 - i);
        const Point better = entry + (entry - row[i - 1]) / (ratio * ratio - 1.0L);
        row[i - 1] = entry;
        entry = better;
      }
      row[j] = entry;
    }
    z = row[columns - 1];
  }
  return z;
}

}  // namespace experiment
