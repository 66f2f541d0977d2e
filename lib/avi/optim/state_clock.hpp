#pragma once
#include "avi/optim/line_model.hpp"
#include "avi/optim/line_state.hpp"
#include "avi/optim/slope_check.hpp"

/// @file
/// The symplectic heavy ball whose clock is driven by the state: the method of avi::minimise().

namespace avi {

/// One run of the heavy ball \f[ x_+ = x + \alpha d, \qquad d_+ = \beta d - \nabla f(x_+) \f] with alpha and
/// beta from the state at the step's start; with d = R it is the order-0 HTVI of the Bregman Hamiltonian
/// (bregman/bregman_htvi.hpp) with a clock that is frozen over a step. With a memory of m > 0 pairs,
/// \f$d = -H \nabla f\f$: a variable mass matrix \f$H^{-1}\f$ takes the place of the momentum.
///
/// **Gradient recovery.** One trial along d gives value and slope at two points of the line. Where the values
/// confirm that f is quadratic in between (LineModel), the minimiser of the line and the gradient there
/// follow by interpolation, so an iteration costs one evaluation. Otherwise the trial is taken as it is when
/// it satisfies Wolfe's conditions, or the line is searched. An interpolated point that fails later is
/// evaluated; if f rose, the run goes back to the best point that was evaluated.
///
/// Theory, choices of alpha and beta, and measurements: @ref optimisation.
class StateClock : LineState {
 public:
  using LineState::LineState;  // f, x0, options

  /// Minimises. To be called once.
  Minimisation run() {
    if (!evaluate(base_)) return end(failure_, reason_);
    norm_ = std::sqrt(square_);
    const double steepness = largest_entry(base_.g);
    if (!std::isfinite(steepness))
      return end(Outcome::non_finite, "the gradient at x0 is not finite, or f did not fill it");
    if (!std::isfinite(norm_)) return out_of_range(" at x0");
    if (!std::isfinite(base_.f)) return end(Outcome::non_finite, "f(x0) is not finite");
    scale_ = std::abs(base_.f);
    norm0_ = length(base_.g);
    target_ = std::max(options_.relative * norm0_, options_.absolute);
    if (underflows()) return out_of_range(" at x0");
    floor_ = -std::min(1e30 * std::max(1.0, scale_), std::numeric_limits<double>::max());
    if (options_.check_gradient && !gradient_agrees()) return end(failure_, reason_);
    steepest();
    if (!report()) return end(Outcome::stopped, "the callback asked to stop");
    if (norm_ <= target_) return end(Outcome::ok);
    while (run_.iterations < options_.iterations) {
      const double before = base_.f;
      if (!line()) return end(failure_, reason_);
      ++run_.iterations;
      if (underflows()) return out_of_range();
      bool done = norm_ <= target_ && std::abs(base_.f - before) < options_.change;
      if (done && !exact_) {
        settle();
        done = norm_ <= target_;
      }
      if (!report()) return end(Outcome::stopped, "the callback asked to stop");
      if (done) return end(Outcome::ok);
      if (!gains()) return end(failure_, reason_);
    }
    return end(Outcome::step_limit, "the cap on iterations was reached");
  }

 private:
  /// Whether the gradient at the base is so small that the squares of its entries underflow, and not small
  /// enough to be done: what norms say of it is not to be trusted, then. A run
  /// without a tolerance, which has come that far from somewhere else, goes on until the norm is 0.
  bool underflows() {
    if (!(norm_ < 1e-150)) return false;
    if (!exact_) settle();
    const double by_scale = length(base_.g);
    if (target_ == 0.0 && by_scale < 1e-100 * norm0_) return false;
    norm_ = by_scale;
    return norm_ > target_ && norm_ < 1e-150;
  }

  Minimisation out_of_range(std::string_view where = {}) {
    return end(Outcome::non_finite, "the square of the gradient" + std::string(where) +
                                        " is beyond the range of numbers; scale f");
  }

