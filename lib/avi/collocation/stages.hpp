#pragma once
#include "avi/autodiff/pack.hpp"
#include "avi/collocation/gauss_rule.hpp"
#include "avi/collocation/lane_matrix.hpp"
#include "avi/collocation/stage_field.hpp"
#include "avi/core/outcome.hpp"
#include "avi/core/state.hpp"
#include "avi/core/summation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

/// @file
/// The stages of a collocation step side by side, and the sweeps that solve for them.

namespace avi {

/// When a step counts as solved.
struct SweepSettings {
  double tolerance = 1e-16;  ///< Relative change that one more sweep would make; the default is round-off.
  int max_sweeps = 100;      ///< After so many a step ends as Outcome::not_converged.
};

/// A Gauss collocation step with at most w stages, held in the lanes of packs. Lanes beyond the last stage
/// repeat that stage with weight zero, so the formula is never evaluated at an arbitrary point.
///
/// With \f$L_j = h b_j f(z_j)\f$ the stages are \f$z_i = z_0 + \sum_j \mu_{ij} L_j\f$ and the step ends at
/// \f$z_0 + \sum_j L_j\f$. A sweep computes all forces and with them new momenta, then with these all
/// velocities and new positions.
template <class Problem, int w>
class alignas(64) Stages {
 public:
  static constexpr int n = Problem::dimension;  ///< Dimension of the problem, or avi::dynamic.
  using Scalar = Pack<w>;                       ///< One number for each stage.
  using Vec = Vector<Scalar, n>;                ///< One vector for each stage.

  /// For this problem and rule of at most w stages.
  Stages(const Problem& problem, const GaussRule& rule, SweepSettings settings)
      : dq_(problem.size()), dp_(problem.size()), old_q_(problem.size()), old_p_(problem.size()), rule_(rule),
        settings_(settings), field_(problem), begin_(problem.size()), end_(problem.size()),
        start_(problem.size()), change_(problem.size()), work_(problem.size()) {
    dq_.setConstant(Scalar(0.0)), dp_.setConstant(Scalar(0.0)), change_.setZero();
    for (int j = 0; j < rule.stages(); ++j) {
      weight_.set(j, rule.weight(j));
      for (int i = 0; i < w; ++i)
        mu_.set(i, j, rule.mu(std::min(i, rule.stages() - 1), j));
    }
  }

  /// Advances z by h; leaves z unchanged unless the step ends as ok.
  StepReport step(const Problem& problem, State<n>& z, double h) {
    start_at(z);
    StepReport report = attempt(problem, z, h);
    if (report.outcome != Outcome::ok && place_ != Place::elsewhere) {
      // The polynomial of the last step may have been a bad guess.
      const int sweeps = report.evaluations;
      place_ = Place::elsewhere;
      report = attempt(problem, z, h);
      report.evaluations += sweeps;
    }
    return report;
  }

  /// The collocation polynomial of the last step at its fraction c.
  [[nodiscard]] State<n> polynomial(const Problem& problem, double c) const {
    const GaussRule::Row row = rule_.integrals(c);
    Scalar part(0.0);
    for (int j = 0; j < rule_.stages(); ++j)
      part.set(j, row[j]);
    const auto at = [&](const Scalar& increments) { return sum(Scalar(part * increments)); };
    State<n> z = begin_.state;
    for (Eigen::Index i = 0; i < z.q.size(); ++i) {
      z.q[i] += at(dq_[i]);
      z.p[i] += at(dp_[i]);
    }
    z.t = problem.clock(z.q, z.t + at(dt_));
    return z;
  }

 private:
  enum class Place { elsewhere, begin, end };

  static State<n> zero(Eigen::Index size) {
    return {.q = Vector<double, n>::Zero(size), .p = Vector<double, n>::Zero(size)};
  }
  /// A state and the rounding error that is to be added to it.
  struct Point {
    State<n> state, low;
    explicit Point(Eigen::Index size) : state(zero(size)), low(zero(size)) {}
  };
  struct Nothing {
    explicit Nothing(Eigen::Index) {}
  };
  struct Work {  // unknowns of a step and their increments L
    alignas(64) Vec q, p, dq, dp;
    explicit Work(Eigen::Index size) : q(size), p(size), dq(size), dp(size) {}
  };

  static bool same(const State<n>& a, const State<n>& b) { return a.t == b.t && a.q == b.q && a.p == b.p; }

  /// The start of a step at z, with the rounding error of the last step if that led to z.
  void start_at(const State<n>& z) {
    place_ = h_ == 0.0               ? Place::elsewhere
             : same(z, end_.state)   ? Place::end
             : same(z, begin_.state) ? Place::begin
                                     : Place::elsewhere;
    if (place_ == Place::elsewhere) {
      start_.low.q.setZero();
      start_.low.p.setZero();
      start_.low.t = 0.0;
    } else {
      start_.low = (place_ == Place::end ? end_ : begin_).low;
    }
    start_.state = z;
  }

  /// Starting values: the polynomial of the last step, extrapolated or on a part of the step.
  [[gnu::always_inline]] void guess(Work& work, double h) {
    const State<n>& z = start_.state;
    const double offset = place_ == Place::end ? 1.0 : 0.0, ratio = h / h_;
    if (place_ == Place::elsewhere || !(std::abs(ratio) <= 2.0)) {
      for (Eigen::Index i = 0; i < z.q.size(); ++i) {
        work.q[i] = Scalar(z.q[i]);
        work.p[i] = Scalar(z.p[i]);
      }
      return;
    }
    if (offset != guess_offset_ || ratio != guess_ratio_) prepare_guess(offset, ratio);
    for (Eigen::Index i = 0; i < z.q.size(); ++i) {
      work.q[i] = Scalar(z.q[i]) + guess_ * dq_[i];
      work.p[i] = Scalar(z.p[i]) + guess_ * dp_[i];
    }
  }
  [[gnu::noinline]] void prepare_guess(double offset, double ratio) {
    guess_offset_ = offset;
    guess_ratio_ = ratio;
    const GaussRule::Row start = rule_.integrals(offset);
    for (int i = 0; i < w; ++i) {
      const GaussRule::Row row =
          rule_.integrals(offset + ratio * rule_.node(std::min(i, rule_.stages() - 1)));
      for (int j = 0; j < w; ++j)
        guess_.set(i, j, row[j] - start[j]);
    }
  }

