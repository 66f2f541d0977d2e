#pragma once
#include "avi/autodiff/scalar.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

/// @file
/// Partials: a number with its first derivatives along chosen directions, for any scalar.

namespace avi {

/// A value of scalar S with its derivatives along N directions, also of scalar S. It gives the automatic
/// gradient of a formula for any scalar, including Taylor series, and can be nested.
template <class S, int N>
class Partials : ChainRule<Partials<S, N>> {
 public:
  S value{0.0};  ///< The value.
  /// Derivatives along the N directions, valid unless `constant`; partial() checks both.
  std::array<S, N> d{};
  bool constant = true;  ///< All derivatives vanish identically; they are then neither stored nor computed.

  Partials() = default;
  /// A constant, without derivatives.
  Partials(double c) : value(c) {}  // NOLINT: implicit, so that formulas read as written
  /// A constant, without derivatives.
  Partials(const S& v) requires(!std::is_same_v<S, double>) : value(v) {}  // NOLINT

  /// A value with its derivatives.
  Partials(const S& v, const Vector<S, N>& slopes) : value(v), constant(false) {
    std::copy(slopes.begin(), slopes.end(), d.begin());
  }

  /// A value with derivative `slope` along direction i, and zero along the others.
  static Partials variable(const S& v, int i, const S& slope = S(1.0)) {
    Partials x(v);
    x.d.fill(S(0.0));
    x.d[i] = slope;
    x.constant = false;
    return x;
  }

  friend const S& value_of(const Partials& x) { return x.value; }  ///< The value.
  /// Derivative along direction i.
  [[nodiscard]] S partial(int i) const { return constant ? S(0.0) : d[i]; }
  /// All derivatives.
  [[nodiscard]] Vector<S, N> gradient() const {
    Vector<S, N> g;
    for (int i = 0; i < N; ++i)
      g[i] = partial(i);
    return g;
  }

  /// f, with the derivatives slope() times those of this number. slope() is not called for a constant.
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

  /// Arithmetic by the rules for sums, products and quotients. Derivatives that vanish identically are not
  /// computed.
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
  /// x or y, with its derivatives, according to the condition c.
  friend Partials choose(const decltype(S(0.0) < S(0.0))& c, const Partials& x, const Partials& y) {
    Partials z(S(select(c, x.value, y.value)));
    if (!x.constant || !y.constant) z.assign([&](int i) { return select(c, x.partial(i), y.partial(i)); });
    return z;
  }
  friend Partials operator/(const Partials& a, const Partials& b) {
    const S inverse = 1.0 / b.value;
    // To the last bit the value that a double has without derivatives, as formulas branch by it; packs save
    // a division.
    Partials c(std::is_same_v<S, double> ? S(a.value / b.value) : S(a.value * inverse));
    if (a.constant && b.constant) return c;
    if (b.constant) {
      c.assign([&](int i) { return a.d[i] * inverse; });
      return c;
    }
    if (a.constant) {
      const S slope = c.value * inverse;
      c.assign([&](int i) { return -(slope * b.d[i]); });
    } else {
      c.assign([&](int i) { return (a.d[i] - c.value * b.d[i]) * inverse; });
    }
    return c;
  }
  ///@}

 private:
  template <class Entry>
  void assign(Entry entry) {
    for (int i = 0; i < N; ++i)
      d[i] = entry(i);
    constant = false;
  }
};

/// The value and gradient of f: R^n -> R at x, for any scalar S and an n known at compile time.
template <class F, class S, int n>
Partials<S, n> value_and_gradient(const F& f, const Vector<S, n>& x) {
  Vector<Partials<S, n>, n> seeded;
  for (int i = 0; i < n; ++i)
    seeded[i] = Partials<S, n>::variable(x[i], i);
  return f(seeded);
}

}  // namespace avi
