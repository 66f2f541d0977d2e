#pragma once
#include <cmath>

/// @file
/// The elementary functions of the library: the one table from which all that is known of them follows.

// A function of one number a, whose value is f:
//
//   ONE(name, pack, slope)
//
// * name: that of <cmath>; its value at a double is std::name(a).
// * pack: side_by_side where Pack has code of its own, one_by_one where it calls std::name for each number.
// * slope: df/da at any scalar, from a and f.
//
// A function of two numbers a and b, one by one and by slope:
//
//   TWO(name, slope along a, slope along b)
//
// Slopes of pow are right at a = 0, too: there 0 * log(5e-324) is 0, where 0 * log(0) would be NaN, and
// slope_of_power(), b a^(b - 1), is 0 where b is 0 as well.
//
// Another row is another function: recording, gradients, programs, packs and series have it at once. What it
// must be tested with are the rows of tests/unit/elementary.hpp.
/// @cond
// clang-format off
#define AVI_FUNCTIONS(ONE, TWO)                                             \
  ONE(sqrt, side_by_side, 0.5 / f)                                          \
  ONE(exp, side_by_side, f)                                                 \
  ONE(log, side_by_side, 1.0 / a)                                           \
  ONE(sin, side_by_side, cos(a))                                            \
  ONE(cos, side_by_side, -sin(a))                                           \
  ONE(tan, one_by_one, 1.0 + f * f)                                         \
  ONE(sinh, one_by_one, cosh(a))                                            \
  ONE(cosh, one_by_one, sinh(a))                                            \
  ONE(tanh, one_by_one, one_over_cosh_squared(a))                           \
  ONE(atan, one_by_one, 1.0 / (1.0 + a * a))                                \
  ONE(abs, side_by_side, sign_of(a))                                        \
  ONE(asin, one_by_one, 1.0 / sqrt((1.0 - a) * (1.0 + a)))                  \
  ONE(acos, one_by_one, -1.0 / sqrt((1.0 - a) * (1.0 + a)))                 \
  ONE(asinh, one_by_one, 1.0 / hypot(1.0, a))                               \
  ONE(acosh, one_by_one, 1.0 / (sqrt(a - 1.0) * sqrt(a + 1.0)))             \
  ONE(atanh, one_by_one, 1.0 / ((1.0 - a) * (1.0 + a)))                     \
  ONE(cbrt, one_by_one, 1.0 / (3.0 * (f * f)))                              \
  ONE(expm1, one_by_one, exp(a))                                            \
  ONE(log1p, one_by_one, 1.0 / (1.0 + a))                                   \
  ONE(erf, one_by_one, M_2_SQRTPI * exp(-(a * a)))                          \
  ONE(erfc, one_by_one, -M_2_SQRTPI * exp(-(a * a)))                        \
  ONE(floor, one_by_one, 0.0 * a)                                           \
  TWO(atan2, b / hypot(a, b) / hypot(a, b), -a / hypot(a, b) / hypot(a, b)) \
  TWO(hypot, a / f, b / f)                                                  \
  TWO(pow, slope_of_power(a, b), f * log(a + 5e-324))
// clang-format on
/// @endcond
