#pragma once
#include "avi/optim/minimiser.hpp"
#include "src/minimise/secant_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

/// @file
/// The points and the direction of a run of avi::minimise(), and how one follows from the other.

namespace avi::detail {

/// The base of a line, the trial on it, and the direction d. f sees the vectors of the points; all others are
/// its own. MinimiserRun decides where to go.
class Descent {
 public:
  /// Makes the memory of a run: a vector, and 2 m + 1 more if m > 0.
  Descent(MinimiserCalls& calls, Eigen::Index n, const MinimiseOptions& options)
      : calls_(calls), options_(options), n_(n), pairs_(options.memory, n) {
    d_.setZero(n);
    int number = 0;
    for (Point* at : {&base_, &trial_, &best_}) {
      at->x = {number, calls_.position(number)};
      at->g = {number, calls_.gradient(number)};
      at->with_pairs.setZero(pairs_.products());
      ++number;
    }
    change_.setZero(pairs_.products());
  }

 protected:
  using View = Eigen::Map<VectorX>;

  struct Entries {  ///< A vector of the caller.
    int number;
    double* data;
  };
  /// A point with the value and gradient of f, evaluated or interpolated.
  struct Point {
    Entries x;           ///< Position.
    Entries g;           ///< Gradient.
    VectorX with_pairs;  ///< Products of the gradient with the pairs of the mass matrix.
    double f = 0.0;      ///< Value.
  };

  [[nodiscard]] View view(const Entries& x) const { return {x.data, n_}; }

  /// Notes why the run ends. Always returns false.
  bool fail(Outcome outcome, std::string reason) {
    failure_ = outcome;
    reason_ = std::move(reason);
    return false;
  }
  bool capped() { return fail(Outcome::step_limit, "the cap on evaluations was reached"); }

  /// Evaluates f at a point, with the gradient in at.g; counts this, and notes the size of the gradient.
  double value_at(Point& at) {
    ++evaluations_;
    const auto [value, entries] = calls_.evaluate(at.x.number, at.g.number);
    at.g.data = calls_.gradient(at.g.number);
    entries_ = entries;
    return value;
  }

  /// Evaluates value, gradient, slope along d and square of the gradient. Returns false on failure.
  bool evaluate(Point& at) {
    at.f = value_at(at);
    if (entries_ != n_)
      return fail(Outcome::wrong_gradient, "the size of the gradient is " + std::to_string(entries_) +
                                               " where that of x is " + std::to_string(n_));
    const auto sums = sweep<2>(n_, [g = at.g.data, d = d_.data()](auto e, auto& sum) {
      const auto entry = e(g);
      sum[0] += entry * e(d);
      sum[1] += entry * entry;
    });
    slope_ = sums[0], square_ = sums[1];
    pairs_.multiply(at.g.data, at.with_pairs.data());
    return !(at.f < floor_) || std::isnan(square_) ||
           fail(Outcome::diverged, "f falls below -1e300 along a line");
  }

  /// Sets d = -grad f, and forgets the pairs.
  void steepest() {
    pairs_.clear();
    quasi_newton();
  }

  /// Sets d = -H grad f, or steepest descent if that is not downhill, and the length of its first trial.
  void quasi_newton() {
    const auto sums = pairs_.direction(base_.g.data, base_.with_pairs.data(), d_.data());
    down_ = sums[0], length2_ = sums[1];
    if (pairs_.size() > 0 && !(down_ < 0.0)) return steepest();
    alpha_ = pairs_.size() > 0 ? 1.0 : first_step();
  }

  /// Sets slope and square of d; true if d goes downhill.
  bool measure_direction() {
    const auto sums = sweep<2>(n_, [g = base_.g.data, d = d_.data()](auto e, auto& sum) {
      const auto entry = e(d);
      sum[0] += e(g) * entry;
      sum[1] += entry * entry;
    });
    down_ = sums[0], length2_ = sums[1];
    return down_ < 0.0;
  }

