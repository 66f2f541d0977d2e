#pragma once
#include "avi/core/finite_math.hpp"

#include <Eigen/Core>

#include <cmath>
#include <type_traits>

/// @file
/// Vectors and matrices of any scalar: the only linear-algebra names the rest of the library uses.

namespace avi {

/// Dimension known only at run time.
inline constexpr int dynamic = Eigen::Dynamic;

namespace detail {
// A scalar that is a SIMD register brings its own alignment, wider than the one Eigen would ask for; without
// vector units to match, the two would contradict each other.
template <class S>
inline constexpr int storage = std::is_arithmetic_v<S> ? Eigen::ColMajor : Eigen::ColMajor | Eigen::DontAlign;

/// |v|^2 at any scalar.
template <class V>
auto squared_norm(const V& v) {
  auto sum = v[0] * v[0];
  for (Eigen::Index i = 1; i < v.size(); ++i)
    sum += v[i] * v[i];
  return sum;
}
}  // namespace detail

/// Column vector of n entries of scalar S (n may be avi::dynamic).
template <class S, int n>
using Vector = Eigen::Matrix<S, n, 1, detail::storage<S>>;

/// Vector of numbers whose size is known only at run time.
using VectorX = Vector<double, dynamic>;

/// Matrix of m x n entries of scalar S.
template <class S, int m, int n = m>
using Matrix = Eigen::Matrix<S, m, n, detail::storage<S>>;

/// Entries first, first + 1, ... of x. A loop compiles faster than Eigen's segments.
template <int n = dynamic, class S>
Vector<S, n> part(const Vector<S, dynamic>& x, Eigen::Index first, Eigen::Index count) {
  Vector<S, n> y(count);
  for (Eigen::Index i = 0; i < count; ++i)
    y[i] = x[first + i];
  return y;
}

/// Largest magnitude of an entry; NaN where one is.
template <int n>
double largest_entry(const Vector<double, n>& x) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    most = std::abs(x[i]) <= most || most != most ? most : std::abs(x[i]);
  return most;
}

}  // namespace avi
