#pragma once
#include "avi/core/compiler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// The minimum of a line between or beyond two points, from values and slopes there; noise of the values.

namespace avi {

/// Value and slope of \f$\phi(\alpha) = f(x + \alpha d)\f$ at one point.
struct LinePoint {
  double value = 0.0;  ///< phi.
  double slope = 0.0;  ///< phi' = d . grad f.
};

/// How far the search along one line has come. Distances are from its base, which moves on along it.
struct LineSoFar {
  LinePoint start;        ///< Where it began.
  double moved = 0.0;     ///< Distance of the base from there.
  double high = never();  ///< Trials are nearer than that: f rose there, or was not finite.
  double wall = never();  ///< Least distance at which f was not finite.
  int trials = 1;         ///< The trials, with the one to come.
  int since_start = 1;    ///< The same, and not counted anew where the base moves.
  int beyond = 0;         ///< Trials at which f was not finite.

  /// Of distances that are not known.
  static constexpr double never() { return std::numeric_limits<double>::infinity(); }
};

/// Where the first trial along -g is, in units of g: where a linear f would vanish, or at one hundredth of x,
/// whichever is farther. @param g and @param x their largest entries
inline double first_trial(double f, double norm_of_g, double g, double x) {
  const double by_value = std::abs(f) / (norm_of_g * norm_of_g);
  const double length = std::max(0.01 * x / g, std::isfinite(by_value) ? by_value : 0.0);
  return length > 0.0 ? length : 1.0 / g;
}

/// The base of a line (alpha = 0) and one trial at alpha = h > 0.
///
/// Between two points where phi is quadratic its slope is linear: it vanishes at alpha = r h with
/// \f$ r = -\phi_0'/(\kappa h), \; \kappa = (\phi_1' - \phi_0')/h \f$. A cubic term a alpha^3 shows in the
/// values: the trapezium rule misses phi_1 - phi_0 by e = -a h^3 / 2, and the slope at r h is wrong by
/// 6 (e/h) r (r - 1). So e tells whether the linear interpolation may be trusted.
struct LineModel {
  LinePoint base;   ///< At alpha = 0.
  LinePoint trial;  ///< At alpha = h.
  double h;         ///< Distance of the trial, positive.
  double r;         ///< Where the slope vanishes, in units of h; meant for a line that is convex().
  double defect;    ///< nu = |e| / (h max |phi'|), less what rounding of the values explains.
  double rounding;  ///< The defect that rounding explains, likewise in units of h max |phi'|.

  /// `noise` is what rounding may make of the difference of the values.
  LineModel(const LinePoint& from, const LinePoint& to, double distance, double noise)
      : base(from), trial(to), h(distance), r(-from.slope / (to.slope - from.slope)) {
    const double unit = h * std::max(std::abs(from.slope), std::abs(to.slope));
    rounding = noise / unit;
    defect = std::max(0.0, std::abs(trapezium()) / unit - rounding);
  }

  /// e.
  [[nodiscard]] double trapezium() const {
    return trial.value - base.value - 0.5 * h * (base.slope + trial.slope);
  }

  /// True for kappa > 0, whose size leaves the range of numbers in distant units of x and f.
  [[nodiscard]] bool convex() const { return trial.slope > base.slope; }

  /// True where the minimum of the line and the gradient there may be taken from the interpolation.
  [[nodiscard]] bool trusted() const {
    return convex() && defect <= 0.3 && r >= 0.02 && r <= 10.0 && wrong_by(defect) <= 0.04;
  }

  /// True where that rests on slopes alone, because rounding would hide a defect.
  [[nodiscard]] bool blind() const { return wrong_by(defect + rounding) > 0.04; }

  /// Minimum of the cubic through both points, in units of h; for a trial beyond the minimum. In [0.05,
  /// 0.95], one half where the cubic has none.
  [[nodiscard]] double cubic() const {
    // In units of the slopes, a power of two: squares are numbers whatever the units of x and f.
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

  /// Next trial beyond one that still goes downhill, in units of h.
  [[nodiscard]] double beyond() const { return convex() ? std::clamp(r, 1.5, 10.0) : 5.0; }

 private:
  /// Error of the slope at r h, in units of the larger slope, that a defect of nu stands for.
  [[nodiscard]] double wrong_by(double nu) const { return 6.0 * nu * std::max(1.0, r) * std::abs(r - 1.0); }
};

/// The defect |e| of the values of a line beside its slopes, from trial to trial: a bend of f or noise.
class LineMisses {
 public:
  /// The next trial of the line.
  void add(const LineModel& model) {
    const double now = std::abs(model.trapezium());
    falls_ = now * at_ <= 1.2 * size_ * model.h ? falls_ + 1 : 0;
    size_ = now, at_ = model.h;
  }

  [[nodiscard]] double size() const { return size_; }  ///< |e| of the last trial.

  /// True where noise of the size `seen` would hide what the slopes say, and yet |e| is above what rounding
  /// may be and fell, three times in a row, at least as fast as the distance. Noise does not fall with it.
  [[nodiscard]] bool bends(const LineModel& last, double seen, double rounding) const {
    const double by_slopes = last.h * std::max(std::abs(last.base.slope), std::abs(last.trial.slope));
    return falls_ >= 3 && size_ > rounding && seen > 0.01 * by_slopes;
  }

 private:
  double size_ = 0.0, at_ = 1.0;  ///< |e| and h of the last trial.
  int falls_ = 0;                 ///< Trials in a row of which that is true.
};

}  // namespace avi
