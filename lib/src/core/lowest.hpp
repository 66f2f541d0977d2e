#pragma once
#include <cmath>

/// @file
/// The lowest point of a function of one variable.

namespace avi::detail {

/// A point, and the value of a function there.
struct Lowest {
  double x, f;
};

/// Finds the lowest point of f between low and high by Brent's method (1973), to 1e-7 of the distance of the
/// two: a parabola through the last three points, or golden section. @param any stop at the first point where
/// f is not positive
template <class F>
Lowest lowest(F&& f, double low, double high, bool any) {
  constexpr double golden = 0.3819660112501051;
  const double close = 1e-7 * (high - low);
  double x = low + golden * (high - low), v = x, w = x, f_x = f(x), f_v = f_x, f_w = f_x;
  double step = 0.0, before = 0.0;
  for (int k = 0; k < 60 && !(any && f_x <= 0.0); ++k) {
    const double middle = 0.5 * (low + high);
    if (std::abs(x - middle) <= 2.0 * close - 0.5 * (high - low)) break;
    bool bisect = true;
    if (std::abs(before) > close) {
      const double r = (x - w) * (f_x - f_v), s = (x - v) * (f_x - f_w);
      double p = (x - v) * s - (x - w) * r, d = 2.0 * (s - r);
      if (d > 0.0) p = -p;
      d = std::abs(d);
      if (std::abs(p) < std::abs(0.5 * d * before) && p > d * (low - x) && p < d * (high - x)) {
        before = step;
        step = p / d;
        bisect = false;
      }
    }
    if (bisect) {
      before = x < middle ? high - x : low - x;
      step = golden * before;
    }
    const double u = x + (std::abs(step) >= close ? step : std::copysign(close, step)), f_u = f(u);
    if (f_u <= f_x) {
      (u < x ? high : low) = x;
      v = w, f_v = f_w, w = x, f_w = f_x, x = u, f_x = f_u;
    } else {
      (u < x ? low : high) = u;
      if (f_u <= f_w || w == x)
        v = w, f_v = f_w, w = u, f_w = f_u;
      else if (f_u <= f_v || v == x || v == w)
        v = u, f_v = f_u;
    }
  }
  return {x, f_x};
}

}  // namespace avi::detail
