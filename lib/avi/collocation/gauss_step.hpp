#pragma once
#include "avi/collocation/newton.hpp"
#include "avi/core/require.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

/// @file
/// GaussStep: one step of collocation, from the first guess of the stages to the final sum.

namespace avi {

/// Steps of Gauss collocation with at most w stages. A step starts from the polynomial of the last one. It is
/// solved by sweeps, or by Newton's method where sweeps do not contract, and is summed with about twice the
/// digits of a double. For few degrees of freedom, a sweep leaves the processor room for another one. The
/// next step, assumed to have the same size, is then begun when this one is half solved, and discarded if the
/// size changes.
template <int n, int w>
class alignas(64) GaussStep {
 public:
  /// Steps are begun early: 1.3 times the speed at n = 2, no gain at n = 6.
  static constexpr bool ahead = n != dynamic && n <= 4 && w <= 8;
  using Scalar = Pack<w>;  ///< One number for each stage.

  /// For this field with n = `size`, and this rule of at most w stages.
  GaussStep(std::unique_ptr<StageField<n, w>> field, Eigen::Index size, const GaussRule& rule,
            SweepSettings settings)
      : equations_(std::move(field), rule), both_{StageValues<n, w>(size),
                                                  StageValues<n, w>(n == dynamic ? 0 : n)},
        last_(size), settings_(settings), end_(size), start_(size), change_(Vector<double, n>::Zero(size)),
        progress_(size), newton_(size, rule.stages()) {
    for (int j = 0; j < rule.stages(); ++j)
      last_legendre_.set(j, rule.last_legendre(j));
  }

  /// Advances z by h; z is unchanged unless the step ends as ok.
  StepReport step(State<n>& z, double h) {
    start_at(z);
    if (h != size_) equations_.set_step(h);
    if (h != size_ || place_ == Place::elsewhere) {  // what Newton's method has stored belongs to one orbit
      size_ = h;
      newton_.forget();
      stiff_ = 0;
      newton_failed_ = !newton_.possible();
    }
    StepReport report{.outcome = Outcome::not_converged};
    const auto unsolved = [&] {
      return report.outcome != Outcome::ok && report.outcome != Outcome::bad_monitor;
    };
    const auto from_a_constant = [&](auto how) {
      const int spent = report.evaluations;
      place_ = Place::elsewhere;
      report = (this->*how)(z, h);
      report.evaluations += spent;
    };
    const bool known = place_ != Place::elsewhere;
    if (stiff_ == 0) report = attempt(z, h);
    // The polynomial of the last step may have been a bad first guess: start from a constant.
    if (stiff_ == 0 && known && unsolved()) from_a_constant(&GaussStep::attempt);
    if (!newton_failed_ && unsolved()) {
      from_a_constant(&GaussStep::by_newton);
      // If entries do not differ much in size, such a step is simply too long.
      if (unsolved() && newton_.wide()) {
        start_at(z);
        const int spent = report.evaluations;
        report = at_stages(z, h);
        report.evaluations += spent;
      }
      if (unsolved()) {
        newton_failed_ = true;
        from_a_constant(&GaussStep::attempt);
      }
    }
    return report;
  }

  /// The collocation polynomial of the last step at the fraction c.
  [[nodiscard]] State<n> polynomial(const double c) const {
    const GaussRule::Row row = equations_.rule().quick_integrals(c);
    Scalar part(0.0);
    for (int j = 0; j < equations_.rule().stages(); ++j)
      part.set(j, row[j]);
    const auto at = [&](const Scalar& increments) { return sum(Scalar(part * increments)); };
    State<n> z = last_.start.state;
    for (Eigen::Index i = 0; i < z.q.size(); ++i) {
      z.q[i] += at(last_.dq[i]);
      z.p[i] += at(last_.dp[i]);
    }
    z.t = equations_.field().clock(z.q, z.t + at(dt_));
    return z;
  }

  /// The largest contribution of the last term of the polynomial to each entry; see Collocation::tail().
  void tail(double* q, double* p) const {
    for (Eigen::Index i = 0; i < last_.dq.size(); ++i) {
      q[i] = std::abs(sum(Scalar(last_legendre_ * last_.dq[i])));
      p[i] = std::abs(sum(Scalar(last_legendre_ * last_.dp[i])));
    }
  }

 private:
  enum class Place { elsewhere, begin, end };
  static constexpr int worth_it = 6;  // a step is begun early if the last one took at least this many sweeps

  /// Starts a step at z, with the rounding error kept from the last step if z is one of its ends.
  void start_at(const State<n>& z) {
    place_ = h_ == 0.0                ? Place::elsewhere  // there has been no step yet
             : z == end_.state        ? Place::end
             : z == last_.start.state ? Place::begin
                                      : Place::elsewhere;
    if (place_ == Place::elsewhere) {
      start_.low.q.setZero();
      start_.low.p.setZero();
      start_.low.t = 0.0;
    } else {
      start_.low = (place_ == Place::end ? end_ : last_.start).low;
    }
    start_.state = z;
  }

