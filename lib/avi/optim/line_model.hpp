#pragma once
#include "avi/core/compiler.hpp"

#include <algorithm>
#include <cmath>

/// @file
/// The model of a line search: the minimum on a line from values and slopes at two points, and the noise of
/// values.

namespace avi {

/// Value and slope of \f$\phi(\alpha) = f(x + \alpha d)\f$ at one point.
struct LinePoint {
  double value = 0.0;  ///< phi.
  double slope = 0.0;  ///< phi' = d . grad f.
};

/// A line through its base (alpha = 0) and one trial at alpha = h > 0.
///
/// If phi is quadratic between the two points, its slope is linear and vanishes at alpha = r h with \f$ r =
/// -\phi_0'/(\kappa h), \; \kappa = (\phi_1' - \phi_0')/h \f$. A cubic term a alpha^3 shows in the values:
/// the trapezium rule for phi_1 - phi_0 is wrong by e = -a h^3 / 2, and the slope interpolated at r h by 6
/// (e/h) r (r - 1). So e tells whether the linear interpolation can be trusted.
struct LineModel {
  LinePoint base;   ///< Value and slope at alpha = 0.
  LinePoint trial;  ///< Value and slope at alpha = h.
  double h;         ///< Distance of the trial, positive.
  double r;         ///< Where the slope vanishes, in units of h; only for a line that is convex().
  double defect;    ///< nu = |e| / (h max |phi'|), less what rounding of the values explains.
  double rounding;  ///< The part of nu that rounding explains, in the same units.

  /// The line through two points. @param from the base @param to the trial @param distance h @param noise
  /// error that rounding may cause in the difference of the values
  LineModel(const LinePoint& from, const LinePoint& to, double distance, double noise)
      : base(from), trial(to), h(distance), r(-from.slope / (to.slope - from.slope)) {
    const double unit = h * std::max(std::abs(from.slope), std::abs(to.slope));
    rounding = noise / unit;
    defect = std::max(0.0, std::abs(trapezium()) / unit - rounding);
  }

  /// The error e of the trapezium rule.
  [[nodiscard]] double trapezium() const {
    return trial.value - base.value - 0.5 * h * (base.slope + trial.slope);
  }

  /// True for kappa > 0; kappa itself may overflow in unusual units of x and f.
  [[nodiscard]] bool convex() const { return trial.slope > base.slope; }

  /// True if the minimum on the line, and the gradient there, may be taken from the interpolation.
  [[nodiscard]] bool trusted() const {
    return convex() && defect <= 0.3 && r >= 0.02 && r <= 10.0 && wrong_by(defect) <= 0.04;
  }

  /// True if trusted() rests on the slopes alone, because rounding would hide a defect.
  [[nodiscard]] bool blind() const { return wrong_by(defect + rounding) > 0.04; }

  /// The minimum of the cubic through both points, in units of h, for a trial beyond the minimum. It is
  /// limited to [0.05, 0.95], and is one half if the cubic has no minimum.
  [[nodiscard]] double cubic() const {
    // Slopes are divided by a power of two near the larger one, so that their squares are finite for any
    // units of x and f.
    const double largest = std::max(std::abs(base.slope), std::abs(trial.slope));
    const double unit = largest > 0.0 && std::isfinite(largest) ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
    const double before = base.slope / unit, after = trial.slope / unit;
    const double secant = 3.0 * (base.value - trial.value) / h / unit + before + after;
    const double square = secant * secant - before * after;
    if (!(square >= 0.0)) return 0.5;
    const double root = std::sqrt(square);
    const double at = 1.0 - (after + root - secant) / (after - before + 2.0 * root);
    return std::isfinite(at) ? std::clamp(at, 0.05, 0.95) : 0.5;
  }

  /// Distance of the next trial, in units of h, if f still falls at this one.
  [[nodiscard]] double beyond() const { return convex() ? std::clamp(r, 1.5, 10.0) : 5.0; }

 private:
  /// Error of the interpolated slope at r h, in units of the larger slope, for a defect nu.
  [[nodiscard]] double wrong_by(double nu) const { return 6.0 * nu * std::max(1.0, r) * std::abs(r - 1.0); }
};

/// Records |e|, the disagreement of values and slopes along a line, from trial to trial, to tell a bend of f
/// from noise.
class LineMisses {
 public:
  /// Adds the next trial on the line.
  void add(const LineModel& model) {
    const double now = std::abs(model.trapezium());
    falls_ = now * at_ <= 1.2 * size_ * model.h ? falls_ + 1 : 0;
    size_ = now, at_ = model.h;
  }

  [[nodiscard]] double size() const { return size_; }  ///< |e| of the last trial.

  /// True if f bends, although noise of the size `seen` could explain the disagreement with the slopes: |e|
  /// exceeds what rounding may cause, and fell at least as fast as the distance in three successive trials,
  /// which noise does not do.
  [[nodiscard]] bool bends(const LineModel& last, double seen, double rounding) const {
    const double by_slopes = last.h * std::max(std::abs(last.base.slope), std::abs(last.trial.slope));
    return falls_ >= 3 && size_ > rounding && seen > 0.01 * by_slopes;
  }

 private:
  double size_ = 0.0, at_ = 1.0;  ///< |e| and h of the last trial.
  int falls_ = 0;                 ///< Successive trials in which |e| fell at least as fast as h.
};

}  // namespace avi