  StepReport attempt(const Problem& problem, State<n>& z, double h) {
    if constexpr (n == dynamic) {
      return solve(problem, z, h, work_);
    } else {
      Work work(n);  // on the stack, where the compiler keeps it in registers
      return solve(problem, z, h, work);
    }
  }

  [[gnu::always_inline]] StepReport solve(const Problem& problem, State<n>& z, double h, Work& work) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    StepReport report{.evaluations = 0};
    guess(work, h);
    const Scalar weight = Scalar(h) * weight_;
    double before = 0.0, least = std::numeric_limits<double>::infinity();
    int stalls = 0;
    const int first_look = place_ == Place::elsewhere ? 1 : first_look_;
    for (int k = 1; k <= settings_.max_sweeps; ++k) {
      ++report.evaluations;
      const bool look = k >= first_look;
      if (look) old_q_ = work.q, old_p_ = work.p;
      sweep(problem, z, weight, work);
      if (!look) continue;
      const double change = largest(max(change_of(work.q, old_q_), change_of(work.p, old_p_)));
      report.residual = change;
      if (!std::isfinite(change)) {
        report.outcome = Outcome::non_finite;
        return report;
      }
      // The changes fall by change / before each time. At the level of rounding they stop falling.
      const bool solved = change * (change / before) <= settings_.tolerance;
      stalls = change >= least ? stalls + 1 : 0;
      const bool stagnates = (change >= 0.5 * before && before > 0.0 && change <= 16.0 * epsilon) ||
                             (stalls >= 2 && change <= 1e5 * epsilon);
      if (change == 0.0 || solved || stagnates) return finish(problem, z, h, work, report);
      before = change;
      least = std::min(least, change);
    }
    report.outcome = Outcome::not_converged;
    return report;
  }

  /// One sweep. Flattened, so that a formula is worked off in registers, whatever it is made of and whatever
  /// else the program holds.
  [[gnu::flatten, gnu::noinline]] void sweep(const Problem& problem, const State<n>& z, const Scalar& weight,
                                             Work& work) {
    const Eigen::Index size = z.q.size();
    field_.force(problem, work.q, work.p, weight, work.dp);
    for (Eigen::Index i = 0; i < size; ++i)
      work.p[i] = Scalar(z.p[i]) + mu_.times(work.dp[i], Scalar(start_.low.p[i]));
    field_.velocity(problem, work.q, work.p, weight, work.dq);
    for (Eigen::Index i = 0; i < size; ++i)
      work.q[i] = Scalar(z.q[i]) + mu_.times(work.dq[i], Scalar(start_.low.q[i]));
  }

  /// Largest change of a vector at each stage, relative to its largest entry there.
  static Scalar change_of(const Vec& now, const Vec& before) {
    Scalar change(0.0), most(std::numeric_limits<double>::min());
    for (Eigen::Index i = 0; i < now.size(); ++i) {
      change = max(change, abs(now[i] - before[i]));
      most = max(most, abs(now[i]));
    }
    return change / most;
  }

  [[gnu::always_inline]] StepReport finish(const Problem& problem, State<n>& z, double h, Work& work,
                                           StepReport report) {
    const Scalar rate = field_.rate(), dt = rate * (Scalar(h) * weight_);
    for (Eigen::Index i = 0; i < z.q.size(); ++i)
      change_[i] = sum(work.dq[i]);
    double least = problem.clock(change_, sum(dt)) / h;  // also where time is a coordinate
    for (int i = 0; i < rule_.stages(); ++i)
      least = !(rate[i] >= least) ? rate[i] : least;
    if (!(least > 0.0)) {
      report.outcome = least <= 0.0 ? Outcome::bad_monitor : Outcome::non_finite;
      return report;
    }
    begin_ = start_;
    end_ = start_;
    for (Eigen::Index i = 0; i < z.q.size(); ++i) {
      add(end_.state.q[i], end_.low.q[i], change_[i]);
      add(end_.state.p[i], end_.low.p[i], sum(work.dp[i]));
    }
    add(end_.state.t, end_.low.t, sum(dt));
    end_.state.t = problem.clock(end_.state.q, end_.state.t);
    z = end_.state;
    dq_.swap(work.dq);
    dp_.swap(work.dp);
    dt_ = dt;
    h_ = h;
    first_look_ = std::max(1, report.evaluations - 2);
    return report;
  }

  LaneMatrix<w> mu_, guess_;
  alignas(64) Scalar weight_{0.0};
  alignas(64) Vec dq_, dp_;        // of the last step
  alignas(64) Vec old_q_, old_p_;  // before the last sweep
  Scalar dt_{0.0};
  GaussRule rule_;
  SweepSettings settings_;
  StageField<Problem, w> field_;
  Point begin_, end_, start_;
  Vector<double, n> change_;
  std::conditional_t<n == dynamic, Work, Nothing> work_;  // allocated once
  double h_ = 0.0, guess_offset_ = -1.0, guess_ratio_ = 0.0;
  Place place_ = Place::elsewhere;
  int first_look_ = 1;
};

}  // namespace avi