  /// First guess of the stages: the sweeps already made if this step was begun early, else the polynomial of
  /// the last step, else a constant. @return number of sweeps already made
  int begin(double h) {
    const int begun = std::exchange(begun_, 0);
    if (place_ != Place::end || h != h_) scaled_[0] = scaled_[1] = false;
    if (ahead && begun > 0 && place_ == Place::end && h == h_) {
      now_ = 1 - now_;
      StageValues<n, w>& step = both_[now_];
      step.start = start_;
      equations_.stages(step);
      if (!std::exchange(scaled_[now_], true)) step.per.set(step.start.state, step.dq, step.dp);
      return begun;
    }
    StageValues<n, w>& step = both_[now_];
    step.start = start_;
    if (is_like_the_last(h) && !(place_ == Place::begin && was_wild()))
      equations_.begin(step, last_.dq, last_.dp, place_ == Place::end ? 1.0 : 0.0, h / h_);
    else
      equations_.begin(step);
    return 0;
  }

  /// The last step gives a useful guess: it is adjacent, and at least half as long.
  [[nodiscard]] bool is_like_the_last(double h) const {
    return place_ != Place::elsewhere && std::abs(h / h_) <= 2.0;
  }
  /// The last step moved far beyond the size of its start. It was too long and says nothing about a shorter
  /// one.
  [[nodiscard]] bool was_wild() const {
    Scalar q(0.0), p(0.0);
    for (Eigen::Index i = 0; i < last_.dq.size(); ++i)
      q = max_abs(q, last_.dq[i]), p = max_abs(p, last_.dp[i]);
    return largest(q) > 1e3 * largest_entry(start_.state.q) ||
           largest(p) > 1e3 * largest_entry(start_.state.p);
  }

  /// A sweep after which every entry is compared, in its new scale. @return the largest change
  [[gnu::noinline]] double sweep_closely(StageValues<n, w>& step) {
    last_.q = step.q;
    last_.p = step.p;
    equations_.stages(step);
    step.per.set(step.start.state, step.dq, step.dp);
    progress_.look(last_, step);
    return progress_.change();
  }

  StepReport attempt(State<n>& z, double h) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    constexpr int many = 30;  // after this many, sweeps are slow and changes no longer bound the error
    double before = 0.0, ratio = 0.0;
    int slow = 0;
    bool closely = false, scaled = false;
    const bool unknown = !is_like_the_last(h);
    // A step that begins where the last one did searches for a point inside it, as for an event.
    [[maybe_unused]] const bool goes_on = place_ != Place::begin;
    // Such a step has nearly the length of the last one, which is a good guess, so changes are checked at
    // once.
    const int first_look = place_ == Place::end ? std::max(usual_ - 2, 1) : 1;
    StepReport report{.evaluations = begin(h)};
    StageValues<n, w>&step = both_[now_], &next = both_[1 - now_];
    if (unknown) progress_.restart();
    while (report.evaluations < settings_.max_sweeps) {
      const int k = ++report.evaluations;
      if constexpr (ahead) {
        if (begun_ == 0 && usual_ >= worth_it && k > usual_ / 2 && goes_on) {
          equations_.begin_next(step, next);
          begun_ = 1;
        }
      }
      equations_.forces(step);
      if constexpr (ahead)
        if (begun_ > 0) {
          equations_.sweep_next(step, next);
          ++begun_;
        }
      if (k < first_look) {
        equations_.stages(step);
        continue;
      }
      double change;
      if (closely || (unknown && k <= 3)) {
        change = sweep_closely(step);
      } else {
        if (k == first_look || (k == 2 && !scaled)) {
          const StageValues<n, w>& known = k == 1 ? last_ : step;
          scaled = scaled_[now_] = step.per.set(step.start.state, known.dq, known.dp);
        }
        change = largest(equations_.changed_stages(step));
      }
      report.residual = change;
      if (!std::isfinite(change)) {
        report.outcome = Outcome::non_finite;
        return report;
      }
      // Once in the regime of contraction, each change is change / before times the last one; the first
      // changes may have any size. At the level of rounding they stop falling.
      const bool falls = before > 0.0 && change < 0.5 * before;
      ratio = k <= many ? change / before : std::max(ratio, change / before);
      const bool solved = before <= 1.0 && falls && change * ratio <= limit_;
      ratio = change / before;
      const bool stagnates =
          before > 0.0 && !falls && change <= 16.0 * epsilon && (k <= many || change <= epsilon);
      if (change == 0.0 || solved || stagnates ||
          (closely && progress_.settled(k <= many ? 3 : 4, newton_failed_))) {
        // The forces are those before the sweep, the velocities those in its middle: with them, energy would
        // drift.
        usual_ = report.evaluations++;
        equations_.evaluate(step);
        return finish(z, h, step, report);
      }
      // Changes that are noise beside the largest entry would not fall by Newton's method either.
      slow = before > 0.0 && change > 0.5 * before && change > 1e-10 ? slow + 1 : 0;
      if (slow >= 3 && k > 6 && !newton_failed_ && !few_more(change, before, settings_.max_sweeps - k)) break;
      if (before > 0.0 && !falls && !closely) {
        closely = true;
        progress_.restart();
      }
      before = change;
    }
    report.outcome = Outcome::not_converged;
    return report;
  }

