#pragma once
#include "avi/core/vector.hpp"

#include <cmath>

/// @file
/// Inner products and norms with a fixed order of addition.
///
/// Eigen adds in an order that depends on the vector width of the machine, so -march=native changes the last
/// bit of a sum, and with it the iteration counts of accelerated methods. The sums here form eight partial
/// sums and add them as a tree, on every machine. Element-wise Eigen expressions of +, - and * give the same
/// bits everywhere. Eigen's vectorised square root does not (with AVX-512 it is not correctly rounded), so
/// the library uses std::sqrt.

namespace avi {

/// Inner product of two arrays of n entries, the same to the last bit on every machine.
inline double dot(const double* a, const double* b, Eigen::Index n) {
  constexpr Eigen::Index lanes = 8;
  double sum[lanes] = {};
  Eigen::Index i = 0;
  for (; i + lanes <= n; i += lanes)
    for (Eigen::Index lane = 0; lane < lanes; ++lane)
      sum[lane] += a[i + lane] * b[i + lane];
  for (Eigen::Index lane = 0; i < n; ++i, ++lane)
    sum[lane] += a[i] * b[i];
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

/// A read-only view of a vector, without a copy.
using VectorView = Eigen::Ref<const VectorX>;

/// Inner product of two vectors of equal size.
inline double dot(const VectorView& a, const VectorView& b) { return dot(a.data(), b.data(), a.size()); }

/// Euclidean norm.
inline double norm(const VectorView& a) { return std::sqrt(dot(a, a)); }

}  // namespace avi
