#pragma once
#include "avi/core/vector.hpp"

#include <cmath>

/// @file
/// Sums whose order of addition is fixed in the source.
///
/// Eigen's reductions add in an order that depends on the machine's vector width, so the last bit of a sum
/// changes with -march=native, and with it the iteration counts of accelerated methods. The sums here add
/// eight partial sums as a tree on every machine. Element-wise Eigen expressions of +, - and * are the same
/// everywhere. Eigen's vectorised square root is not (on AVX-512 it is not correctly rounded), so the library
/// uses std::sqrt.

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

/// A vector to read, wherever its entries lie.
using VectorView = Eigen::Ref<const VectorX>;

/// Inner product of two vectors of equal size.
inline double dot(const VectorView& a, const VectorView& b) { return dot(a.data(), b.data(), a.size()); }

/// Euclidean norm.
inline double norm(const VectorView& a) { return std::sqrt(dot(a, a)); }

}  // namespace avi
