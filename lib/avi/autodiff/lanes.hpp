#pragma once
#include "avi/core/power.hpp"

#include <bit>
#include <cmath>
#include <type_traits>

/// @file
/// A number with its first-order partial derivatives, held in one SIMD register where the machine has one.

namespace avi {

namespace detail {
// Written out: GCC ignores vector_size when it depends on a template parameter.
template <int width>
struct Simd;
template <>
struct Simd<2> {
  typedef double type __attribute__((vector_size(16)));
};
template <>
struct Simd<4> {
  typedef double type __attribute__((vector_size(32)));
};
template <>
struct Simd<8> {
  typedef double type __attribute__((vector_size(64)));
};
/// With weaker alignment, so that any memory may hold it.
struct LooseSimd8 {
  typedef double type __attribute__((vector_size(64), aligned(16)));
};
template <>
struct Simd<16> {
  typedef double type __attribute__((vector_size(128)));
};
template <>
struct Simd<32> {
  typedef double type __attribute__((vector_size(256)));
};
}  // namespace detail

/// Number of partials computed at a time where their total is known only at run time; such Lanes live in
/// containers with the usual alignment only.
inline constexpr int lane_chunk = 7;

/// Value (lane 0) and N first partials (lanes 1 to N) of a function of N variables; the chain rule is applied
/// by every operation (forward-mode automatic differentiation; Griewank and Walther 2008, chapter 3).
template <int N>
class Lanes {
 public:
  /// Numbers in a register: N + 1, rounded up to a power of 2.
  static constexpr int width = static_cast<int>(std::bit_ceil(static_cast<unsigned>(N) + 1u));
  /// GCC's vector of that width, which the compiler splits where the machine's registers are shorter.
  using Register =
      typename std::conditional_t<N == lane_chunk, detail::LooseSimd8, detail::Simd<width>>::type;

  Register lanes;  ///< Value, partials, padding.

  Lanes() = default;
  // Written out so that a copy is one register move: the compiler may copy a struct in pieces, and reloading
  // them as one register stalls the processor.
  Lanes(const Lanes& other) : lanes(other.lanes) {}  ///< One register move.
  /// One register move.
  Lanes& operator=(const Lanes& other) {
    lanes = other.lanes;
    return *this;
  }
  /// A constant: all partials are zero.
  Lanes(double value) : lanes{} { lanes[0] = value; }  // NOLINT: implicit, so that formulas read as written
  explicit Lanes(Register r) : lanes(r) {}             ///< From its register.

  /// The variable number i (0-based) of the N, at `value`.
  static Lanes variable(double value, int i) {
    Lanes x(value);
    x.lanes[i + 1] = 1.0;
    return x;
  }

  [[nodiscard]] double value() const { return lanes[0]; }             ///< The number itself.
  [[nodiscard]] double partial(int i) const { return lanes[i + 1]; }  ///< By variable i (0-based).

  /// f(x) with derivative df at the value of x.
  [[nodiscard]] Lanes chain(double f, double df) const {
    Lanes y(df * lanes);
    y.lanes[0] = f;
    return y;
  }

  ///@{

  /// By the rules for sums, products and quotients.
  Lanes& operator+=(const Lanes& b) {
    lanes += b.lanes;
    return *this;
  }
  Lanes& operator-=(const Lanes& b) {
    lanes -= b.lanes;
    return *this;
  }

  friend Lanes operator-(const Lanes& a) { return Lanes(-a.lanes); }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.lanes + b.lanes); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.lanes - b.lanes); }
  friend Lanes operator*(double a, const Lanes& b) { return Lanes(a * b.lanes); }
  friend Lanes operator*(const Lanes& a, double b) { return Lanes(a.lanes * b); }
  friend Lanes operator/(const Lanes& a, double b) { return Lanes(a.lanes / b); }
  friend Lanes operator+(const Lanes& a, double b) {
    Lanes c = a;
    c.lanes[0] += b;
    return c;
  }
  friend Lanes operator+(double a, const Lanes& b) { return b + a; }
  friend Lanes operator-(const Lanes& a, double b) { return a + (-b); }
  friend Lanes operator-(double a, const Lanes& b) { return -b + a; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    Lanes c(a.lanes[0] * b.lanes + b.lanes[0] * a.lanes);
    c.lanes[0] = a.lanes[0] * b.lanes[0];
    return c;
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return a * (1.0 / b); }
  friend Lanes operator/(double a, const Lanes& b) {
    const double inverse = 1.0 / b.lanes[0];
    return b.chain(a * inverse, -a * inverse * inverse);
  }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  Lanes& operator/=(const Lanes& b) { return *this = *this / b; }
  ///@}

  ///@{

  /// Of the values alone: a formula with derivatives branches as it does without.
  friend bool operator<(const Lanes& a, const Lanes& b) { return a.lanes[0] < b.lanes[0]; }
  friend bool operator>(const Lanes& a, const Lanes& b) { return a.lanes[0] > b.lanes[0]; }
  friend bool operator<=(const Lanes& a, const Lanes& b) { return a.lanes[0] <= b.lanes[0]; }
  friend bool operator>=(const Lanes& a, const Lanes& b) { return a.lanes[0] >= b.lanes[0]; }
  ///@}
};

/// The number itself, without derivatives.
inline double value_of(double x) { return x; }
/// The number itself, without derivatives.
template <int N>
double value_of(const Lanes<N>& x) {
  return x.value();
}

/// @name Elementary functions by the chain rule
/// @{

/// \f$f(x)\f$ with the partials \f$f'(x)\,\partial_i x\f$.
template <int N>
Lanes<N> sqrt(const Lanes<N>& x) {
  const double s = std::sqrt(x.value());
  return x.chain(s, 0.5 / s);
}
template <int N>
Lanes<N> pow(const Lanes<N>& x, double exponent) {
  const double f = power(x.value(), exponent);
  // At zero the quotient f / x is undefined where the derivative may well exist.
  return x.chain(f, x.value() != 0.0 ? exponent * f / x.value()
                                     : exponent * std::pow(x.value(), exponent - 1.0));
}
template <int N>
Lanes<N> exp(const Lanes<N>& x) {
  const double e = std::exp(x.value());
  return x.chain(e, e);
}
template <int N>
Lanes<N> log(const Lanes<N>& x) {
  return x.chain(std::log(x.value()), 1.0 / x.value());
}
template <int N>
Lanes<N> sin(const Lanes<N>& x) {
  return x.chain(std::sin(x.value()), std::cos(x.value()));
}
template <int N>
Lanes<N> cos(const Lanes<N>& x) {
  return x.chain(std::cos(x.value()), -std::sin(x.value()));
}
template <int N>
Lanes<N> tan(const Lanes<N>& x) {
  const double t = std::tan(x.value());
  return x.chain(t, 1.0 + t * t);
}
template <int N>
Lanes<N> sinh(const Lanes<N>& x) {
  return x.chain(std::sinh(x.value()), std::cosh(x.value()));
}
template <int N>
Lanes<N> cosh(const Lanes<N>& x) {
  return x.chain(std::cosh(x.value()), std::sinh(x.value()));
}
template <int N>
Lanes<N> tanh(const Lanes<N>& x) {
  const double t = std::tanh(x.value());
  return x.chain(t, 1.0 - t * t);
}
template <int N>
Lanes<N> atan(const Lanes<N>& x) {
  return x.chain(std::atan(x.value()), 1.0 / (1.0 + x.value() * x.value()));
}
template <int N>
Lanes<N> abs(const Lanes<N>& x) {
  return x.value() < 0.0 ? -x : x;
}
/// @}

}  // namespace avi
