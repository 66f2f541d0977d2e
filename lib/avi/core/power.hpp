#pragma once
#include "avi/core/compiler.hpp"

#include <cmath>

/// @file
/// Powers with a constant exponent.

namespace avi {

/// x^exponent. For half integers up to 8 by square root and multiplication, several times faster than
/// std::pow; the error grows with the exponent, to 6 units in the last place at 8 and 7 at -8, and negative
/// powers are 0 where the positive one overflows. Any other exponent goes to std::pow.
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

/// x^exponent to the last bit or nearly so. For whole exponents from 1 to 64 by products that keep their
/// rounding errors (Dekker 1971): as accurate as std::pow, but the processor works on it beside the
/// evaluation of an objective, where it has to wait for std::pow.
inline double accurate_power(double x, double exponent) {
  if (!(exponent >= 1.0 && exponent <= 64.0) || exponent != static_cast<int>(exponent))
    return std::pow(x, exponent);
  double high = 1.0, low = 0.0, square = x, rest = 0.0;  // the power so far and x^(2^k), as unevaluated sums
  for (int n = static_cast<int>(exponent);;) {
    if (n % 2) {
      const double product = high * square;
      low = std::fma(high, square, -product) + (high * rest + low * square);
      high = product;
    }
    if ((n /= 2) == 0) return std::isnan(low) ? high : high + low;  // an overflow has no error to add
    const double product = square * square;
    rest = std::fma(square, square, -product) + 2.0 * square * rest;
    square = product;
  }
}

/// power() at any other scalar, through its own pow.
template <class S>
auto power(const S& x, double exponent) {
  using std::pow;  // without it, a long double would silently go through double
  return pow(x, exponent);
}

}  // namespace avi