  /// One iteration: trials along d until one of them gives the next point. False sets failure_.
  bool line() {
    LinePoint start{base_.f, down_};
    double moved = 0.0, high = std::numeric_limits<double>::infinity();
    const double sigma = options_.memory == 0 ? 0.7 : 0.8;
    bool restarted = false;
    for (int trials = 1, since_start = 1;; ++trials, ++since_start) {
      if (evaluations_ >= options_.evaluations)
        return fail(Outcome::step_limit, "the cap on evaluations was reached");
      place_trial(alpha_);
      const bool stands = trial_.x == base_.x;
      if (trials > 40 || stands || !(alpha_ > 0.0)) {  // nothing on this line: steepest descent, once
        if (restarted) return judge();
        restarted = true;
        if (!exact_) settle();
        if (norm_ <= target_) return true;
        steepest();
        start = {base_.f, down_};
        moved = 0.0, high = std::numeric_limits<double>::infinity();
        trials = since_start = 1;
        place_trial(alpha_);
      }
      if (!evaluate(trial_)) return false;
      if (trial_.f < floor_) return fail(Outcome::diverged, "f has no lower bound along a line");
      if (!std::isfinite(trial_.f) || !std::isfinite(square_)) {
        high = alpha_;
        alpha_ *= 0.1;
        continue;
      }
      const LineModel model({base_.f, down_}, {trial_.f, slope_}, alpha_, rounding(base_.f, trial_.f));
      const bool falls = trial_.f <= start.value + 1e-4 * (moved + alpha_) * start.slope;
      const bool level = trial_.f <= start.value + rounding(start.value, trial_.f);
      const bool flat = std::abs(slope_) <= sigma * std::abs(start.slope);
      if (level && std::sqrt(square_) <= target_) return advance(1.0, moved), true;
      // an error of an interpolated base is carried on with the factor 1 - r; where the values cannot show
      // one, it must not be carried too far
      const double off = std::abs(model.r - 1.0);
      const double unseen =
          (exact_ ? 0.0 : off * unseen_) + (model.blind() ? off * std::max(1.0, model.r) : 0.0);
      const bool recovers = model.trusted() && (exact_ || unseen <= 30.0);
      if (recovers && !(falls && off < 1e-6)) {
        unseen_ = unseen;
        return advance(model.r, moved, base_.f + 0.5 * model.r * alpha_ * down_), true;
      }
      if ((falls || level) && flat) return advance(1.0, moved), true;
      const bool doubtful = model.defect > 0.3 || (model.trusted() && !recovers);
      if (!exact_ && since_start == 1 && doubtful) {  // the interpolated base may be to blame
        const double length = alpha_ * std::sqrt(length2_);
        settle();
        if (options_.memory == 0) alpha_ = length / std::sqrt(length2_);
        start = {base_.f, down_};
        continue;
      }
      if (slope_ < 0.0 && (falls || level)) {  // go on from here
        std::swap(base_, trial_);
        norm_ = std::sqrt(square_);
        exact_ = true;
        down_ = slope_;
        moved += alpha_;
        high -= alpha_;
        alpha_ *= model.beyond() - 1.0;
        if (std::isinf(high)) trials = 0;
        if (alpha_ >= high) alpha_ = 0.5 * high;
      } else {
        high = alpha_;
        alpha_ *= model.cubic();
      }
      // so near to each other the points differ by what the slopes say; what else the values do is noise
      if (trials >= 5) {
        scale_ = std::max(scale_, std::abs(start.value));
        noise_ = std::max(noise_, std::min(4.0 * std::abs(model.trapezium()), 1e-8 * scale_));
      }
    }
  }