  /// Distance of the first trial along -g, in units of g: where a linear f would vanish, but between one
  /// hundredth of x and a hundred times x.
  [[nodiscard]] double first_step() const {
    const double g = largest_entry(view(base_.g)), x = largest_entry(view(base_.x)) / g;
    double length = std::abs(base_.f) / (norm_ * norm_);
    if (!std::isfinite(length)) length = 0.0;
    if (x > 0.0) length = std::clamp(length, 0.01 * x, 100.0 * x);
    return length > 0.0 ? length : 1.0 / g;
  }

  /// Evaluates f at an interpolated base, goes back to the best evaluated point if f rose, and renews d.
  bool settle() {
    if (evaluations_ >= options_.evaluations) return capped();
    std::swap(trial_.x, base_.x);
    exact_ = evaluate(trial_);
    std::swap(trial_.x, base_.x);
    if (!exact_) return false;
    const bool back = !(std::isfinite(trial_.f) && std::isfinite(square_) && is_level(best_.f));
    if (!back) {
      if (options_.memory == 0) d_ += view(base_.g) - view(trial_.g);  // d is -gradient + beta (old d)
      std::swap(base_.g, trial_.g);
      base_.f = trial_.f;
    } else {
      std::swap(base_, best_);
      if (options_.memory == 0) d_ = -view(base_.g);
    }
    norm_ = norm(view(base_.g));
    if (options_.memory > 0) {
      pairs_.multiply(base_.g.data, base_.with_pairs.data());
      quasi_newton();
    } else if (!measure_direction()) {
      steepest();
    }
    if (back) alpha_ *= 0.3;  // lest the same trial lead to the same place
    return true;
  }

  /// Bound on the rounding error of the difference of two values.
  [[nodiscard]] double rounding(double one, double other) const {
    return noise_ + 1e-14 * (std::abs(one) + std::abs(other));
  }

  /// Whether the trial is, as far as can be told, as low as this value and as every evaluated iterate, and
  /// not above f(x0): what was taken for noise may have been a rise, and rises must not add up.
  [[nodiscard]] bool is_level(double value) const {
    const double least = std::min(value, level_);
    return trial_.f <= least + rounding(least, trial_.f) &&
           trial_.f <= first_ + 1e-14 * (std::abs(first_) + std::abs(trial_.f));
  }

  /// Sets trial = base + alpha d.
  void place_trial(double alpha) {
    sweep<0>(n_, [alpha, x = base_.x.data, d = d_.data(), t = trial_.x.data](auto e, auto&) {
      e.set(t, e(x) + alpha * e(d));
    });
  }

  /// Moves to base + r alpha d, of value `interpolated`, or for r = 1 to the trial, and sets the next d and
  /// alpha.
  void advance(double r, double moved, double interpolated = std::numeric_limits<double>::quiet_NaN()) {
    const bool recovers = !std::isnan(interpolated);
    // The better evaluated point, old base or trial, is kept; the new base is written over the third one.
    const bool keeps_base = recovers && exact_ && base_.f < trial_.f;
    const bool keeps_trial = recovers && !keeps_base && (exact_ || trial_.f <= best_.f);
    Point& into = !recovers || keeps_base ? trial_ : keeps_trial ? best_ : base_;
    const double step = r * alpha_, value = recovers ? interpolated : trial_.f;
    const bool pairs = options_.memory > 0;
    if (pairs) {  // before the points change places
      change_ = r * (trial_.with_pairs - base_.with_pairs);
      into.with_pairs = base_.with_pairs + change_;
    }
    double* s_out = pairs ? pairs_.next_s() : nullptr;
    double* y_out = pairs ? pairs_.next_y() : nullptr;
    const auto [gg, g_old, gd, gy, dy, yy] =
        sweep<6>(n_, [=, x = base_.x.data, g = base_.g.data, gt = trial_.g.data, d = d_.data(),
                      x_out = into.x.data, g_out = into.g.data](auto e, auto& sum) {
          const auto old = e(g), along = e(d);
          const auto now = (1.0 - r) * old + r * e(gt), y = now - old, s = step * along;
          e.set(x_out, e(x) + s);
          e.set(g_out, now);
          if (pairs) {
            e.set(s_out, s);
            e.set(y_out, y);
          }
          sum[0] += now * now;
          sum[1] += now * old;
          sum[2] += now * along;
          sum[3] += now * y;
          sum[4] += y * along;
          sum[5] += y * y;
        });
    if (&into == &best_) {
      std::swap(base_, best_);
      std::swap(best_, trial_);
    } else if (&into == &trial_) {
      std::swap(base_, trial_);
      if (keeps_base) std::swap(best_, trial_);
    }
    base_.f = value;
    norm_ = std::sqrt(gg);
    exact_ = !recovers;
    if (pairs) {
      if (step * dy > 1e-12 * step * (std::sqrt(length2_) * std::sqrt(yy)))
        pairs_.commit(base_.g.data, step * dy, yy, change_.data(), base_.with_pairs.data(), step * gd, gy);
      else
        pairs_.discard();
      return quasi_newton();
    }
    conjugate(moved, step, gg, g_old, gd, gy, dy, yy);
  }

