#pragma once
#include "avi/core/power.hpp"

#include <cmath>
#include <compare>
#include <type_traits>

/// @file
/// What the scalars that formulas are called with have in common.

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

/// The assignments that follow from a scalar's operations; X derives from it.
template <class X>
struct Scalar {
  ///@{

  /// a = a + b, and so on.
  friend X& operator+=(X& a, const X& b) { return a = a + b; }
  friend X& operator-=(X& a, const X& b) { return a = a - b; }
  friend X& operator*=(X& a, const X& b) { return a = a * b; }
  friend X& operator/=(X& a, const X& b) { return a = a / b; }
  ///@}
};

/// Elementary functions and comparisons of a number that carries derivatives; X derives from it. It has
/// value_of(x), the number itself, and x.chain(f, slope), which is f with the derivatives
/// \f$f'(x)\,\partial_i x\f$, where \f$f'(x)\f$ is what slope() returns.
template <class X>
struct ChainRule : Scalar<X> {
  ///@{

  /// By the chain rule.
  friend X sqrt(const X& x) {
    using std::sqrt;
    const auto f = sqrt(value_of(x));
    return x.chain(f, [&] { return 0.5 / f; });
  }
  friend X pow(const X& x, double exponent) {
    const auto value = value_of(x), f = power(value, exponent);
    // At zero the quotient f / x is undefined where the derivative may well exist.
    if constexpr (std::is_same_v<decltype(value), const double>)
      if (value != 0.0) return x.chain(f, [&] { return exponent * f / value; });
    return x.chain(f, [&] { return exponent * power(value, exponent - 1.0); });
  }
  friend X exp(const X& x) {
    using std::exp;
    const auto f = exp(value_of(x));
    return x.chain(f, [&] { return f; });
  }
  friend X log(const X& x) {
    using std::log;
    return x.chain(log(value_of(x)), [&] { return 1.0 / value_of(x); });
  }
  friend X sin(const X& x) {
    using std::cos, std::sin;
    return x.chain(sin(value_of(x)), [&] { return cos(value_of(x)); });
  }
  friend X cos(const X& x) {
    using std::cos, std::sin;
    return x.chain(cos(value_of(x)), [&] { return -sin(value_of(x)); });
  }
  friend X tan(const X& x) {
    using std::tan;
    const auto f = tan(value_of(x));
    return x.chain(f, [&] { return 1.0 + f * f; });
  }
  friend X sinh(const X& x) {
    using std::cosh, std::sinh;
    return x.chain(sinh(value_of(x)), [&] { return cosh(value_of(x)); });
  }
  friend X cosh(const X& x) {
    using std::cosh, std::sinh;
    return x.chain(cosh(value_of(x)), [&] { return sinh(value_of(x)); });
  }
  friend X tanh(const X& x) {
    using std::tanh;
    const auto f = tanh(value_of(x));
    return x.chain(f, [&] { return 1.0 - f * f; });
  }
  friend X atan(const X& x) {
    using std::atan;
    const auto value = value_of(x);
    return x.chain(atan(value), [&] { return 1.0 / (1.0 + value * value); });
  }
  friend X abs(const X& x) {
    using std::abs;
    return x.chain(abs(value_of(x)), [&] { return sign_of(value_of(x)); });
  }
  friend X sign_of(const X& x) { return X(sign_of(value_of(x))); }
  ///@}

  /// Of the values alone: a formula with derivatives branches as it does without.
  friend auto operator<=>(const X& a, const X& b) { return value_of(a) <=> value_of(b); }
};

}  // namespace avi
