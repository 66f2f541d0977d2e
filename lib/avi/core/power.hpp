#pragma once
#include <cmath>

/// @file
/// Powers with a constant exponent.

namespace avi {

/// x^exponent. For half integers up to 8 by square root and multiplication, several times faster than
/// std::pow and as accurate; any other exponent goes to std::pow.
inline double power(double x, double exponent) {
  const double twice = 2.0 * exponent;
  if (twice != std::round(twice) || std::abs(twice) > 16.0) return std::pow(x, exponent);
  const int m = static_cast<int>(std::abs(twice));
  double y = m % 2 ? std::sqrt(x) : 1.0;
  double square = x;
  for (int k = m / 2; k > 0; k /= 2, square *= square)
    if (k % 2) y *= square;
  return twice < 0.0 ? 1.0 / y : y;
}

/// The same at any other scalar, through its own pow.
template <class S>
auto power(const S& x, double exponent) {
  using std::pow;  // without it, a long double would silently go through double
  return pow(x, exponent);
}

}  // namespace avi