  /// Sets the next d = -grad f + beta d and its alpha from products of the new gradient g, the old one, their
  /// difference y and d: beta is that of Dai and Kou (2013), or 0 where gradients are far from orthogonal.
  /// @param moved distance from the start of the line to the old base @param step distance from there to the
  /// new one
  void conjugate(double moved, double step, double gg, double g_old, double gd, double gy, double dy,
                 double yy) {
    double beta = 0.0;
    alpha_ = moved + step;
    if (dy > 0.0) {
      if (std::abs(g_old) <= 0.5 * gg)
        beta = std::max(gy / dy - (yy / dy) * (gd / dy), 0.5 * down_ / length2_);
      // the step that the least curvature along y asks for; across gradients, minima are farther away
      alpha_ = (beta == 0.0 ? 1.0 : 1.5) * step * dy / yy;
    }
    const auto now = sweep<2>(n_, [beta, g = base_.g.data, d = d_.data()](auto e, auto& sum) {
      const auto entry = beta * e(d) - e(g);
      e.set(d, entry);
      sum[0] += entry * e(g);
      sum[1] += entry * entry;
    });
    down_ = now[0], length2_ = now[1];
    if (!(down_ < 0.0)) {
      const double length = dy > 0.0 ? step * dy / yy : alpha_;
      steepest();
      alpha_ = length;
    }
  }

  MinimiserCalls& calls_;              ///< The objective, and the vectors that it sees.
  const MinimiseOptions& options_;     ///< Options, as given.
  long evaluations_ = 0;               ///< Number of evaluations of value and gradient.
  Eigen::Index n_;                     ///< Size of x.
  SecantPairs pairs_;                  ///< The mass matrix.
  Point base_;                         ///< Point where the line begins.
  Point trial_;                        ///< The last evaluated point on it.
  Point best_;                         ///< The best evaluated point, while the base is interpolated.
  VectorX d_;                          ///< Direction of the line.
  VectorX change_;                     ///< Products of the newest y with the pairs.
  double down_ = 0.0, length2_ = 0.0;  ///< d . gradient at the base, and the square of the length of d.
  double slope_ = 0.0, square_ = 0.0;  ///< The last evaluated gradient: its product with d, and its square.
  double norm_ = 0.0;                  ///< Norm of the gradient at the base.
  double alpha_ = 0.0;                 ///< Place of the next trial.
  double first_ = 0.0;                 ///< f(x0).
  double level_ = 0.0;                 ///< Least f of an evaluated iterate.
  double floor_ = -std::numeric_limits<double>::infinity();  ///< Value of f below which a run has diverged.
  double noise_ = 0.0;             ///< Error of values, as seen where a line was stuck.
  bool exact_ = true;              ///< Whether value and gradient at the base were evaluated.
  Outcome failure_ = Outcome::ok;  ///< Outcome with which the run ends.
  std::string reason_;             ///< Reason, in words.
  Eigen::Index entries_ = 0;       ///< Size of the gradient that f left last.
};

}  // namespace avi::detail
