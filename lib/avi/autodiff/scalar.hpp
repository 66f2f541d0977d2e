#pragma once
#include "avi/autodiff/functions.hpp"
#include "avi/core/power.hpp"
#include "avi/core/vector.hpp"

#include <cmath>
#include <type_traits>

/// @file
/// Operations common to all scalar types of formulas.

namespace avi {

namespace detail {
/// A vector of doubles in a SIMD register; the compiler splits it where the machine's registers are shorter.
template <int numbers, int alignment = 8 * numbers>
struct Simd {
  using type [[gnu::vector_size(8 * numbers), gnu::aligned(alignment)]] = double;
};
}  // namespace detail

/// The value of a scalar without its derivatives; a double has none.
inline double value_of(double x) { return x; }
/// The slope of |x|: 1 or -1, and at zero their mean, 0.
inline double sign_of(double x) { return x == 0.0 ? 0.0 : std::copysign(1.0, x); }

/// x where the condition holds, else y; a formula uses it in place of a branch on its arguments. Both x and y
/// are evaluated. The condition is a bool, or the result of comparing other scalars, whose type then provides
/// choose(c, x, y).
template <class Condition, class X, class Y>
constexpr auto select(const Condition& condition, const X& x, const Y& y) {
  if constexpr (std::is_same_v<Condition, bool>)
    return condition ? static_cast<std::common_type_t<X, Y>>(x) : static_cast<std::common_type_t<X, Y>>(y);
  else
    return choose(condition, x, y);
}

/// Base of a scalar type X: the assignments and choices that follow from its arithmetic and comparisons.
template <class X>
struct Scalar {
  ///@{

  /// a = a + b, and so on.
  friend X& operator+=(X& a, const X& b) { return a = a + b; }
  friend X& operator-=(X& a, const X& b) { return a = a - b; }
  friend X& operator*=(X& a, const X& b) { return a = a * b; }
  friend X& operator/=(X& a, const X& b) { return a = a / b; }
  ///@}

  ///@{

  /// As in the standard library for doubles. Where a = b, min and max have half of the slope of each.
  friend X min(const X& a, const X& b) { return select(b < a, b, select(b <= a, 0.5 * (a + b), a)); }
  friend X max(const X& a, const X& b) { return select(a < b, b, select(a <= b, 0.5 * (a + b), a)); }
  friend X fabs(const X& a) { return abs(a); }
  friend X operator+(const X& a) { return a; }
  ///@}
};

/// @cond
namespace detail {

// Recorded numbers keep a comparison as 1 or 0; these functions do the same for all other scalars.
template <class S>
S less(const S& a, const S& b) {
  return select(a < b, S(1.0), S(0.0));
}
template <class S>
S less_equal(const S& a, const S& b) {
  return select(a <= b, S(1.0), S(0.0));
}
template <class S>
S when(const S& condition, const S& a) {
  return select(S(0.0) < condition, a, S(0.0));
}

// The slopes of the table, as slope_of_sin(a, f) and slopes_of_pow<0 or 1>(a, b, f).
namespace slopes {
#define AVI_ROW(name, ...) using std::name;
AVI_FUNCTIONS(AVI_ROW, AVI_ROW)
#undef AVI_ROW
/// 1 - tanh(a)^2 without cancellation: 4 u / (1 + u)^2 with u = exp(-2 |a|), in which nothing overflows. The
/// function is even, so the slope of |a| at 0 does not affect its derivatives.
template <class S>
S one_over_cosh_squared(const S& a) {
  const S u = exp(-2.0 * abs(a)), inverse = 1.0 / (1.0 + u);
  return 4.0 * (u * (inverse * inverse));
}
/// b a^(b - 1), and 0 where a = b = 0. Where only b is 0, its own slope with respect to b is still 1 / a.
template <class S>
S slope_of_power(const S& a, const S& b) {
  // below 2^-1022, 1 / a may be infinite
  return when(less(S(0x1p-1022), abs(a) + abs(b)), b * pow(a, b - 1.0));
}
#define AVI_ONE(name, pack, shape, slope)                                                                    \
  template <class S>                                                                                         \
  S slope_of_##name([[maybe_unused]] const S& a, [[maybe_unused]] const S& f) {                              \
    return slope;                                                                                            \
  }
#define AVI_TWO(name, along_a, along_b)                                                                      \
  template <int operand, class S>                                                                            \
  S slopes_of_##name([[maybe_unused]] const S& a, [[maybe_unused]] const S& b,                               \
                     [[maybe_unused]] const S& f) {                                                          \
    if constexpr (operand == 0)                                                                              \
      return along_a;                                                                                        \
    else                                                                                                     \
      return along_b;                                                                                        \
  }
AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
}  // namespace slopes
}  // namespace detail
/// @endcond

