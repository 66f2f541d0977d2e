#pragma once
#include <cmath>

/// @file
/// The table of elementary functions that formulas may use. Everything else about them is derived from it.

// A row ONE(name, pack, shape, slope) is a function f of one number a, with
//
// * name: as in <cmath>; the value for a double is std::name(a).
// * pack: side_by_side where Pack has code of its own, one_by_one where it calls std::name for each number.
// * shape: what it does apart from that, see detail::shapes.
// * slope: df/da for any scalar, in terms of a and f.
//
// A row TWO(name, slope along a, slope along b) is a function f of two numbers a and b; packs call std::name
// for each pair.
//
// The slopes of pow are also right at a = 0: f log(a + 5e-324) is 0 there, where 0 * log(0) would be NaN, and
// slope_of_power(), b a^(b - 1), is 0 where b is 0 as well.
//
// A new row adds a function to recording, gradients, programs, packs and series; the shape tells the choice
// of steps what to look for. Its test formula goes into tests/unit/elementary.hpp.
/// @cond
// clang-format off
#define AVI_FUNCTIONS(ONE, TWO)                                             \
  ONE(sqrt, side_by_side, plain, 0.5 / f)                                        \
  ONE(exp, side_by_side, turns | positive, f)                                    \
  ONE(log, side_by_side, plain, 1.0 / a)                                         \
  ONE(sin, side_by_side, vanishes, cos(a))                                       \
  ONE(cos, side_by_side, plain, -sin(a))                                         \
  ONE(tan, one_by_one, vanishes, 1.0 + f * f)                                    \
  ONE(sinh, one_by_one, vanishes | turns | abrupt, cosh(a))                      \
  ONE(cosh, one_by_one, turns | positive | abrupt, sinh(a))                      \
  ONE(tanh, one_by_one, vanishes | turns | abrupt, one_over_cosh_squared(a))     \
  ONE(atan, one_by_one, vanishes | turns, 1.0 / (1.0 + a * a))                   \
  ONE(abs, side_by_side, vanishes | kinked, sign_of(a))                          \
  ONE(asin, one_by_one, vanishes, 1.0 / sqrt((1.0 - a) * (1.0 + a)))             \
  ONE(acos, one_by_one, plain, -1.0 / sqrt((1.0 - a) * (1.0 + a)))               \
  ONE(asinh, one_by_one, vanishes | turns, 1.0 / hypot(1.0, a))                  \
  ONE(acosh, one_by_one, plain, 1.0 / (sqrt(a - 1.0) * sqrt(a + 1.0)))           \
  ONE(atanh, one_by_one, vanishes, 1.0 / ((1.0 - a) * (1.0 + a)))                \
  ONE(cbrt, one_by_one, plain, 1.0 / (3.0 * (f * f)))                            \
  ONE(expm1, one_by_one, vanishes | turns, exp(a))                               \
  ONE(log1p, one_by_one, vanishes | turns, 1.0 / (1.0 + a))                      \
  ONE(erf, one_by_one, vanishes | turns | abrupt, M_2_SQRTPI * exp(-(a * a)))    \
  ONE(erfc, one_by_one, turns | abrupt, -M_2_SQRTPI * exp(-(a * a)))             \
  ONE(floor, one_by_one, kinked, 0.0 * a)                                        \
  TWO(atan2, b / hypot(a, b) / hypot(a, b), -a / hypot(a, b) / hypot(a, b))      \
  TWO(hypot, a / f, b / f)                                                       \
  TWO(pow, slope_of_power(a, b), f * log(a + 5e-324))
// clang-format on
/// @endcond