  /// True where sweeps at the current rate converge before a matrix for Newton's method would pay off.
  [[nodiscard]] bool few_more(double change, double before, int at_most) const {
    return change < before && std::log(limit_ / change) > std::min(40, at_most) * std::log(change / before);
  }

  [[gnu::noinline]] StepReport by_newton(State<n>& z, double h) {
    begun_ = 0;
    StageValues<n, w>& step = both_[now_];
    step.start = start_;
    StepReport report = newton_.solve(equations_, step, last_, settings_.max_sweeps);
    if (report.outcome == Outcome::ok) report = finish(z, h, step, report);
    // Sweeps are tried again once in 32 steps, as a stiff part of the orbit may have ended.
    stiff_ = report.outcome == Outcome::ok ? (stiff_ + 1) % 32 : 0;
    usual_ = 1;
    return report;
  }

  /// Newton's method with a Jacobian matrix at each stage, from the polynomial of the last step.
  [[gnu::noinline]] StepReport at_stages(State<n>& z, double h) {
    begun_ = 0;
    begin(h);
    StepReport report = newton_.solve_at_stages(equations_, both_[now_], last_, 4 * settings_.max_sweeps);
    if (report.outcome == Outcome::ok) report = finish(z, h, both_[now_], report);
    usual_ = 1;
    return report;
  }

  StepReport finish(State<n>& z, double h, const StageValues<n, w>& step, StepReport report) {
    const Scalar rate = equations_.field().rate(step), dt = rate * equations_.weight();
    for (Eigen::Index i = 0; i < z.q.size(); ++i)
      change_[i] = sum(step.dq[i]);
    double least = std::numeric_limits<double>::infinity();
    if (!detail::underflows(h))
      least = equations_.field().clock(change_, sum(dt)) / h;  // covers problems where time is a coordinate
    for (int i = 0; i < equations_.rule().stages(); ++i)
      least = !(rate[i] >= least) ? rate[i] : least;
    if (!(least > 0.0)) {
      report.outcome = least <= 0.0 ? Outcome::bad_monitor : Outcome::non_finite;
      return report;
    }
    last_.start = end_ = start_;
    for (Eigen::Index i = 0; i < z.q.size(); ++i) {
      add_all(end_.state.q[i], end_.low.q[i], step.dq[i]);
      add_all(end_.state.p[i], end_.low.p[i], step.dp[i]);
    }
    add_all(end_.state.t, end_.low.t, dt);
    end_.state.t = equations_.field().clock(end_.state.q, end_.state.t);
    z = end_.state;
    last_.dq = step.dq;
    last_.dp = step.dp;
    dt_ = dt;
    h_ = h;
    return report;
  }

  StageEquations<n, w> equations_;
  StageValues<n, w> both_[2];  // this step and the next one, which may be begun early
  int now_ = 0;                // which of the two is this step
  StageValues<n, w> last_;     // start and increments of the last step; its q and p are scratch
  Scalar dt_{0.0};             // of the last step
  Scalar last_legendre_{0.0};
  SweepSettings settings_;
  PreciseState<n> end_, start_;  // end of the last step, start of this one
  Vector<double, n> change_;
  EntryProgress<n, w> progress_;
  NewtonIteration<n, w> newton_;
  int stiff_ = 0;  // steps in a row solved by Newton's method
  // Within a step an entry may be forty times its smallest value (Kepler, e = 0.9, eight steps a period). At
  // the level of rounding this does not matter. For loose tolerances, a sixteenth keeps the error of a run
  // near the tolerance.
  double limit_ = settings_.tolerance > 1e-15 ? settings_.tolerance / 16.0 : settings_.tolerance;
  bool newton_failed_ = false;   // at this h, or Newton's method is impossible: only sweeps remain
  double h_ = 0.0, size_ = 0.0;  // size of the last step; size for which the sweeps are set up
  Place place_ = Place::elsewhere;
  int usual_ = 1;                    // sweeps of the last step
  int begun_ = 0;                    // sweeps already made for the next step
  bool scaled_[2] = {false, false};  // the scales of both_ belong to this orbit
};

}  // namespace avi
