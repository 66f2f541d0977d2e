#pragma once
#include "avi/core/power.hpp"
#include "avi/core/vector.hpp"

#include <array>
#include <cmath>

/// @file
/// First derivatives of a callable that is generic in its scalar, with respect to chosen directions.

namespace avi {

/// A value of scalar S with its derivatives along N directions, also of scalar S: the automatic gradient of a
/// formula at any scalar, a Taylor series included. It nests.
template <class S, int N>
class Partials {
 public:
  S value{0.0};          ///< The number itself.
  std::array<S, N> d{};  ///< Derivatives along the N directions, unless `constant`; partial() reads both.
  bool constant = true;  ///< All of d vanish identically; what follows from that is never computed.

  Partials() = default;
  /// A constant.
  Partials(double c) : value(c) {}  // NOLINT: implicit, so that formulas read as written
  /// A constant.
  Partials(const S& v) requires(!std::is_same_v<S, double>) : value(v) {}  // NOLINT

  /// A value with derivative `slope` along direction i and none along the others.
  static Partials variable(const S& v, int i, const S& slope = S(1.0)) {
    Partials x(v);
    x.d.fill(S(0.0));
    x.d[i] = slope;
    x.constant = false;
    return x;
  }

  /// Derivative along direction i.
  [[nodiscard]] S partial(int i) const { return constant ? S(0.0) : d[i]; }

  /// f(x) with its derivative at the value, given by a callable that is not called for a constant.
  template <class Slope>
  [[nodiscard]] Partials chain(const S& f, Slope slope) const {
    Partials y(f);
    if (!constant) {
      const S df = slope();
      y.assign([&](int i) { return df * d[i]; });
    }
    return y;
  }

  ///@{

  /// By the rules for sums, products and quotients; derivatives that vanish identically are not computed.
  friend Partials operator-(const Partials& a) {
    Partials c(-a.value);
    if (!a.constant) c.assign([&](int i) { return -a.d[i]; });
    return c;
  }
  friend Partials operator+(const Partials& a, const Partials& b) {
    Partials c(a.value + b.value);
    if (a.constant && b.constant) return c;
    if (a.constant)
      c.assign([&](int i) { return b.d[i]; });
    else if (b.constant)
      c.assign([&](int i) { return a.d[i]; });
    else
      c.assign([&](int i) { return a.d[i] + b.d[i]; });
    return c;
  }
  friend Partials operator-(const Partials& a, const Partials& b) {
    Partials c(a.value - b.value);
    if (a.constant && b.constant) return c;
    if (a.constant)
      c.assign([&](int i) { return -b.d[i]; });
    else if (b.constant)
      c.assign([&](int i) { return a.d[i]; });
    else
      c.assign([&](int i) { return a.d[i] - b.d[i]; });
    return c;
  }
  friend Partials operator*(const Partials& a, const Partials& b) {
    Partials c(a.value * b.value);
    if (a.constant && b.constant) return c;
    if (a.constant)
      c.assign([&](int i) { return a.value * b.d[i]; });
    else if (b.constant)
      c.assign([&](int i) { return a.d[i] * b.value; });
    else
      c.assign([&](int i) { return a.d[i] * b.value + a.value * b.d[i]; });
    return c;
  }
  friend Partials operator/(const Partials& a, const Partials& b) {
    const S inverse = 1.0 / b.value;
    if (b.constant) return a * Partials(inverse);
    Partials c(a.value * inverse);
    if (a.constant) {
      const S slope = c.value * inverse;
      c.assign([&](int i) { return -(slope * b.d[i]); });
    } else {
      c.assign([&](int i) { return (a.d[i] - c.value * b.d[i]) * inverse; });
    }
    return c;
  }
  Partials& operator+=(const Partials& b) { return *this = *this + b; }
  Partials& operator-=(const Partials& b) { return *this = *this - b; }
  Partials& operator*=(const Partials& b) { return *this = *this * b; }
  Partials& operator/=(const Partials& b) { return *this = *this / b; }
  ///@}

  ///@{

