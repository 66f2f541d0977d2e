#pragma once
#include <cmath>
#include <limits>

/// @file
/// One-dimensional equations.

namespace avi {

/// Zero of a continuous f between low and high, where it has the values f_low < 0 < f_high, by the Illinois
/// variant of regula falsi (Dowell and Jarratt 1971): superlinear, and always inside the bracket. Ends when
/// |f| <= tolerance, when the point moves by rounding alone, when the bracket cannot shrink, when f is NaN,
/// or after 100 evaluations; returns the last point.
template <class F>
double bracketed_root(F&& f, double low, double f_low, double high, double f_high, double tolerance) {
  double x = low;
  int side = 0;
  for (int i = 0; i < 100; ++i) {
    const double previous = x;
    x = low + (high - low) * (f_low / (f_low - f_high));
    if (!(x > low && x < high)) x = 0.5 * (low + high);
    if (!(x > low && x < high)) break;
    const double value = f(x);
    if (!(std::abs(value) > tolerance)) break;
    if (i > 0 && std::abs(x - previous) <= 2.0 * std::numeric_limits<double>::epsilon() * std::abs(x)) break;
    if (value < 0.0) {
      low = x, f_low = value;
      if (side < 0) f_high *= 0.5;
      side = -1;
    } else {
      high = x, f_high = value;
      if (side > 0) f_low *= 0.5;
      side = 1;
    }
  }
  return x;
}

}  // namespace avi
