#include "avi/optim/line_model.hpp"
#include "src/minimise/descent.hpp"
#include "src/minimise/slope_check.hpp"

#include <optional>
#include <string_view>

/// @file
/// The decisions of a run of avi::minimise(): where along a line the next point lies, and when the run ends.

// Compiled once for each set of instructions, each time under another name; builds.cpp chooses.
#ifndef AVI_MINIMISE
#define AVI_MINIMISE minimise_portable
#endif

namespace avi::detail {

namespace {

/// A run of Minimiser.
class MinimiserRun : Descent {
 public:
  using Descent::Descent;
  /// Minimises f. To be called once.
  MinimiserEnd run() {
    if (!evaluate(base_)) return end(failure_, reason_);
    if (!std::isfinite(base_.f)) return end(Outcome::non_finite, "f(x0) is not finite");
    norm_ = std::sqrt(square_);
    const double steepness = largest_entry(view(base_.g));
    if (!std::isfinite(steepness))
      return end(Outcome::non_finite, "the gradient at x0 is not finite, or f did not fill it");
    if (!std::isfinite(norm_)) return out_of_range(" at x0");
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
      const bool done = is_minimum(norm_, base_.f - before);
      if (!report()) return end(Outcome::stopped, "the callback asked to stop");
      if (done) return end(Outcome::ok);
      if (!gains()) return end(failure_, reason_);
    }
    return end(Outcome::step_limit, "the cap on iterations was reached");
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

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

  /// A search along d. Distances are measured from the base, which may move along the line.
  struct Line {
    LinePoint start;         ///< Value and slope where the search began.
    double noise;            ///< Error of values, as known before.
    LineMisses misses{};     ///< How far values and slopes disagreed.
    bool steepest = false;   ///< Whether d is steepest descent since another direction led nowhere.
    double moved = 0.0;      ///< Distance of the base from the start.
    double high = infinity;  ///< Upper bound for trials: f rose there, or was not finite.
    double wall = infinity;  ///< Smallest distance at which f was not finite.
    int trials = 1;          ///< Number of trials, including the one to come.
    int since_start = 1;     ///< The same, but not reset when the base moves.
    int beyond = 0;          ///< Number of trials at which f was not finite.
  };

  /// Makes one iteration: trials along d until one gives the next point. Returns false on failure.
  bool line() {
    Line line{.start = {base_.f, down_}, .noise = noise_};
    for (;; ++line.trials, ++line.since_start) {
      place_trial(alpha_);
      if (line.trials > 40 || view(trial_.x) == view(base_.x) || !(alpha_ > 0.0)) {
        if (const std::optional<bool> over = start_again(line)) return *over;
      }
      if (evaluations_ >= options_.evaluations) return capped();
      if (!evaluate(trial_)) return false;
      if (!std::isfinite(trial_.f) || !std::isfinite(square_)) {
        if (!turn_back(line)) return false;
        continue;
      }
      const LineModel model({base_.f, down_}, {trial_.f, slope_}, alpha_, rounding(base_.f, trial_.f));
      if (takes(line, model)) return true;
      const bool doubtful = model.defect > 0.3 || (model.trusted() && !recovers(line, model));
      if (!exact_ && line.since_start == 1 && doubtful) {
        if (!renew(line)) return false;
        continue;
      }
      go_on(line, model);
      learn_noise(line, model);
    }
  }

  /// Begins anew with steepest descent, once. Returns how the line ends, if it does.
  std::optional<bool> start_again(Line& line) {
    // Towards a wall, f may fall along more than one line.
    const bool fell = base_.f < line.start.value - rounding(base_.f, line.start.value);
    if (line.steepest && !fell) return judge(line.trials - 1 > line.beyond);
    if (line.steepest) return steepest(), true;
    if (!exact_ && !settle()) return false;
    if (norm_ <= target_) return true;
    ++stuck_;
    steepest();
    line = {.start = {base_.f, down_}, .noise = line.noise, .misses = line.misses, .steepest = true};
    place_trial(alpha_);
    return {};
  }

  /// Evaluates an interpolated base, which may be to blame if a trial is doubtful. Returns false on failure.
  bool renew(Line& line) {
    const double length = alpha_ * std::sqrt(length2_);
    if (!settle()) return false;
    if (options_.memory == 0) alpha_ = length / std::sqrt(length2_);
    line.start = {base_.f, down_};
    return true;
  }

  /// Turns back from where f or its gradient is not finite. Returns false on failure.
  bool turn_back(Line& line) {
    if (line.beyond++ == 0) ++walled_;
    if (!exact_) return renew(line);
    line.high = line.wall = std::exchange(alpha_, 0.1 * alpha_);
    return true;
  }

  /// Whether a gradient of this length, after f has changed by so much, counts as that of a minimum.
  [[nodiscard]] bool is_minimum(double length, double change) const {
    return length <= target_ && (std::isinf(options_.change) || std::abs(change) < options_.change);
  }
  /// Whether the trial is lower than the start by as much as the slope there promises (Armijo).
  [[nodiscard]] bool falls(const Line& line) const {
    return trial_.f <= line.start.value + 1e-4 * (line.moved + alpha_) * line.start.slope;
  }

  /// Bound on the unseen error of the gradient that the model gives: that of an interpolated base is carried
  /// on, times 1 - r.
  [[nodiscard]] double undetected(const LineModel& model) const {
    const double off = std::abs(model.r - 1.0);
    return (exact_ ? 0.0 : off * undetected_) + (model.blind() ? off * std::max(1.0, model.r) : 0.0);
  }
  /// Whether the next point may be taken from the model.
  [[nodiscard]] bool recovers(const Line& line, const LineModel& model) const {
    return model.trusted() && (exact_ || undetected(model) <= 30.0) &&
           (model.r <= 1.0 || std::isinf(line.wall));
  }

