#pragma once
#include "avi/autodiff/functions.hpp"
#include "avi/autodiff/recorded.hpp"

#include <cmath>
#include <map>
#include <string_view>

/// @file
/// What names of functions in the library, in NumPy and in scipy.special mean for recorded numbers.

namespace avi::python {

using One = Recorded (*)(const Recorded&);
using Two = Recorded (*)(const Recorded&, const Recorded&);

/// log(exp(a) + exp(b)), also where they are large; the slopes are right where a = b, too.
inline Recorded logaddexp(const Recorded& a, const Recorded& b) {
  const Recorded larger = select(a < b, b, a), smaller = select(a < b, a, b);
  return larger + log1p(exp(smaller - larger));
}

/// 1 / (1 + exp(-a)), and exp(a) / (1 + exp(a)) where a is negative: no power overflows, nor do the slopes.
inline Recorded expit(const Recorded& a) {
  const Recorded e = exp(select(a < 0.0, a, -a));
  return select(a < 0.0, e, 1.0) / (1.0 + e);
}

/// sin(y) / y, by its series where |y| < 1: next to zero the slopes of the quotient are differences of large
/// numbers.
inline Recorded sinc(const Recorded& y) {
  const Recorded square = y * y;
  Recorded series = 1.0;
  for (double k = 20.0; k > 0.0; k -= 2.0)
    series = 1.0 - square * series / (k * (k + 1.0));
  const Recorded away = select(square < 1.0, 1.0, y);
  return select(square < 1.0, series, sin(away) / away);
}

/// The nearest whole number, of two the even one, as everywhere in IEEE 754; all numbers are whole from 2^52
/// on.
inline Recorded rint(const Recorded& a) {
  const Recorded near = floor(a + 0.5), odd = near - 2.0 * floor(0.5 * near);
  return select(abs(a) < 0x1p52, select(0.5 <= near - a, near - odd, near), a);
}

// clang-format off
/// Functions of one number.
inline const std::map<std::string_view, One> ones = {
#define AVI_ROW(name, value) {#name, [](const Recorded& a) -> Recorded { return value; }},
#define AVI_ONE(name, ...) AVI_ROW(name, name(a))
#define AVI_TWO(...)
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  AVI_ROW(arcsin, asin(a)) AVI_ROW(arccos, acos(a)) AVI_ROW(arctan, atan(a))
  AVI_ROW(arcsinh, asinh(a)) AVI_ROW(arccosh, acosh(a)) AVI_ROW(arctanh, atanh(a))
  AVI_ROW(absolute, abs(a)) AVI_ROW(fabs, abs(a)) AVI_ROW(sign, less(0.0, a) - less(a, 0.0))
  AVI_ROW(negative, -a) AVI_ROW(positive, a) AVI_ROW(conjugate, a)
  AVI_ROW(square, a * a) AVI_ROW(reciprocal, 1.0 / a)
  AVI_ROW(exp2, exp(M_LN2 * a)) AVI_ROW(log2, log(a) / M_LN2) AVI_ROW(log10, log(a) / M_LN10)
  AVI_ROW(deg2rad, (M_PI / 180.0) * a) AVI_ROW(radians, (M_PI / 180.0) * a)
  AVI_ROW(rad2deg, (180.0 / M_PI) * a) AVI_ROW(degrees, (180.0 / M_PI) * a)
  AVI_ROW(expit, expit(a)) AVI_ROW(sinc, sinc(M_PI * a))
  AVI_ROW(logical_not, 1.0 - a) AVI_ROW(invert, 1.0 - a)
  AVI_ROW(ceil, -floor(-a)) AVI_ROW(trunc, select(a < 0.0, -floor(-a), floor(a))) AVI_ROW(rint, rint(a))
#undef AVI_ROW
};
/// Functions of two.
inline const std::map<std::string_view, Two> twos = {
#define AVI_ROW(name, value) {#name, [](const Recorded& a, const Recorded& b) -> Recorded { return value; }},
#define AVI_ONE(...)
#define AVI_TWO(name, ...) AVI_ROW(name, name(a, b))
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  AVI_ROW(add, a + b) AVI_ROW(subtract, a - b) AVI_ROW(multiply, a * b) AVI_ROW(divide, a / b)
  AVI_ROW(power, pow(a, b)) AVI_ROW(float_power, pow(a, b)) AVI_ROW(arctan2, atan2(a, b))
  AVI_ROW(maximum, max(a, b)) AVI_ROW(minimum, min(a, b)) AVI_ROW(fmax, max(a, b)) AVI_ROW(fmin, min(a, b))
  AVI_ROW(logaddexp, logaddexp(a, b))
  AVI_ROW(less, less(a, b)) AVI_ROW(less_equal, less_equal(a, b))
  AVI_ROW(greater, less(b, a)) AVI_ROW(greater_equal, less_equal(b, a))
  AVI_ROW(logical_and, when(a, b)) AVI_ROW(bitwise_and, when(a, b))
  AVI_ROW(logical_or, max(a, b)) AVI_ROW(bitwise_or, max(a, b))
  AVI_ROW(remainder, a - b * floor(a / b)) AVI_ROW(floor_divide, floor(a / b))
  AVI_ROW(heaviside, select(a < 0.0, 0.0, select(0.0 < a, 1.0, b)))
#undef AVI_ROW
};
// clang-format on

}  // namespace avi::python
