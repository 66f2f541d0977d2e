#include "avi/optim/minimiser.hpp"
#include "avi/optim/line_model.hpp"
#include "secant_pairs.hpp"
#include "slope_check.hpp"

#include <string_view>

// Compiled once for each set of instructions, each time under another name; builds.cpp chooses.
#ifndef AVI_MINIMISE
#define AVI_MINIMISE minimise_portable
#endif

namespace avi::detail {

namespace {

using View = Eigen::Map<VectorX>;

/// A run of Minimiser. f sees the vectors of its points; all others are its own.
class MinimiserRun {
 public:
  /// Makes the memory of a run: a vector, and 2 m + 1 more if m > 0.
  MinimiserRun(MinimiserCalls& calls, Eigen::Index n, const MinimiseOptions& options)
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

  /// Minimises f. To be called once.
  MinimiserEnd run() {
    if (!evaluate(base_)) return end(failure_, reason_);
    norm_ = std::sqrt(square_);
    const double steepness = largest_entry(view(base_.g));
    if (!std::isfinite(steepness))
      return end(Outcome::non_finite, "the gradient at x0 is not finite, or f did not fill it");
    if (!std::isfinite(norm_)) return out_of_range(" at x0");
    if (!std::isfinite(base_.f)) return end(Outcome::non_finite, "f(x0) is not finite");
    first_ = level_ = base_.f;
    size0_ = norm(view(base_.x));
    scale_ = std::abs(base_.f);
    norm0_ = length(view(base_.g));
    target_ = std::max(options_.relative * norm0_, options_.absolute);
    if (underflows()) return out_of_range(" at x0");
    floor_ = scale_ < 1e270 ? -1e300 : -std::numeric_limits<double>::max();
    if (const double first = first_step() * norm_; first > 0.0 && std::isfinite(first)) first_trial_ = first;
    if (options_.check_gradient && !gradient_agrees()) return end(failure_, reason_);
    steepest();
    if (!report()) return end(Outcome::stopped, "the callback asked to stop");
    if (norm_ <= target_) return end(Outcome::ok);
    while (iterations_ < options_.iterations) {
      const double before = exact_ ? base_.f : std::numeric_limits<double>::quiet_NaN();
      if (!line()) return end(failure_, reason_);
      ++iterations_;
      if (underflows()) return out_of_range();
      if (norm_ <= target_ && !exact_ && !settle()) return end(failure_, reason_);
      const bool done =
          norm_ <= target_ && (std::isinf(options_.change) || std::abs(base_.f - before) < options_.change);
      if (!report()) return end(Outcome::stopped, "the callback asked to stop");
      if (done) return end(Outcome::ok);
      if (!gains()) return end(failure_, reason_);
    }
    return end(Outcome::step_limit, "the cap on iterations was reached");
  }

 private:
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

  /// Whether the gradient at the base is so small that the squares of its entries underflow, but too large to
  /// end the run: its norms are not to be trusted then. A run without a tolerance that began with far larger
  /// gradients ends there.
  bool underflows() {
    if (!(norm_ < 1e-150)) return false;
    if (!exact_ && !settle()) return false;
    norm_ = length(view(base_.g));
    if (target_ == 0.0 && norm_ < std::min(1e-150, 1e-30 * norm0_)) target_ = norm_;
    return norm_ > target_ && norm_ < 1e-150;
  }

  MinimiserEnd out_of_range(std::string_view where = {}) {
    return end(Outcome::non_finite, "the square of the gradient" + std::string(where) +
                                        " is beyond the range of numbers; scale f");
  }

