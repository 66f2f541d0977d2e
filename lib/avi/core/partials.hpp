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
  S value{0.0};
  std::array<S, N> d{};

  Partials() { d.fill(S(0.0)); }
  Partials(double c) : value(c) { d.fill(S(0.0)); }  // NOLINT: implicit, so that formulas read as written
  Partials(const S& v) requires(!std::is_same_v<S, double>) : value(v) { d.fill(S(0.0)); }  // NOLINT

  /// f(x) with derivative df at the value.
  [[nodiscard]] Partials chain(const S& f, const S& df) const {
    Partials y;
    y.value = f;
    for (int i = 0; i < N; ++i)
      y.d[i] = df * d[i];
    return y;
  }

  friend Partials operator-(const Partials& a) {
    Partials c;
    c.value = -a.value;
    for (int i = 0; i < N; ++i)
      c.d[i] = -a.d[i];
    return c;
  }
  friend Partials operator+(const Partials& a, const Partials& b) {
    Partials c;
    c.value = a.value + b.value;
    for (int i = 0; i < N; ++i)
      c.d[i] = a.d[i] + b.d[i];
    return c;
  }
  friend Partials operator-(const Partials& a, const Partials& b) {
    Partials c;
    c.value = a.value - b.value;
    for (int i = 0; i < N; ++i)
      c.d[i] = a.d[i] - b.d[i];
    return c;
  }
  friend Partials operator*(const Partials& a, const Partials& b) {
    Partials c;
    c.value = a.value * b.value;
    for (int i = 0; i < N; ++i)
      c.d[i] = a.d[i] * b.value + a.value * b.d[i];
    return c;
  }
  friend Partials operator/(const Partials& a, const Partials& b) {
    Partials c;
    const S inverse = 1.0 / b.value;
    c.value = a.value * inverse;
    for (int i = 0; i < N; ++i)
      c.d[i] = (a.d[i] - c.value * b.d[i]) * inverse;
    return c;
  }
  Partials& operator+=(const Partials& b) { return *this = *this + b; }
  Partials& operator-=(const Partials& b) { return *this = *this - b; }
  Partials& operator*=(const Partials& b) { return *this = *this * b; }
  Partials& operator/=(const Partials& b) { return *this = *this / b; }

  friend bool operator<(const Partials& a, const Partials& b) { return a.value < b.value; }
  friend bool operator>(const Partials& a, const Partials& b) { return a.value > b.value; }
  friend bool operator<=(const Partials& a, const Partials& b) { return a.value <= b.value; }
  friend bool operator>=(const Partials& a, const Partials& b) { return a.value >= b.value; }
};

/// @name Elementary functions by the chain rule
/// @{
template <class S, int N>
Partials<S, N> sqrt(const Partials<S, N>& x) {
  using std::sqrt;
  const S s = sqrt(x.value);
  return x.chain(s, 0.5 / s);
}
template <class S, int N>
Partials<S, N> pow(const Partials<S, N>& x, double exponent) {
  const S f = power(x.value, exponent);
  if constexpr (std::is_same_v<S, double>) {
    if (x.value != 0.0) return x.chain(f, exponent * f / x.value);  // a division instead of a second power
  }
  return x.chain(f, exponent * power(x.value, exponent - 1.0));
}
template <class S, int N>
Partials<S, N> exp(const Partials<S, N>& x) {
  using std::exp;
  const S e = exp(x.value);
  return x.chain(e, e);
}
template <class S, int N>
Partials<S, N> log(const Partials<S, N>& x) {
  using std::log;
  return x.chain(log(x.value), 1.0 / x.value);
}
template <class S, int N>
Partials<S, N> sin(const Partials<S, N>& x) {
  using std::cos, std::sin;
  return x.chain(sin(x.value), cos(x.value));
}
template <class S, int N>
Partials<S, N> cos(const Partials<S, N>& x) {
  using std::cos, std::sin;
  return x.chain(cos(x.value), -sin(x.value));
}
template <class S, int N>
Partials<S, N> tan(const Partials<S, N>& x) {
  using std::tan;
  const S t = tan(x.value);
  return x.chain(t, 1.0 + t * t);
}
template <class S, int N>
Partials<S, N> sinh(const Partials<S, N>& x) {
  using std::cosh, std::sinh;
  return x.chain(sinh(x.value), cosh(x.value));
}
template <class S, int N>
Partials<S, N> cosh(const Partials<S, N>& x) {
  using std::cosh, std::sinh;
  return x.chain(cosh(x.value), sinh(x.value));
}
template <class S, int N>
Partials<S, N> tanh(const Partials<S, N>& x) {
  using std::tanh;
  const S t = tanh(x.value);
  return x.chain(t, 1.0 - t * t);
}
template <class S, int N>
Partials<S, N> atan(const Partials<S, N>& x) {
  using std::atan;
  return x.chain(atan(x.value), 1.0 / (1.0 + x.value * x.value));
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
  for (int i = 0; i < n; ++i) {
    seeded[i].value = x[i];
    seeded[i].d[i] = S(1.0);
  }
  return f(seeded);
}

/// Gradient of f: R^n -> R at x.
template <class F, class S, int n>
Vector<S, n> gradient(const F& f, const Vector<S, n>& x) {
  const Partials<S, n> y = value_and_gradient(f, x);
  Vector<S, n> g;
  for (int i = 0; i < n; ++i)
    g[i] = y.d[i];
  return g;
}

}  // namespace avi