  /// False where for long neither the value nor an evaluated gradient has come lower than ever before, and
  /// values contradict the slope, as at a kink; or for so long that it is rounding that moves the run. (Hard
  /// valleys waited five times for their next gain.)
  bool gains() {
    if (base_.f < lowest_ - rounding(base_.f, lowest_) || square_ < gentlest_) {
      lowest_ = std::min(lowest_, base_.f);
      gentlest_ = std::min(gentlest_, square_);
      idle_ = waits_ = 0;
    }
    if (++idle_ <= 200) return true;
    if (!exact_) settle();
    idle_ = 0;
    return judge() || (agrees_ && ++waits_ < 20);
  }

  /// f on the line, as a function of alpha.
  auto values_along_d() {
    return [this](double alpha) {
      place_trial(alpha);
      return value_at(trial_);
    };
  }

  SlopeByValues slope_along_d(double nearer = 1.0) {
    const double length = std::sqrt(length2_), size = std::max(norm(base_.x), alpha_ * length);
    return slope_by_values(values_along_d(), nearer * 1e-4 * (size > 0.0 ? size / length : 1.0));
  }

  /// Why steepest descent found nothing: rounding hides the fall, or the gradient is not that of f. Always
  /// false.
  bool judge() {
    if (!std::isfinite(trial_.f) || !std::isfinite(square_))
      return fail(Outcome::non_finite, "f or its gradient is not finite wherever the run turns");
    const SlopeByValues by = slope_along_d();
    agrees_ = by.agrees_with(down_, 0.1 * std::abs(down_));
    if (agrees_) return fail(Outcome::stalled, "rounding of f hides what could still be gained");
    const double resolution = std::numeric_limits<double>::epsilon() * norm(base_.x) / std::sqrt(length2_);
    if (lost_in_rounding(values_along_d(), base_.f, down_, resolution))
      return fail(Outcome::stalled, "rounding of x hides what could still be gained");
    return fail(Outcome::no_descent, by.against(down_));
  }

  /// The check on request, at the start. Where the slope by values depends on the distance at which they are
  /// taken, they are taken nearer to each other.
  bool gradient_agrees() {
    mixed_direction(base_.x, d_);
    measure_direction();
    SlopeByValues by = slope_along_d();
    for (double nearer = 1.0 / 64.0; by.depends_on_distance() && nearer > 1e-9; nearer /= 64.0)
      by = slope_along_d(nearer);
    if (by.agrees_with(down_, 1e-7 * base_.g.cwiseProduct(d_).lpNorm<1>())) return true;
    return fail(Outcome::wrong_gradient, by.against(down_));
  }

  /// Tells the callback; false where it asks to stop.
  bool report() {
    return !options_.callback ||
           options_.callback({base_.x, base_.g, base_.f, norm_, run_.iterations, evaluations_, exact_});
  }

  /// Hands out the base, or the best evaluated point where the base is interpolated.
  Minimisation end(Outcome outcome, std::string_view reason = {}) {
    auto& last = exact_ ? base_ : best_;
    run_.last.x.swap(last.x);
    run_.last.gradient.swap(last.g);
    run_.last.value = last.f;
    run_.last.evaluated = true;
    run_.outcome = outcome;
    run_.gradient_evaluations = run_.function_evaluations = evaluations_;
    if (outcome != Outcome::ok)
      run_.message = detail::describe_end(outcome, run_.iterations, run_.last, reason);
    return std::move(run_);
  }

  Minimisation run_;
  double norm0_ = 0.0;                        ///< Norm of the gradient at x0.
  double scale_ = 0.0;                        ///< Largest |f| of the start and of where lines were stuck.
  double lowest_ = 1e300, gentlest_ = 1e300;  ///< Least value, and square of an evaluated gradient, so far.
  long idle_ = 0;        ///< Iterations since either came down, or since values were asked.
  int waits_ = 0;        ///< Times they were asked since.
  bool agrees_ = false;  ///< Whether values agreed with the slope when they were last asked.
  double unseen_ = 0.0;  ///< Errors of the recovered gradient that values did not show, in units of one.
};

}  // namespace avi