/// Base of a number X that carries derivatives: its elementary functions and comparisons. X must provide
/// value_of(x), the number itself, and x.chain(f, slope), which is f with the derivatives
/// \f$f'(x)\,\partial_i x\f$, where slope() returns \f$f'(x)\f$.
template <class X>
struct ChainRule : Scalar<X> {
  /// x to a constant power, by the chain rule.
  friend X pow(const X& x, double exponent) {
    const auto value = value_of(x), f = power(value, exponent);
    if (exponent == 0.0) return X(f);
    // At zero f / x is undefined, although the derivative may exist.
    if constexpr (std::is_same_v<decltype(value), const double>)
      if (value != 0.0) return x.chain(f, [&] { return exponent * f / value; });
    return x.chain(f, [&] { return exponent * power(value, exponent - 1.0); });
  }
  /// @cond
#define AVI_ONE(name, ...)                                                                                   \
  friend X name(const X& x) {                                                                                \
    using std::name;                                                                                         \
    const auto& a = value_of(x);                                                                             \
    const auto f = name(a);                                                                                  \
    return x.chain(f, [&] { return detail::slopes::slope_of_##name(a, f); });                                \
  }
#define AVI_TWO(name, ...)                                                                                   \
  friend X name(const X& x, const X& y) {                                                                    \
    using std::name;                                                                                         \
    const auto &a = value_of(x), &b = value_of(y);                                                           \
    const auto f = name(a, b);                                                                               \
    return x.chain(f, [&] { return detail::slopes::slopes_of_##name<0>(a, b, f); }) +                        \
           y.chain(0.0, [&] { return detail::slopes::slopes_of_##name<1>(a, b, f); });                       \
  }
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  /// @endcond
  friend X sign_of(const X& x) { return X(sign_of(value_of(x))); }  ///< Sign of the value; its slope is 0.

  ///@{

  /// Comparisons of the values alone, so that a formula takes the same branch with and without derivatives.
  friend auto operator<(const X& a, const X& b) { return value_of(a) < value_of(b); }
  friend auto operator>(const X& a, const X& b) { return value_of(a) > value_of(b); }
  friend auto operator<=(const X& a, const X& b) { return value_of(a) <= value_of(b); }
  friend auto operator>=(const X& a, const X& b) { return value_of(a) >= value_of(b); }
  ///@}
};

}  // namespace avi

/// @cond
namespace Eigen {
// Lets Eigen combine vectors and matrices of doubles with those of any of our scalars.
template <class X, class Op>
requires(
    std::is_class_v<X>&& std::is_base_of_v<avi::Scalar<X>, X>) struct ScalarBinaryOpTraits<double, X, Op> {
  using ReturnType = X;
};
template <class X, class Op>
requires(
    std::is_class_v<X>&& std::is_base_of_v<avi::Scalar<X>, X>) struct ScalarBinaryOpTraits<X, double, Op> {
  using ReturnType = X;
};
}  // namespace Eigen
/// @endcond