  /// Makes one iteration: trials along d until one gives the next point. Returns false on failure.
  bool line() {
    LineSoFar so_far{{base_.f, down_}};
    auto& [start, moved, high, wall, trials, since_start, beyond] = so_far;
    const double sigma = options_.memory == 0 ? 0.7 : 0.8, noise = noise_;
    bool restarted = false;
    LineMisses misses;
    for (;; ++trials, ++since_start) {
      if (evaluations_ >= options_.evaluations) return capped();
      place_trial(alpha_);
      if (trials > 40 || view(trial_.x) == view(base_.x) || !(alpha_ > 0.0)) {  // steepest descent, once
        // Towards a wall, f may fall along more than one line.
        const bool fell = base_.f < start.value - rounding(base_.f, start.value);
        if (restarted && !fell) return judge(trials - 1 > beyond);
        if (restarted) return steepest(), true;
        restarted = true;
        if (!exact_ && !settle()) return false;
        if (norm_ <= target_) return true;
        steepest();
        so_far = {{base_.f, down_}};
        place_trial(alpha_);
      }
      if (!evaluate(trial_)) return false;
      // if a trial is doubtful, an interpolated base may be to blame: it is evaluated
      const auto renew = [&] {
        const double length = alpha_ * std::sqrt(length2_);
        if (!settle()) return false;
        if (options_.memory == 0) alpha_ = length / std::sqrt(length2_);
        so_far.start = {base_.f, down_};
        return true;
      };
      if (!std::isfinite(trial_.f) || !std::isfinite(square_)) {
        if (beyond++ == 0) ++walled_;
        if (exact_)
          high = wall = std::exchange(alpha_, 0.1 * alpha_);
        else if (!renew())
          return false;
        continue;
      }
      const LineModel model({base_.f, down_}, {trial_.f, slope_}, alpha_, rounding(base_.f, trial_.f));
      const bool falls = trial_.f <= start.value + 1e-4 * (moved + alpha_) * start.slope;
      const bool level = is_level(start.value);
      const bool flat = std::abs(slope_) <= sigma * std::abs(start.slope);
      if (level && std::sqrt(square_) <= target_) return advance(1.0, moved), true;
      // the error of an interpolated base is carried on, times 1 - r; not too far where values hide it
      const double off = std::abs(model.r - 1.0);
      const double undetected =
          (exact_ ? 0.0 : off * undetected_) + (model.blind() ? off * std::max(1.0, model.r) : 0.0);
      const bool recovers =
          model.trusted() && (exact_ || undetected <= 30.0) && (model.r <= 1.0 || std::isinf(wall));
      if (recovers && !(falls && off < 1e-6)) {
        undetected_ = undetected;
        return advance(model.r, moved, base_.f + 0.5 * model.r * alpha_ * down_), true;
      }
      // next to where f is not finite: farther along the line, the next one would have less room
      const bool walled = falls && high == wall && alpha_ >= 0.09 * high;
      if (((falls || level) && flat) || walled) return advance(1.0, moved), true;
      const bool doubtful = model.defect > 0.3 || (model.trusted() && !recovers);
      if (!exact_ && since_start == 1 && doubtful) {
        if (!renew()) return false;
        continue;
      }
      if (slope_ < 0.0 && (falls || level)) {  // go on from here
        std::swap(base_, trial_);
        norm_ = std::sqrt(square_);
        exact_ = true;
        down_ = slope_;
        moved += alpha_, high -= alpha_, wall -= alpha_;
        alpha_ *= model.beyond() - 1.0;
        if (std::isinf(high)) trials = beyond = 0;
        if (alpha_ >= high) alpha_ = 0.5 * high;
      } else {
        high = alpha_;
        alpha_ *= model.cubic();
      }
      misses.add(model);
      // Points this close to each other differ by what the slopes say, unless f bends.
      if (trials - beyond >= 5) {
        scale_ = std::max(scale_, std::abs(start.value));
        const double seen = std::min(4.0 * misses.size(), 1e-8 * scale_);
        noise_ = misses.bends(model, seen, 1e-13 * scale_) ? noise : std::max(noise_, seen);
      }
    }
  }

  /// Returns false if for long no evaluated value or gradient was lower than all before, and values
  /// contradict the slope, as at a kink; or if that lasts so long that rounding moves the run; or if, along a
  /// wall, f fell by next to nothing in 500 iterations: it may do so for ever, and by ever less.
  bool gains() {
    if (iterations_ % 500 == 0) {
      const double fell = std::exchange(before_wall_, base_.f) - base_.f;
      if (std::exchange(walled_, 0) > 100 && fell < 1e-9 * (first_ - base_.f)) return judge(true, true);
    }
    if (idle_ == 200 && !exact_ && !settle()) return false;
    if (exact_) level_ = std::min(level_, base_.f);
    if ((exact_ && base_.f < lowest_ - rounding(base_.f, lowest_)) || square_ < gentlest_) {
      if (exact_) lowest_ = std::min(lowest_, base_.f);
      gentlest_ = std::min(gentlest_, square_);
      idle_ = waits_ = 0;
    }
    if (++idle_ <= 200) return true;
    idle_ = 0;
    if (waits_ == 0) noise_ = 0.0;                     // if too large, it would hide gains: it is found anew
    return judge(true) || (agrees_ && ++waits_ < 20);  // in hard valleys, runs waited five times
  }

  [[nodiscard]] View view(const Entries& x) const { return {x.data, n_}; }

  /// Returns f on the line, as a function of alpha.
  auto values_along_d() {
    return [this](double alpha) {
      place_trial(alpha);
      return value_at(trial_);
    };
  }

  /// Distance along d, in units of d, at which values are taken to find a slope: a part of the size of x or
  /// x0, as a kink is at 0 more often than elsewhere. The next trial may be much too far. If both are 0, or
  /// as good as 0 since all trials from there failed, only f and its gradient tell of a size.
  [[nodiscard]] double asked_at() const {
    const double length = std::sqrt(length2_), x = std::max(norm(view(base_.x)), size0_);
    return 1e-4 * ((x > 1e-9 * first_trial_ ? x : first_trial_) / length);
  }

