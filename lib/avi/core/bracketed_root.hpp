#pragma once
#include "avi/core/compiler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// A zero of a function of one variable, inside a bracket.

namespace avi {

/// On which side of the zero a search may end.
enum class Side {
  either,  ///< On either side: |f| <= tolerance.
  beyond   ///< Where f is zero or has the sign of f at the upper end: 0 <= f <= tolerance.
};

/// The result of a search for a zero: the best point, and two points that bracket the zero.
struct Root {
  double x = 0.0;       ///< The point with the smaller |f|, or the upper one for Side::beyond.
  double value = 0.0;   ///< f(x); NaN where f was NaN.
  double low = 0.0;     ///< The lower point.
  double f_low = 0.0;   ///< f(low) < 0.
  double high = 0.0;    ///< The upper point.
  double f_high = 0.0;  ///< f(high) >= 0.
  bool met = false;     ///< |f(x)| is within the tolerance.
  bool closed = false;  ///< The bracket is as narrow as rounding allows.
  int evaluations = 0;  ///< Number of evaluations of f.
};

namespace detail {
/// A point between low and high. Calls alternate between the arithmetic mean and, for ends of equal sign and
/// very different size, the geometric mean, which halves the difference of the exponents. For ends of
/// opposite sign that point is zero. @param by_exponent true for the second kind
inline double middle(double low, double high, bool by_exponent) {
  const double mean = 0.5 * low + 0.5 * high;
  if (!by_exponent || low == -high) return mean;
  if (low < 0.0 && high > 0.0) return 0.0;
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const double from = std::max(std::min(std::abs(low), std::abs(high)), least),
               to = std::max(std::abs(low), std::abs(high));
  return to <= 1e3 * from ? mean : std::copysign(std::sqrt(from) * std::sqrt(to), mean);
}
}  // namespace detail

/// Finds a zero of a continuous f between low and high, given f_low < 0 < f_high there, by Chandrupatla's
/// method (1997): inverse quadratic interpolation where the last three points allow it, otherwise bisection.
/// For smooth f it is superlinear. Where three evaluations have not halved the bracket, the next step is a
/// bisection, so the search takes at most a few hundred evaluations for any f. It ends when |f| is within the
/// tolerance, when the bracket is as narrow as rounding allows, or when f is NaN. A jump or a pole of f also
/// ends as a narrow bracket, which f_low and f_high reveal.
template <class F>
[[nodiscard]] Root bracketed_root(F&& f, double low, double f_low, double high, double f_high,
                                  double tolerance, Side side = Side::either) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr int most = 1000;  // safety cap: without interpolation, 1e-300 in [0, 1] takes 270
  Root root{.low = low, .f_low = f_low, .high = high, .f_high = f_high};
  const auto end = [&](double x, double value) {
    root.x = x;
    root.value = value;
    return root;
  };
  double x = low + (high - low) * (f_low / (f_low - f_high));
  double width = high - low;  // width of the bracket three evaluations ago
  bool by_exponent = false;
  const auto bisect = [&] {
    x = detail::middle(root.low, root.high, by_exponent);
    by_exponent = !by_exponent;
  };
  while (root.evaluations < most) {
    const double scale = std::max(std::abs(root.low), std::abs(root.high));
    if (root.high - root.low <= 2.0 * epsilon * scale) break;
    if (!(x > root.low && x < root.high)) bisect();
    if (!(x > root.low && x < root.high)) x = 0.5 * root.low + 0.5 * root.high;
    if (!(x > root.low && x < root.high)) break;
    const double value = f(x);
    ++root.evaluations;
    if (std::isnan(value)) return end(x, value);
    // a is the newest point, b the opposite end of the bracket, and c the end that a has replaced.
    const double a = x, f_a = value;
    const bool below = value < 0.0;
    const double b = below ? root.high : root.low, f_b = below ? root.f_high : root.f_low;
    const double c = below ? root.low : root.high, f_c = below ? root.f_low : root.f_high;
    (below ? root.low : root.high) = a;
    (below ? root.f_low : root.f_high) = f_a;
    if (value <= tolerance && value >= (side == Side::beyond ? 0.0 : -tolerance)) {
      root.met = true;
      return end(x, value);
    }
    if (root.evaluations % 3 == 0) {
      const bool slow = root.high - root.low > 0.5 * width;
      width = root.high - root.low;
      if (slow) {
        bisect();
        continue;
      }
    }
    const double xi = (a - b) / (c - b), phi = (f_a - f_b) / (f_c - f_b);
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi) {
      x = a + (b - a) * (f_a / (f_b - f_a) * (f_c / (f_b - f_c))) +
          (c - a) * (f_a / (f_c - f_a) * (f_b / (f_c - f_b)));
      // A small distance from both ends, so that the point passes the zero once it is accurate to rounding.
      const double least = std::min(epsilon * scale, 0.5 * (root.high - root.low));
      x = std::clamp(x, root.low + least, root.high - least);
    } else {
      bisect();
    }
  }
  root.closed = root.evaluations < most;
  if (side == Side::beyond || std::abs(root.f_high) <= std::abs(root.f_low))
    return end(root.high, root.f_high);
  return end(root.low, root.f_low);
}

}  // namespace avi
