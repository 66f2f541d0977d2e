#pragma once
#include "avi/optim/minimise_options.hpp"
#include "avi/optim/run_updates.hpp"
#include "avi/optim/secant_pairs.hpp"

#include <functional>
#include <utility>

/// @file
/// The vectors of avi::minimise() and the operations on them, each one pass over memory.

namespace avi {

/// Base of the line that is searched, trial on it, best evaluated point, and direction d: seven vectors, and
/// the pairs of the mass matrix. StateClock takes the decisions; this class does the arithmetic. No template:
/// it is compiled once for all objectives.
class LineState {
 public:
  /// Value and gradient at a point.
  using Function = std::function<double(const VectorX&, VectorX&)>;

  /// Makes the memory of a run: 7 vectors, and 2 m + 1 more if m > 0.
  /// @throws std::invalid_argument for options out of range or an empty or non-finite x0.
  LineState(Function f, const VectorX& x0, const MinimiseOptions& options)
      : options_(options), f_(std::move(f)), n_(x0.size()), pairs_(checked(options, x0).memory, n_) {
    base_.x = x0;
    for (VectorX* v : {&base_.g, &trial_.x, &trial_.g, &best_.x, &best_.g, &d_})
      v->setZero(n_);
    base_.g.setConstant(std::numeric_limits<double>::quiet_NaN());  // f that does not fill it is noticed
    for (VectorX* v : {&base_.with_pairs, &trial_.with_pairs, &best_.with_pairs, &change_})
      v->setZero(pairs_.products());
  }

 protected:
  /// A point with the value and gradient of f, evaluated or interpolated.
  struct Point {
    VectorX x;           ///< Position.
    VectorX g;           ///< Gradient.
    VectorX with_pairs;  ///< Its products with the pairs of the mass matrix.
    double f = 0.0;      ///< Value.
  };

  /// Options and start after their check.
  static const MinimiseOptions& checked(const MinimiseOptions& options, const VectorX& x0) {
    options.validate();
    require(x0.size() > 0, "Size of x0", x0.size(), "at least 1");
    require(std::isfinite(largest_entry(x0)), "Largest entry of x0", largest_entry(x0), "finite");
    return options;
  }

  /// Notes why the run ends. Always false.
  bool fail(Outcome outcome, std::string reason) {
    failure_ = outcome;
    reason_ = std::move(reason);
    return false;
  }

  /// Value, with the gradient in at.g; counted.
  double value_at(Point& at) {
    ++evaluations_;
    return f_(at.x, at.g);
  }

  /// Value and gradient, slope along d and square of the gradient. False for a gradient of another size.
  bool evaluate(Point& at) {
    at.f = value_at(at);
    if (const Eigen::Index entries = at.g.size(); entries != n_) {
      at.g.setZero(n_);
      return fail(Outcome::wrong_gradient, "the gradient has " + std::to_string(entries) +
                                               " entries where x has " + std::to_string(n_));
    }
    const auto sums = sweep<2>(n_, [g = at.g.data(), d = d_.data()](auto e, auto& sum) {
      const auto entry = e(g);
      sum[0] += entry * e(d);
      sum[1] += entry * entry;
    });
    slope_ = sums[0], square_ = sums[1];
    pairs_.multiply(at.g.data(), at.with_pairs.data());
    return true;
  }

  /// d = -grad f, and the pairs are forgotten.
  void steepest() {
    pairs_.clear();
    quasi_newton();
  }

  /// d = -H grad f, or steepest descent where that is not downhill, and the length of its first trial.
  void quasi_newton() {
    const auto sums = pairs_.direction(base_.g.data(), base_.with_pairs.data(), d_.data());
    down_ = sums[0], length2_ = sums[1];
    if (pairs_.size() > 0 && !(down_ < 0.0)) return steepest();
    alpha_ = pairs_.size() > 0 ? 1.0 : first_step();
  }

  /// Slope and square of d; true where d goes downhill.
  bool measure_direction() {
    const auto sums = sweep<2>(n_, [g = base_.g.data(), d = d_.data()](auto e, auto& sum) {
      const auto entry = e(d);
      sum[0] += e(g) * entry;
      sum[1] += entry * entry;
    });
    down_ = sums[0], length2_ = sums[1];
    return down_ < 0.0;
  }

  /// The way to where a linear f would vanish, or one hundredth of x, whichever is longer.
  [[nodiscard]] double first_step() const {
    const double x = largest_entry(base_.x), g = largest_entry(base_.g);
    const double length = std::max(0.01 * x / g, std::abs(base_.f) / (norm_ * norm_));
    return length > 0.0 ? length : 1.0 / g;
  }

