#pragma once
#include "avi/core/vector.hpp"

#include <cmath>
#include <utility>

/// @file
/// The inverse of a small matrix.

namespace avi {

/// b = the inverse of a square matrix a of any size, by Gauss-Jordan elimination with row pivoting; a is
/// overwritten. A singular matrix gives infinite or NaN entries. Plain loops are as fast as Eigen's blocked
/// factorisation at the sizes of mechanics, compile several seconds faster, and give the same bits on every
/// machine.
template <int n>
void invert(Matrix<double, n>& a, Matrix<double, n>& b) {
  const Eigen::Index size = a.rows();
  b.resize(size, size);
  for (Eigen::Index k = 0; k < size; ++k)
    for (Eigen::Index l = 0; l < size; ++l)
      b(l, k) = l == k ? 1.0 : 0.0;
  const auto swap_rows = [](Matrix<double, n>& m, Eigen::Index i, Eigen::Index j) {
    for (Eigen::Index l = 0; l < m.cols(); ++l)
      std::swap(m(i, l), m(j, l));
  };
  for (Eigen::Index k = 0; k < size; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < size; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    if (pivot != k) {
      swap_rows(a, k, pivot);
      swap_rows(b, k, pivot);
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
}

/// The inverse of a; in closed form up to n = 2.
template <int n>
Matrix<double, n> inverse(Matrix<double, n> a) {
  Matrix<double, n> b;
  if constexpr (n == 1) {
    b(0, 0) = 1.0 / a(0, 0);
  } else if constexpr (n == 2) {
    const double scale = 1.0 / (a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0));
    b(0, 0) = scale * a(1, 1);
    b(0, 1) = -scale * a(0, 1);
    b(1, 0) = -scale * a(1, 0);
    b(1, 1) = scale * a(0, 0);
  } else {
    invert(a, b);
  }
  return b;
}

}  // namespace avi