  /// Of the values alone: a formula with derivatives branches as it does without.
  friend bool operator<(const Partials& a, const Partials& b) { return a.value < b.value; }
  friend bool operator>(const Partials& a, const Partials& b) { return a.value > b.value; }
  friend bool operator<=(const Partials& a, const Partials& b) { return a.value <= b.value; }
  friend bool operator>=(const Partials& a, const Partials& b) { return a.value >= b.value; }
  ///@}

 private:
  template <class Entry>
  void assign(Entry entry) {
    for (int i = 0; i < N; ++i)
      d[i] = entry(i);
    constant = false;
  }
};

/// @name Elementary functions by the chain rule
/// @{

/// \f$f(x)\f$ with the derivatives \f$f'(x)\,\partial_i x\f$.
template <class S, int N>
Partials<S, N> sqrt(const Partials<S, N>& x) {
  using std::sqrt;
  const S s = sqrt(x.value);
  return x.chain(s, [&]() -> S { return 0.5 / s; });
}
template <class S, int N>
Partials<S, N> pow(const Partials<S, N>& x, double exponent) {
  const S f = power(x.value, exponent);
  if constexpr (std::is_same_v<S, double>) {
    // a division instead of a second power
    if (x.value != 0.0) return x.chain(f, [&] { return exponent * f / x.value; });
  }
  return x.chain(f, [&]() -> S { return exponent * power(x.value, exponent - 1.0); });
}
template <class S, int N>
Partials<S, N> exp(const Partials<S, N>& x) {
  using std::exp;
  const S e = exp(x.value);
  return x.chain(e, [&]() -> S { return e; });
}
template <class S, int N>
Partials<S, N> log(const Partials<S, N>& x) {
  using std::log;
  return x.chain(log(x.value), [&]() -> S { return 1.0 / x.value; });
}
template <class S, int N>
Partials<S, N> sin(const Partials<S, N>& x) {
  using std::cos, std::sin;
  return x.chain(sin(x.value), [&]() -> S { return cos(x.value); });
}
template <class S, int N>
Partials<S, N> cos(const Partials<S, N>& x) {
  using std::cos, std::sin;
  return x.chain(cos(x.value), [&]() -> S { return -sin(x.value); });
}
template <class S, int N>
Partials<S, N> tan(const Partials<S, N>& x) {
  using std::tan;
  const S t = tan(x.value);
  return x.chain(t, [&]() -> S { return 1.0 + t * t; });
}
template <class S, int N>
Partials<S, N> sinh(const Partials<S, N>& x) {
  using std::cosh, std::sinh;
  return x.chain(sinh(x.value), [&]() -> S { return cosh(x.value); });
}
template <class S, int N>
Partials<S, N> cosh(const Partials<S, N>& x) {
  using std::cosh, std::sinh;
  return x.chain(cosh(x.value), [&]() -> S { return sinh(x.value); });
}
template <class S, int N>
Partials<S, N> tanh(const Partials<S, N>& x) {
  using std::tanh;
  const S t = tanh(x.value);
  return x.chain(t, [&]() -> S { return 1.0 - t * t; });
}
template <class S, int N>
Partials<S, N> atan(const Partials<S, N>& x) {
  using std::atan;
  return x.chain(atan(x.value), [&]() -> S { return 1.0 / (1.0 + x.value * x.value); });
}
template <class S, int N>
Partials<S, N> abs(const Partials<S, N>& x) {
  return x.value < S(0.0) ? -x : x;
}
/// @}

/// f: R^n -> R at x with its gradient, for any scalar S and compile-time n.
template <class F, class S, int n>
Partials<S, n> value_and_gradient(const F& f, const Vector<S, n>& x) {
  Vector<Partials<S, n>, n> seeded;
  for (int i = 0; i < n; ++i)
    seeded[i] = Partials<S, n>::variable(x[i], i);
  return f(seeded);
}

/// Gradient of f: R^n -> R at x.
template <class F, class S, int n>
Vector<S, n> gradient(const F& f, const Vector<S, n>& x) {
  const Partials<S, n> y = value_and_gradient(f, x);
  Vector<S, n> g;
  for (int i = 0; i < n; ++i)
    g[i] = y.partial(i);
  return g;
}

}  // namespace avi
