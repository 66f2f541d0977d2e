#pragma once
#include "avi/core/vector.hpp"

#include <cmath>
#include <utility>

/// @file
/// The inverse of a small matrix.

namespace avi {

/// The inverse of a square matrix: in closed form for n = 2, otherwise by Gauss-Jordan elimination with row
/// pivoting. A singular matrix gives infinite or NaN entries. For the small matrices of mechanics, plain
/// loops are as fast as Eigen's blocked factorisation, compile several seconds faster, and give the same bits
/// on every machine.
template <int n>
Matrix<double, n> inverse(Matrix<double, n> a) {
  const Eigen::Index size = a.rows();
  Matrix<double, n> b(size, size);
  if constexpr (n == 2) {
    const double scale = 1.0 / (a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0));
    b(0, 0) = scale * a(1, 1);
    b(0, 1) = -scale * a(0, 1);
    b(1, 0) = -scale * a(1, 0);
    b(1, 1) = scale * a(0, 0);
    return b;
  }
  for (Eigen::Index k = 0; k < size; ++k)
    for (Eigen::Index l = 0; l < size; ++l)
      b(l, k) = l == k ? 1.0 : 0.0;
  for (Eigen::Index k = 0; k < size; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < size; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    for (Eigen::Index l = 0; pivot != k && l < size; ++l) {
      std::swap(a(k, l), a(pivot, l));
      std::swap(b(k, l), b(pivot, l));
    }
    const double scale = 1.0 / a(k, k);
    for (Eigen::Index l = 0; l < size; ++l) {
      a(k, l) *= scale;
      b(k, l) *= scale;
    }
    for (Eigen::Index i = 0; i < size; ++i) {
      if (i == k) continue;
      const double factor = a(i, k);
      for (Eigen::Index l = 0; l < size; ++l) {
        a(i, l) -= factor * a(k, l);
        b(i, l) -= factor * b(k, l);
      }
    }
  }
  return b;
}

}  // namespace avi
