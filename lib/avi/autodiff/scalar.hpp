#pragma once
#include "avi/autodiff/functions.hpp"
#include "avi/core/power.hpp"
#include "avi/core/vector.hpp"

#include <cmath>
#include <type_traits>

/// @file
/// Operations that all scalars of formulas have in common.

namespace avi {

namespace detail {
/// A vector of doubles that the compiler splits where the machine's registers are shorter.
template <int numbers, int alignment = 8 * numbers>
struct Simd {
  using type [[gnu::vector_size(8 * numbers), gnu::aligned(alignment)]] = double;
};
}  // namespace detail

/// A number without derivatives is its own value.
inline double value_of(double x) { return x; }
/// 1 or -1, the slope of |x|.
inline double sign_of(double x) { return std::copysign(1.0, x); }

/// x where the condition holds, else y: what a formula writes instead of a branch on its arguments. Both are
/// evaluated. The condition is a bool, or what comparisons of another scalar give, which brings choose(c, x,
/// y).
template <class Condition, class X, class Y>
constexpr auto select(const Condition& condition, const X& x, const Y& y) {
  if constexpr (std::is_same_v<Condition, bool>)
    return condition ? static_cast<std::common_type_t<X, Y>>(x) : static_cast<std::common_type_t<X, Y>>(y);
  else
    return choose(condition, x, y);
}

/// The assignments and choices that follow from a scalar's operations; X derives from it.
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

  /// As of the standard library for doubles.
  friend X min(const X& a, const X& b) { return select(b < a, b, a); }
  friend X max(const X& a, const X& b) { return select(a < b, b, a); }
  friend X fabs(const X& a) { return abs(a); }
  friend X operator+(const X& a) { return a; }
  ///@}
};

/// @cond
namespace detail {

// What scalars other than recorded numbers make of comparisons that are kept as 1 or 0.
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

// The slopes of the table: slope_of_sin(a, f), slopes_of_pow<0 or 1>(a, b, f).
namespace slopes {
#define AVI_ROW(name, ...) using std::name;
AVI_FUNCTIONS(AVI_ROW, AVI_ROW)
#undef AVI_ROW
/// 1 - tanh(a)^2 without its cancellation: 4 u / (1 + u)^2 with u = exp(-2 |a|), of which nothing overflows.
/// It is even, so that the side that |a| is taken on changes no derivative.
template <class S>
S one_over_cosh_squared(const S& a) {
  const S u = exp(-2.0 * abs(a)), inverse = 1.0 / (1.0 + u);
  return 4.0 * (u * (inverse * inverse));
}
/// b a^(b - 1), and 0 where a and b are 0. Where b alone is 0 it has a slope of its own, 1 / a by b.
template <class S>
S slope_of_power(const S& a, const S& b) {
  return when(less(S(0x1p-1022), abs(a) + abs(b)), b * pow(a, b - 1.0));  // below it 1 / a may be infinite
}
#define AVI_ONE(name, pack, slope)                                                                           \
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

/// Elementary functions and comparisons of a number that carries derivatives; X derives from it. It has
/// value_of(x), the number itself, and x.chain(f, slope), which is f with the derivatives
/// \f$f'(x)\,\partial_i x\f$, where \f$f'(x)\f$ is what slope() returns.
template <class X>
struct ChainRule : Scalar<X> {
  /// By the chain rule.
  friend X pow(const X& x, double exponent) {
    const auto value = value_of(x), f = power(value, exponent);
    if (exponent == 0.0) return X(f);
    // At zero the quotient f / x is undefined where the derivative may well exist.
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

  /// Comparisons of the values alone: a formula with derivatives branches as it does without.
  friend auto operator<(const X& a, const X& b) { return value_of(a) < value_of(b); }
  friend auto operator>(const X& a, const X& b) { return value_of(a) > value_of(b); }
  friend auto operator<=(const X& a, const X& b) { return value_of(a) <= value_of(b); }
  friend auto operator>=(const X& a, const X& b) { return value_of(a) >= value_of(b); }
  ///@}
};

}  // namespace avi

/// @cond
namespace Eigen {
// Vectors and matrices of doubles stand beside those of every scalar.
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