  /// Moves to the minimum of the model or to the trial, if one of them will do.
  bool takes(const Line& line, const LineModel& model) {
    const bool falls_enough = falls(line), level = is_level(line.start.value);
    if (level && is_minimum(std::sqrt(square_), trial_.f - line.start.value))
      return advance(1.0, line.moved), true;
    if (recovers(line, model) && !(falls_enough && std::abs(model.r - 1.0) < 1e-6)) {
      undetected_ = undetected(model);
      return advance(model.r, line.moved, base_.f + 0.5 * model.r * alpha_ * down_), true;
    }
    const double sigma = options_.memory == 0 ? 0.7 : 0.8;
    const bool flat = std::abs(slope_) <= sigma * std::abs(line.start.slope);
    // next to where f is not finite: farther along the line, the next one would have less room
    const bool walled = falls_enough && line.high == line.wall && alpha_ >= 0.09 * line.high;
    if (((falls_enough || level) && flat) || walled) return advance(1.0, line.moved), true;
    return false;
  }

  /// Places the next trial beyond this one if f still falls here, and before it otherwise.
  void go_on(Line& line, const LineModel& model) {
    if (!(slope_ < 0.0 && (falls(line) || is_level(line.start.value)))) {
      line.high = alpha_;
      alpha_ *= model.cubic();
      return;
    }
    std::swap(base_, trial_);
    norm_ = std::sqrt(square_);
    exact_ = true;
    down_ = slope_;
    line.moved += alpha_, line.high -= alpha_, line.wall -= alpha_;
    alpha_ *= model.beyond() - 1.0;
    if (std::isinf(line.high)) line.trials = line.beyond = 0;
    if (alpha_ >= line.high) alpha_ = 0.5 * line.high;
  }

  /// Learns from a line that is stuck how far values are off: points this close to each other differ by what
  /// the slopes say, unless f bends.
  void learn_noise(Line& line, const LineModel& model) {
    line.misses.add(model);
    if (line.trials - line.beyond < 5) return;
    scale_ = std::max(scale_, std::abs(line.start.value));
    const double seen = std::min({4.0 * line.misses.size(), 1e-8 * scale_, most_noise_});
    noise_ = line.misses.bends(model, seen, 1e-13 * scale_) ? line.noise : std::max(noise_, seen);
  }

  /// Returns false if for long no evaluated value or gradient was lower than all before and values contradict
  /// the slope, as at a kink, or this has lasted so long that only rounding moves the run; if line after line
  /// led nowhere; or if, along a wall, f fell by next to nothing in 500 iterations: it may do so for ever,
  /// and by ever less.
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
      idle_ = waits_ = stuck_ = 0;
    }
    if (stuck_ >= 200) return (exact_ || settle()) && judge(true);
    if (++idle_ <= 200) return true;
    idle_ = 0;
    noise_ = waits_ == 0 ? 0.0 : std::min(noise_, most_noise_);  // too large, it would hide gains
    return judge(true) || (agrees_ && ++waits_ < 20);  // five times were needed in the hardest valleys
  }

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
  /// is not finite; or, without a tolerance, its square underflows and it is as good as 0. Also bounds the
  /// noise that later lines may learn.
  /// @return false
  bool judge(bool finite, bool walled = false) {
    if (agrees_ = false; target_ == 0.0 && norm_ < 1e-150) return fail(Outcome::ok, {});
    double most = 0.0;
    const auto phi = [&](double alpha) {
      const double value = values_along_d()(alpha), apart = std::abs(value - base_.f);
      most = std::max(most, apart), finite = finite && std::isfinite(apart);
      return value;
    };
    const SlopeByValues by = finite ? slope_by_values(phi, asked_at()) : SlopeByValues();
    // a kink, where values and slopes disagree as well, may have been taken for noise
    if (finite) {
      const SlopeByValues near = slope_to_compare(values_along_d(), asked_at(), down_, 0.1 * std::abs(down_));
      most_noise_ = 10.0 * std::max(near.uncertainty, std::abs(near.slope - down_)) * near.apart;
    }
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
    SlopeByValues by = slope_to_compare(values_along_d(), asked_at(), down_, allowed);
    if (by.agrees_with(down_, allowed)) return true;
    by.uncertainty += noise_of_values(values_along_d(), 1e-8 * asked_at()) / by.apart;
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

  double target_ = 0.0;                       ///< Norm of the gradient that ends the run.
  long iterations_ = 0;                       ///< Iterations made.
  double norm0_ = 0.0, size0_ = 0.0;          ///< Norm of the gradient at x0, and of x0.
  double first_trial_ = 1.0;                  ///< Distance of the first trial from x0.
  double scale_ = 0.0;                        ///< Largest |f| at the start, and where lines were stuck.
  double most_noise_ = infinity;              ///< Bound on the noise, from values that were asked.
  double lowest_ = 1e300, gentlest_ = 1e300;  ///< Least value, and square of an evaluated gradient, so far.
  double before_wall_ = 0.0;                  ///< f up to 500 iterations ago.
  long idle_ = 0;            ///< Iterations since lowest_ or gentlest_ fell, or values were asked.
  int stuck_ = 0;            ///< Lines that led nowhere since lowest_ or gentlest_ fell.
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
