#pragma once
#include "avi/core/compiler.hpp"

#include <cmath>

/// @file
/// Powers with a constant exponent.

namespace avi {

/// x to a constant power. Exponents that are multiples of 1/2, up to 8 in size, use a square root and
/// products, several times faster than std::pow. The error grows with the exponent, to 6 units in the last
/// place at 8 and 7 at -8; negative powers are 0 where the positive one overflows. Other exponents use
/// std::pow.
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

/// x to a constant power, right to the last bit or nearly so. Whole exponents from 1 to 64 use products that
/// keep their rounding errors (Dekker 1971). This is as accurate as std::pow, but the processor can do it in
/// parallel with the evaluation of an objective, whereas std::pow makes it wait.
inline double accurate_power(double x, double exponent) {
  if (!(exponent >= 1.0 && exponent <= 64.0) || exponent != static_cast<int>(exponent))
    return std::pow(x, exponent);
  // the power so far, and x^(2^k), each as a sum of two numbers
  double high = 1.0, low = 0.0, square = x, rest = 0.0;
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

/// power() of any other scalar, by its own pow().
template <class S>
auto power(const S& x, double exponent) {
  using std::pow;  // without it, a long double would silently be converted to double
  return pow(x, exponent);
}

}  // namespace avi
