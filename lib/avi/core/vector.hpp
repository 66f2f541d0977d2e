#pragma once
#include <Eigen/Core>

/// @file
/// Vectors and matrices of any scalar: the only linear-algebra names the rest of the library uses.

namespace avi {

/// Dimension known only at run time.
inline constexpr int dynamic = Eigen::Dynamic;

/// Column vector of n entries of scalar S (n may be avi::dynamic).
template <class S, int n>
using Vector = Eigen::Matrix<S, n, 1>;

/// Matrix of m x n entries of scalar S.
template <class S, int m, int n = m>
using Matrix = Eigen::Matrix<S, m, n>;

}  // namespace avi