  /// Evaluates at an interpolated base, goes back to the best evaluated point if f rose, and renews d.
  void settle() {
    trial_.x.swap(base_.x);
    const bool sized = evaluate(trial_);
    trial_.x.swap(base_.x);
    exact_ = true;
    if (sized && std::isfinite(square_) && trial_.f <= best_.f + rounding(trial_.f, best_.f)) {
      if (options_.memory == 0) d_ += base_.g - trial_.g;  // d is -gradient + beta (old d)
      base_.g.swap(trial_.g);
      base_.f = trial_.f;
    } else {
      std::swap(base_, best_);
      if (options_.memory == 0) d_ = -base_.g;
    }
    norm_ = norm(base_.g);
    if (options_.memory > 0) {
      pairs_.multiply(base_.g.data(), base_.with_pairs.data());
      quasi_newton();
    } else if (!measure_direction()) {
      steepest();
    }
  }

  /// What rounding may make of the difference of two values.
  [[nodiscard]] double rounding(double one, double other) const {
    return noise_ + 1e-14 * (std::abs(one) + std::abs(other));
  }

  /// trial = base + alpha d.
  void place_trial(double alpha) {
    sweep<0>(n_, [alpha, x = base_.x.data(), d = d_.data(), t = trial_.x.data()](auto e, auto&) {
      e.set(t, e(x) + alpha * e(d));
    });
  }

  /// Moves to base + r alpha d, of value `interpolated`, or for r = 1 to the trial, and makes the next d and
  /// alpha.
  void advance(double r, double moved, double interpolated = std::numeric_limits<double>::quiet_NaN()) {
    const bool recovers = !std::isnan(interpolated);
    // The old base or the trial, whichever is the better point that was evaluated, is kept; the new one is
    // written over the third.
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
    const auto sums =
        sweep<6>(n_, [=, x = base_.x.data(), g = base_.g.data(), gt = trial_.g.data(), d = d_.data(),
                      x_out = into.x.data(), g_out = into.g.data()](auto e, auto& sum) {
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
    const auto [gg, g_old, gd, gy, dy, yy] = sums;
    base_.f = value;
    norm_ = std::sqrt(gg);
    exact_ = !recovers;
    if (pairs) {
      if (step * dy > 1e-12 * step * std::sqrt(length2_ * yy))
        pairs_.commit(base_.g.data(), step * dy, yy, change_.data(), base_.with_pairs.data(), step * gd, gy);
      else
        pairs_.discard();
      return quasi_newton();
    }
    double beta = 0.0;
    alpha_ = moved + step;
    if (dy > 0.0) {
      if (std::abs(g_old) <= 0.5 * gg)
        beta = std::max(gy / dy - (yy / dy) * (gd / dy), 0.5 * down_ / length2_);
      // the step that the least curvature along y asks for; across gradients minima are farther
      alpha_ = (beta == 0.0 ? 1.0 : 1.5) * step * dy / yy;
    }
    const auto now = sweep<2>(n_, [beta, g = base_.g.data(), d = d_.data()](auto e, auto& sum) {
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

  MinimiseOptions options_;        ///< As given.
  Function f_;                     ///< The objective.
  long evaluations_ = 0;           ///< Of value and gradient.
  Eigen::Index n_;                 ///< Size of x.
  SecantPairs pairs_;              ///< The mass matrix.
  Point base_;                     ///< Where the line begins.
  Point trial_;                    ///< The last evaluated point on it.
  Point best_;                     ///< The best evaluated point, while the base is interpolated.
  VectorX d_;                      ///< Direction of the line.
  VectorX change_;                 ///< Products of the newest y with the pairs.
  double down_ = 0.0;              ///< d . gradient at the base.
  double length2_ = 0.0;           ///< Square of d.
  double slope_ = 0.0;             ///< d . gradient at the last evaluation.
  double square_ = 0.0;            ///< Square of the gradient there.
  double norm_ = 0.0;              ///< Of the gradient at the base.
  double target_ = 0.0;            ///< Norm of the gradient that ends the run.
  double alpha_ = 0.0;             ///< Where the next trial is.
  double floor_ = 0.0;             ///< What f must not fall below.
  double noise_ = 0.0;             ///< Error of values as seen where a line was stuck.
  bool exact_ = true;              ///< Whether value and gradient at the base were evaluated.
  Outcome failure_ = Outcome::ok;  ///< Why the run ends.
  std::string reason_;             ///< The same in words.
};

}  // namespace avi
