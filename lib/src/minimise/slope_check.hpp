#pragma once
#include "avi/optim/objective.hpp"

#include <cstdint>
#include <sstream>
#include <utility>

/// @file
/// A check of a gradient: its slope along a line against differences of values of the function.

namespace avi {

/// A slope by differences, and how far it may be off.
struct SlopeByValues {
  double slope;        ///< Slope d . grad f.
  double uncertainty;  ///< Error bound for truncation and rounding.
  double truncation;   ///< Part of the uncertainty that falls with the distance of the values.
  double apart;        ///< Distance of the inner values from 0.

  /// Returns true if the function bends so much between the values that they say nothing about a slope. The
  /// same holds if all values are equal, as what bends may lie between them.
  [[nodiscard]] bool depends_on_distance() const { return truncation >= 0.1 * std::abs(slope); }

  /// Returns true if `by_gradient`, which may be off by `allowed`, cannot be told from this slope.
  [[nodiscard]] bool agrees_with(double by_gradient, double allowed) const {
    // A slope that is NaN says nothing about the gradient; the run itself will report it.
    return !(std::abs(slope - by_gradient) > allowed + uncertainty);
  }
  /// Returns a clause with both numbers.
  [[nodiscard]] std::string against(double by_gradient) const {
    std::ostringstream clause;
    clause << "along a line f has the slope " << slope << " by its values and " << by_gradient
           << " by its gradient";
    return clause.str();
  }
};

/// The slope of phi at 0, by central differences at the distances h and h / 8, from four values. Their
/// difference is the uncertainty, plus what rounding of the values adds.
template <class Phi>
SlopeByValues slope_by_values(Phi&& phi, double h) {
  double slopes[2], rounding = 0.0, apart = h;
  for (double& slope : slopes) {
    const double ahead = phi(h), behind = phi(-h);
    slope = (ahead - behind) / (2.0 * h);
    rounding = 1e-15 * std::max(std::abs(ahead), std::abs(behind)) / h;
    apart = std::exchange(h, h / 8.0);
  }
  const double truncation = std::abs(slopes[1] - slopes[0]);
  return {slopes[1], truncation + rounding, truncation, apart};
}

/// The slope by values that `by_gradient`, which may be off by `allowed`, is to be compared with. If it
/// depends on the distance of the values, they are taken closer to each other, down to 1e-9 of `farthest`.
/// They are also taken closer once more before they contradict the gradient: values that are waves apart may
/// seem not to depend on the distance, and closer ones then say something else. At most 20 values are taken.
template <class Phi>
SlopeByValues slope_to_compare(Phi&& phi, double farthest, double by_gradient, double allowed) {
  SlopeByValues before{};
  bool counts = false;
  for (double part = 1.0; part > 1e-9; part /= 64.0) {
    const SlopeByValues by = slope_by_values(phi, part * farthest);
    if (counts && by.agrees_with(before.slope, before.uncertainty)) break;
    before = by;
    counts = !by.depends_on_distance();
    if (counts && by.agrees_with(by_gradient, allowed)) break;
  }
  return before;
}

/// The error of values, as third differences of five at a small distance h from each other show it: those of
/// a smooth function are no more than rounding.
template <class Phi>
double noise_of_values(Phi&& phi, double h) {
  double v[5];
  for (int i = 0; i < 5; ++i)
    v[i] = phi((i - 2) * h);
  return std::max(std::abs(v[3] - v[0] - 3.0 * (v[2] - v[1])), std::abs(v[4] - v[1] - 3.0 * (v[3] - v[2])));
}

/// Whether a slope by the gradient is no more than what rounding of x makes of it. Then phi, of the given
/// value at 0, is a parabola there whose slope changes by as much within eight units of `resolution`, the
/// distance at which x + h d is told from x. Values are taken at a thousand of these units and at half of
/// that, then at eight and four, as the thousand may be beyond the parabola: second differences are as 4 to 1
/// at the minimum of a smooth function, as 2 to 1 at a kink, equal at a jump. Eight values at most are taken.
template <class Phi>
bool lost_in_rounding(Phi&& phi, double value, double slope, double resolution) {
  const auto bend = [&](double h) { return phi(h) + phi(-h) - 2.0 * value; };
  const double noise = 4e-15 * std::abs(value);
  for (const double units : {1e3, 8.0}) {
    const double h = units * resolution, whole = bend(h), half = bend(0.5 * h),
                 curvature = (whole - noise) / (h * h);
    if (whole > 2.8 * half && whole < 5.6 * half && 8.0 * resolution * curvature > std::abs(slope))
      return true;
  }
  return false;
}

/// Whether phi, of the given value and slope at 0, rises by a tenth of `most` where its fall could just be
/// seen, long before the distance at which it was seen to differ by `most`. One value is taken.
template <class Phi>
bool jumps_up(Phi&& phi, double value, double slope, double farthest, double most) {
  const double near = 1e-11 * std::abs(value / slope);
  return near < 1e-4 * farthest && phi(near) - value > 0.1 * most;
}

/// Sets a direction in which every entry takes part, in proportion to its size and with a weight of either
/// sign between 1/2 and 3/2.
inline void mixed_direction(const VectorView& x, VectorX& d) {
  const double largest = largest_entry(x);
  std::uint64_t bits = 1;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;  // Knuth's generator: signs need no better one
    const double weight = 0.5 + static_cast<double>((bits << 1) >> 33) * 0x1p-31;
    const double size = largest > 0.0 ? std::max(std::abs(x[i]), 0.01 * largest) : 1.0;
    d[i] = (bits >> 63) != 0 ? -weight * size : weight * size;
  }
}

}  // namespace avi