  /// Finds why steepest descent gained nothing: rounding hides the fall, the gradient is not that of f, or f
  /// is not finite; or, without a tolerance, its square underflows and it is as good as 0. @return false
  bool judge(bool finite, bool walled = false) {
    if (agrees_ = false; target_ == 0.0 && norm_ < 1e-150) return fail(Outcome::ok, {});
    double most = 0.0;
    const auto phi = [&](double alpha) {
      const double value = values_along_d()(alpha), apart = std::abs(value - base_.f);
      most = std::max(most, apart), finite = finite && std::isfinite(apart);
      return value;
    };
    const SlopeByValues by = finite ? slope_by_values(phi, asked_at()) : SlopeByValues();
    // beside what f does there, the gradient is as good as 0: uneven values say nothing about it
    const bool small = std::abs(down_) * asked_at() < 1e-8 * most;
    agrees_ = !finite || small || by.agrees_with(down_, 0.1 * std::abs(down_));  // nor does a wall so near
    if (!finite || (walled && agrees_ && !small))
      return fail(Outcome::non_finite, "f or its gradient is not finite wherever the run turns");
    if (jumps_up(values_along_d(), base_.f, down_, asked_at(), most))
      return fail(Outcome::no_descent, "f jumps up wherever the run turns, as at a wall of finite height");
    if (agrees_) return fail(Outcome::stalled, "rounding of f hides what could still be gained");
    const double resolution =
        std::numeric_limits<double>::epsilon() * norm(view(base_.x)) / std::sqrt(length2_);
    if (lost_in_rounding(values_along_d(), base_.f, down_, resolution))
      return fail(Outcome::stalled, "rounding of x hides what could still be gained");
    return fail(Outcome::no_descent, by.against(down_));
  }

  /// Checks the gradient at the start, on request.
  bool gradient_agrees() {
    mixed_direction(view(base_.x), d_);
    measure_direction();
    const double allowed = 1e-7 * view(base_.g).cwiseProduct(d_).lpNorm<1>();
    const SlopeByValues by = slope_to_compare(values_along_d(), asked_at(), down_, allowed);
    return by.agrees_with(down_, allowed) || fail(Outcome::wrong_gradient, by.against(down_));
  }

  /// Returns the place of the run, as its caller sees it.
  [[nodiscard]] MinimiserCalls::Place place(const Point& at) const {
    return {at.x.number, at.g.number, at.f, norm_, iterations_, evaluations_, exact_};
  }
  /// Reports to the callback; false if that asks to stop.
  bool report() { return calls_.report(place(base_)); }

  /// Ends the run at the base, or at the best evaluated point if the base is interpolated.
  MinimiserEnd end(Outcome outcome, std::string_view reason = {}) {
    const Point& last = exact_ ? base_ : best_;
    Iterate at;
    at.value = last.f;
    return {outcome, place(last),
            outcome == Outcome::ok ? std::string() : describe_end(outcome, iterations_, at, reason)};
  }

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

  [[nodiscard]] double first_step() const {
    return first_trial(base_.f, norm_, largest_entry(view(base_.g)), largest_entry(view(base_.x)));
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
  double norm_ = 0.0, target_ = 0.0;   ///< Norm of the gradient at the base, and the norm that ends the run.
  double alpha_ = 0.0;                 ///< Place of the next trial.
  double floor_ = -std::numeric_limits<double>::infinity();  ///< Value of f below which a run has diverged.
  double noise_ = 0.0;                        ///< Error of values, as seen where a line was stuck.
  bool exact_ = true;                         ///< Whether value and gradient at the base were evaluated.
  Outcome failure_ = Outcome::ok;             ///< Outcome with which the run ends.
  std::string reason_;                        ///< Reason, in words.
  long iterations_ = 0;                       ///< Iterations made.
  Eigen::Index entries_ = 0;                  ///< Size of the gradient that f left last.
  double first_ = 0.0;                        ///< f(x0).
  double level_ = 0.0;                        ///< Least f of an evaluated iterate.
  double norm0_ = 0.0, size0_ = 0.0;          ///< Norm of the gradient at x0, and of x0.
  double first_trial_ = 1.0;                  ///< Distance of the first trial from x0.
  double scale_ = 0.0;                        ///< Largest |f| at the start, and where lines were stuck.
  double lowest_ = 1e300, gentlest_ = 1e300;  ///< Least value, and square of an evaluated gradient, so far.
  double before_wall_ = 0.0;                  ///< f up to 500 iterations ago.
  long idle_ = 0;                             ///< Iterations since either fell, or values were asked.
  long walled_ = 0;          ///< Lines that met a wall, where f is not finite, in the last 500 iterations.
  int waits_ = 0;            ///< Times that values were asked since.
  bool agrees_ = false;      ///< Whether values agreed with the slope when they were last asked.
  double undetected_ = 0.0;  ///< Bound on the unseen error of an interpolated gradient, in roundings of one.
};

}  // namespace

MinimiserEnd AVI_MINIMISE(MinimiserCalls& calls, Eigen::Index n, const MinimiseOptions& options) {
  return MinimiserRun(calls, n, options).run();
}

}  // namespace avi::detail
