#pragma once
#include <cmath>

/// @file
/// The elementary functions of the library: the one table from which all that is known of them follows.

// A function of one number a, whose value is f:
//
//   ONE(name, pack, work, slope)
//
// * name: that of <cmath>; its value at a double is std::name(a).
// * pack: side_by_side where Pack has code of its own, one_by_one where it calls std::name for each number.
// * work: of a call at a pack, in additions of packs: at_once(k), or each(k) for each of its numbers.
// * slope: df/da at any scalar, from a and f.
//
// A function of two numbers a and b, one by one and by slope:
//
//   TWO(name, work, slope along a, slope along b)
//
// Another row is another function: recording, gradients, programs, packs and series have it at once. What it
// must be tested with are the rows of tests/unit/elementary.hpp.
/// @cond
// clang-format off
#define AVI_FUNCTIONS(ONE, TWO)                                            \
  ONE(sqrt, side_by_side, at_once(2.0), 0.5 / f)                           \
  ONE(exp, side_by_side, at_once(20.0), f)                                 \
  ONE(log, side_by_side, at_once(25.0), 1.0 / a)                           \
  ONE(sin, side_by_side, at_once(30.0), cos(a))                            \
  ONE(cos, side_by_side, at_once(30.0), -sin(a))                           \
  ONE(tan, one_by_one, each(4.0), 1.0 + f * f)                             \
  ONE(sinh, one_by_one, each(4.0), cosh(a))                                \
  ONE(cosh, one_by_one, each(4.0), sinh(a))                                \
  ONE(tanh, one_by_one, each(4.0), 1.0 - f * f)                            \
  ONE(atan, one_by_one, each(4.0), 1.0 / (1.0 + a * a))                    \
  ONE(abs, side_by_side, at_once(1.0), sign_of(a))                         \
  ONE(asin, one_by_one, each(4.0), 1.0 / sqrt((1.0 - a) * (1.0 + a)))      \
  ONE(acos, one_by_one, each(4.0), -1.0 / sqrt((1.0 - a) * (1.0 + a)))     \
  ONE(asinh, one_by_one, each(4.0), 1.0 / hypot(1.0, a))                   \
  ONE(acosh, one_by_one, each(4.0), 1.0 / (sqrt(a - 1.0) * sqrt(a + 1.0))) \
  ONE(atanh, one_by_one, each(4.0), 1.0 / ((1.0 - a) * (1.0 + a)))         \
  ONE(cbrt, one_by_one, each(4.0), 1.0 / (3.0 * (f * f)))                  \
  ONE(expm1, one_by_one, each(4.0), exp(a))                                \
  ONE(log1p, one_by_one, each(4.0), 1.0 / (1.0 + a))                       \
  ONE(erf, one_by_one, each(4.0), M_2_SQRTPI * exp(-(a * a)))              \
  ONE(erfc, one_by_one, each(4.0), -M_2_SQRTPI * exp(-(a * a)))            \
  TWO(atan2, each(4.0), b / (a * a + b * b), -a / (a * a + b * b))         \
  TWO(hypot, each(4.0), a / f, b / f)                                      \
  TWO(pow, each(4.0), b * (f / a), f * log(a))
// clang-format on
/// @endcond

namespace avi::detail {

/// Cost of a call at a pack, in additions of packs.
struct Work {
  double fixed;       ///< Once.
  double per_number;  ///< For each number of the pack.
  /// At a pack of so many numbers.
  [[nodiscard]] constexpr double at(int numbers) const { return fixed + per_number * numbers; }
};
constexpr Work at_once(double additions) { return {additions, 0.0}; }  ///< For all numbers side by side.
constexpr Work each(double additions) { return {0.0, additions}; }     ///< One number after the other.

}  // namespace avi::detail
