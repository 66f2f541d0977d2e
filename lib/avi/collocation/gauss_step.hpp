#pragma once
#include "avi/collocation/newton.hpp"
#include "avi/core/require.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

/// @file
/// A step of collocation: where it starts, when it is solved, how it ends.

namespace avi {

/// Gauss collocation with at most w stages: a step starts from the polynomial of the last one, is solved by
/// sweeps or where they do not contract by Newton's method, and is added up in about twice the digits of a
/// double. For few degrees of freedom, where a sweep
/// leaves the processor room for another, the next step is begun when this one is half solved, as if it would
/// have the same size; it is thrown away where it has not.
template <int n, int w>
class alignas(64) GaussStep {
 public:
  /// Steps are begun ahead: 1.3 times the speed at n = 2, nothing gained at n = 6.
  static constexpr bool ahead = n != dynamic && n <= 4 && w <= 8;
  using Scalar = Pack<w>;  ///< One number for each stage.

  /// Takes this field, with n = `size`, and this rule of at most w stages.
  GaussStep(std::unique_ptr<StageField<n, w>> field, Eigen::Index size, const GaussRule& rule,
            SweepSettings settings)
      : equations_(std::move(field), rule), both_{StageValues<n, w>(size),
                                                  StageValues<n, w>(n == dynamic ? 0 : n)},
        last_(size), settings_(settings), end_(size), start_(size), change_(Vector<double, n>::Zero(size)),
        progress_(size), newton_(size, rule.stages()) {
    for (int j = 0; j < rule.stages(); ++j)
      last_legendre_.set(j, rule.last_legendre(j));
  }

  /// Advances z by h; leaves z unchanged unless the step ends as ok.
  StepReport step(State<n>& z, double h) {
    start_at(z);
    if (h != size_) equations_.set_step(h);
    if (h != size_ || place_ == Place::elsewhere) {  // what is known of Newton's method is of this orbit
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
    // The polynomial of the last step may have been a bad guess.
    if (stiff_ == 0 && known && unsolved()) from_a_constant(&GaussStep::attempt);
    if (!newton_failed_ && unsolved()) {
      from_a_constant(&GaussStep::by_newton);
      // Elsewhere such a step is too long.
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

  /// The collocation polynomial of the last step at its fraction c.
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

  /// How much the last term of the polynomial of the last step adds to each entry: see Collocation::tail().
  void tail(double* q, double* p) const {
    for (Eigen::Index i = 0; i < last_.dq.size(); ++i) {
      q[i] = std::abs(sum(Scalar(last_legendre_ * last_.dq[i])));
      p[i] = std::abs(sum(Scalar(last_legendre_ * last_.dp[i])));
    }
  }

 private:
  enum class Place { elsewhere, begin, end };
  static constexpr int worth_it = 6;  // sweeps from which on a step is begun ahead

  /// The start of a step at z, with the rounding error of the last step if that led to z.
  void start_at(const State<n>& z) {
    place_ = h_ == 0.0                ? Place::elsewhere  // there is no last step, whatever z is
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

  /// Begins the step: with the sweeps that it has had already, from the polynomial of the last step, or from
  /// nothing. @return sweeps that it has had
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

  /// The last step says where this one leads, and how far: it was half as long at least.
  [[nodiscard]] bool is_like_the_last(double h) const {
    return place_ != Place::elsewhere && std::abs(h / h_) <= 2.0;
  }
  /// The last step led far beyond the size of its start: it was too long, and says nothing of a shorter one.
  [[nodiscard]] bool was_wild() const {
    Scalar q(0.0), p(0.0);
    for (Eigen::Index i = 0; i < last_.dq.size(); ++i)
      q = max_abs(q, last_.dq[i]), p = max_abs(p, last_.dp[i]);
    return largest(q) > 1e3 * largest_entry(start_.state.q) ||
           largest(p) > 1e3 * largest_entry(start_.state.p);
  }

  /// A sweep of which every entry is looked at, in the scale it has after it. @return the largest change
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
    constexpr int many = 30;  // after so many sweeps they are slow: changes are no bound of what is left
    double before = 0.0, ratio = 0.0;
    int slow = 0;
    bool closely = false, scaled = false;
    const bool unknown = !is_like_the_last(h);
    // Who steps again from where the last step began looks for a point on the way.
    [[maybe_unused]] const bool goes_on = place_ != Place::begin;
    // A step from where the last one began is a little longer or shorter than that, which is a good guess.
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
      // The changes fall by change / before each time, once they do: at first they may be of any size. At the
      // level of rounding they stop falling.
      const bool falls = before > 0.0 && change < 0.5 * before;
      ratio = k <= many ? change / before : std::max(ratio, change / before);
      const bool solved = before <= 1.0 && falls && change * ratio <= limit_;
      ratio = change / before;
      const bool stagnates =
          before > 0.0 && !falls && change <= 16.0 * epsilon && (k <= many || change <= epsilon);
      if (change == 0.0 || solved || stagnates ||
          (closely && progress_.settled(k <= many ? 3 : 4, newton_failed_))) {
        // The forces are from before the sweep, the velocities from its middle: energy would drift.
        usual_ = report.evaluations++;
        equations_.evaluate(step);
        return finish(z, h, step, report);
      }
      // What is noise beside the largest entry does not fall by another iteration either.
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

  /// So slow sweeps as the last one come to an end before a matrix of Newton's method would be worth it.
  [[nodiscard]] bool few_more(double change, double before, int at_most) const {
    return change < before && std::log(limit_ / change) > std::min(40, at_most) * std::log(change / before);
  }

  [[gnu::noinline]] StepReport by_newton(State<n>& z, double h) {
    begun_ = 0;
    StageValues<n, w>& step = both_[now_];
    step.start = start_;
    StepReport report = newton_.solve(equations_, step, last_, settings_.max_sweeps);
    if (report.outcome == Outcome::ok) report = finish(z, h, step, report);
    // Now and then sweeps are tried again: a stiff part of the orbit may be over.
    stiff_ = report.outcome == Outcome::ok ? (stiff_ + 1) % 32 : 0;
    usual_ = 1;
    return report;
  }

  /// Newton's method with the matrix of every stage, from the polynomial of the last step.
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
      least = equations_.field().clock(change_, sum(dt)) / h;  // also where time is a coordinate
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
  StageValues<n, w> both_[2];  // this step and the next one
  int now_ = 0;                // which of them is this step
  StageValues<n, w> last_;     // start and increments of the last step; its q and p are Newton's scratch
  Scalar dt_{0.0};             // of the last step
  Scalar last_legendre_{0.0};
  SweepSettings settings_;
  PreciseState<n> end_, start_;  // of the last step, of this one
  Vector<double, n> change_;
  EntryProgress<n, w> progress_;
  NewtonIteration<n, w> newton_;
  int stiff_ = 0;  // steps in a row that took Newton's method
  // The size of an entry in a step may be forty times its smallest value there (Kepler, e = 0.9, eight steps
  // a period). At the level of rounding that makes no difference; at loose tolerances a sixteenth keeps the
  // error of a run near the tolerance.
  double limit_ = settings_.tolerance > 1e-15 ? settings_.tolerance / 16.0 : settings_.tolerance;
  bool newton_failed_ = false;   // at this h, or cannot be tried: only sweeps are left
  double h_ = 0.0, size_ = 0.0;  // of the last step; of the sweeps
  Place place_ = Place::elsewhere;
  int usual_ = 1;                    // sweeps of the last step
  int begun_ = 0;                    // those that the next one has had
  bool scaled_[2] = {false, false};  // the scales of both_ are those of this orbit
};

}  // namespace avi
