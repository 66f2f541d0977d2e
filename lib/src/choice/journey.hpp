#pragma once
#include "avi/core/integrate_to.hpp"
#include "avi/integrators/runge_kutta.hpp"
#include "src/choice/budget.hpp"
#include "src/choice/candidates.hpp"
#include "src/choice/pauses.hpp"
#include "src/features/near_passes.hpp"
#include "src/features/sharp.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

/// @file
/// Runs of a candidate along an orbit, made piece by piece.

namespace avi::detail {

/// The data that all runs along an orbit share.
struct Trip {
  State<dynamic> start;    ///< State at the start.
  double energy_at_start;  ///< Energy at the start, H_0.
  double energy_scale;     ///< Unit of energy errors.
  double sense;            ///< Direction of time: 1, or -1 where the end lies before the start.
  Budget& budget;          ///< Budget of the call.
  double rounding = 0.0;   ///< Rounding error of one evaluation of H, in that unit.
  double kick = infinity;  ///< Change of an entry, relative to its range, that shows at the end.
  double felt = infinity;  ///< Change of H inside a step that is too large to be its error.
  double span = infinity;  ///< Time from the start to the end.
  VectorX ranges = VectorX::Zero(2 * start.q.size());  ///< Ranges of (q, p) on the sketch.
  Eigen::Index seen = start.q.size();                  ///< Number of coordinates, without time.
  SharpFeatures* features = nullptr;                   ///< Features to look for, if there are any.
  NearPasses* passes = nullptr;                        ///< Passes by light bodies to look for, if any.
  VectorX inverse_masses = {};                         ///< The diagonal D where q' = D p; else empty.

  /// Whether time is a coordinate, the last one.
  [[nodiscard]] bool timed() const { return seen < start.q.size(); }
};

/// The smallest and largest value of every entry of (q, p) on the way.
struct Ranges {
  VectorX low, high;  ///< Bounds of 2n entries each.

  /// Ranges of a single state.
  explicit Ranges(const State<dynamic>& z) : low(stacked(z)), high(low) {}
  /// Takes in another state.
  void add(const State<dynamic>& z) { add(z.q.data(), z.p.data()); }
  /// Takes in another state of n entries each.
  void add(const double* q, const double* p) {
    const Eigen::Index n = low.size() / 2;
    for (Eigen::Index i = 0; i < n; ++i) {
      low[i] = std::min(low[i], q[i]), high[i] = std::max(high[i], q[i]);
      low[n + i] = std::min(low[n + i], p[i]), high[n + i] = std::max(high[n + i], p[i]);
    }
  }
};

/// The part of a step at which its polynomial has the time t. The step began at `before`, and was the last
/// one of `method`. @param after time at its end
inline double part_at(const OrbitSteps& method, Candidate& candidate, const State<dynamic>& before, double h,
                      double after, double t) {
  double part = (t - before.t) / (after - before.t);
  if (candidate.fixed()) return part;
  VectorX z(2 * before.q.size());
  double its_time = 0.0;
  for (int k = 0; k < 6; ++k) {
    method.polynomial(part, z, its_time);
    const double next = part + (t - its_time) / (h * candidate.rate_at(z.data()));
    if (!(next > 0.0 && next < 1.0)) break;
    const bool near = std::abs(next - part) <= 1e-4;  // then its error is far smaller than this change
    part = next;
    if (near) break;
  }
  return part;
}

/// Finds the state at the time t in a step that passes t, began at `before` and was the last one of `method`.
/// The method makes shorter steps from `before`: the first of the size at which its polynomial has the time
/// t, the others of sizes by Newton's method for dt/dtau = g. An explicit step of order 3 covers the last
/// millionth of the step; its error is far below rounding. Where q is far from zero, rounding may keep a step
/// of one size from being solved; it is made in pieces then. @param its_size gets the size of the last step
/// of the method @return report of these steps
inline StepReport land(OrbitSteps& method, Candidate& candidate, PointField& field,
                       const State<dynamic>& before, double h, double after, double t, State<dynamic>& z,
                       double* its_size = nullptr) {
  StepReport report{.evaluations = 0};
  double size = h * part_at(method, candidate, before, h, after, t);
  if (its_size) *its_size = size;
  z = before;
  double low = 0.0, high = 1.0;  // parts of h between which the time is t
  for (int k = 0; k < 60 && size != 0.0; ++k) {
    for (int pieces = 1; pieces <= 4; ++pieces) {
      z = before;
      report.outcome = Outcome::ok;
      for (int piece = 0; piece < pieces && report.ok(); ++piece) {
        const StepReport step = method.step_inside(z, size / pieces);
        report.outcome = step.outcome;
        report.evaluations += step.evaluations;
      }
      if (report.outcome != Outcome::not_converged) break;
    }
    if (!report.ok()) return report;
    if (its_size) *its_size = size;
    if (std::abs(t - z.t) <= 1e-6 * std::abs(after - before.t)) break;
    ((z.t - t) * (after - before.t) > 0.0 ? high : low) = size / h;
    const double next = (size + (t - z.t) / candidate.rate_at(z)) / h;
    size = h * (next > low && next < high ? next : 0.5 * (low + high));
  }
  const double late = t - z.t;
  if (!(std::abs(late) <= 1e-6 * std::abs(after - before.t))) report.outcome = Outcome::not_converged;
  if (late != 0.0) {
    const Eigen::Index n = z.q.size();
    const VectorX from = stacked(z);
    RungeKuttaStages<BogackiShampine> last(2 * n);
    field(from, last.k[0]);
    last.advance(field, from, late);
    z.q = last.end.head(n);
    z.p = last.end.tail(n);
  }
  z.t = t;
  if (!z.finite()) report.outcome = Outcome::non_finite;
  return report;
}

/// A run that is made piece by piece, and what was seen on it.
class Journey {
 public:
  /// Begins a run at the start of the trip, with the fictive step h > 0.
  Journey(Trip& trip, PointField& field, Candidate& its_candidate, int its_order, double step,
          SweepSettings sweeps)
      : candidate(&its_candidate), order(its_order), h(step), solved(sweeps.tolerance), state(trip.start),
        ranges(trip.start), pauses(trip.ranges, trip.seen), worst(trip.start), trip_(&trip), field_(&field),
        steps_(its_candidate.steps(its_order, sweeps)), z_(trip.start), before_(trip.start) {}

  Candidate* candidate;               ///< Monitor of the run.
  int order;                          ///< Order of its method.
  double h;                           ///< Fictive step, positive.
  double solved;                      ///< Tolerance of its sweeps, see Choice.
  double most = infinity;             ///< Largest number of sweeps that it may take.
  Run run;                            ///< Its steps and sweeps so far, and how it ended, or ok.
  State<dynamic> state;               ///< State at the last mark, or the last good state.
  std::vector<State<dynamic>> marks;  ///< States at the marks that it has reached.
  Ranges ranges;                      ///< Ranges of all its states.
  Pauses pauses;                      ///< Pauses, in which it all but stops.
  double energy_error = 0.0;          ///< Largest |H - H_0|, over the scale,
  State<dynamic> worst;               ///< and the state with that error.
  double work = 0.0;                  ///< Integral of half of |p q'| over time, where H depends on time.
  VectorX tails;                      ///< Largest tail of each entry, see Stepper, in the first `few` steps.
  bool spent = false;                 ///< Whether it met a bound of the call.
  bool jumped = false;   ///< Whether a step passed over a feature of H, or erred between kinks, unseen.
  bool crossed = false;  ///< Whether it ended with a step over a place where H is infinite.
  bool coarse = false;   ///< Whether a finer run is compared with it, in which near passes are looked for.
  long whole = 0;        ///< Number of steps of the full size.
  double gone = 0.0;     ///< Sum of the fictive sizes of all steps.

  static constexpr int few = 12;  ///< Number of steps that counts as few.

  /// Returns true if the run has not failed.
  [[nodiscard]] bool ok() const { return run.outcome == Outcome::ok; }

  /// Goes on together with another run of the same candidate, as long as both are before the time `mark`: two
  /// for the price of one, if the method can do that. Each run has the same bits as on its own.
  void go_beside(Journey& other, double mark) {
    if (!steps_->can_go_beside()) return;
    const double sense = trip_->sense;
    const auto goes = [&](const Journey& it) { return it.ok() && sense * (it.z_.t - mark) < 0.0; };
    while (goes(*this) && goes(other)) {
      before_ = z_, other.before_ = other.z_;
      const auto [mine, its] = steps_->step_beside(z_, sense * h, *other.steps_, other.z_, sense * other.h);
      made(mine);
      other.made(its);
    }
    if (!ok()) state = before_;
    if (!other.ok()) other.state = other.before_;
  }

  /// Goes on to the time `mark`, with a shorter step from the last state before it. @param last whether the
  /// run ends there
  void advance(double mark, bool last) {
    const double sense = trip_->sense;
    while (ok() && sense * (z_.t - mark) < 0.0)
      step();
    if (!ok()) {
      state = before_;
      return;
    }
    if (z_.t == mark) {
      state = z_;
    } else {
      // Marks on the way leave no trace in the run itself.
      std::unique_ptr<OrbitSteps> aside;
      if (!last) aside = steps_->clone();
      const StepReport landed =
          land(last ? *steps_ : *aside, *candidate, *field_, before_, steps_->size(), z_.t, mark, state);
      spend(landed);
      if (!ok()) {
        state = before_;
        return;
      }
      if (last) {
        ranges.add(state);
        if (!steps_->is_at_switch(state.t)) look_at_energy(state);
      }
    }
    marks.push_back(state);
  }

 private:
  void spend(const StepReport& report) {
    run.outcome = report.outcome;
    run.evaluations += report.evaluations;
    trip_->budget.sweeps += report.evaluations;
  }
  /// Takes in the energy of a state. @return its error, over the scale
  double look_at_energy(const State<dynamic>& z) {
    const double energy = field_->energy(z.q.data(), z.p.data());
    if (std::isnan(energy)) run.outcome = Outcome::non_finite;
    const double error = std::abs(energy - trip_->energy_at_start) / trip_->energy_scale;
    if (error > energy_error) energy_error = error, worst = z;
    return error;
  }
  void look_at_work() {
    find_slope(z_);
    const Eigen::Index seen = trip_->seen;
    work += 0.5 * std::abs(z_.t - before_.t) * std::abs(dot(z_.p.head(seen), slope_.head(seen)));
  }
  /// Returns true if the second half of very many steps has advanced time by less than a millionth of the
  /// way, as before a singularity.
  bool hardly_moves() {
    const auto steps = static_cast<unsigned long>(run.steps + 1);
    if (!std::has_single_bit(steps)) return false;
    const double way = std::abs(z_.t - trip_->start.t), latter = way - std::exchange(half_way_, way);
    return steps > 100'000 && latter < 1e-6 * way;
  }
  void look_at_tail() {
    if (tails.size() == 0) tails = VectorX::Zero(ranges.low.size()), tail_ = tails;
    steps_->tail(tail_);
    tails = tails.cwiseMax(tail_);
  }
  void step() {
    before_ = z_;
    made(steps_->step(z_, trip_->sense * h));
  }
  /// Sets slope_ to dz/dt.
  void find_slope(const State<dynamic>& z) {
    slope_.resize(2 * z.q.size());
    (*field_)(z, slope_);
  }
  /// Checks whether the last step misses the kick of a body.
  void look_for_passes() {
    NearPasses& passes = *trip_->passes;
    const auto look = [&](const State<dynamic>& z) {
      if (trip_->inverse_masses.size() == 0) {
        find_slope(z);
      } else {
        slope_.setZero(2 * z.q.size());
        slope_.head(z.q.size()) = trip_->inverse_masses.cwiseProduct(z.p);
      }
      passes.look(*candidate, steps_->size(), z, slope_, now_);
    };
    if (run.steps == 1) look(before_);
    std::swap(last_, now_);
    look(z_);
    jumped = jumped || passes.unseen(*steps_, order, std::abs(z_.t - before_.t), last_, now_);
  }
  /// Returns true if something inside the last step is not seen by its stages.
  bool passes_over() {
    const auto felt = [&](const State<dynamic>& z) {
      return !(std::abs(field_->energy(z.q.data(), z.p.data()) - trip_->energy_at_start) <= trip_->felt);
    };
    if (!trip_->features) return false;
    if (trip_->features->jumped(*steps_, before_, z_, felt)) return true;
    if (!trip_->features->hides()) return false;
    // Where no force acts, steps are long, and a force may act only between their stages.
    if ((z_.p - before_.p).cwiseAbs().maxCoeff() > 1e-6 * z_.p.cwiseAbs().maxCoeff()) return false;
    const auto points =
        static_cast<int>(std::min(looks * std::abs(z_.t - before_.t) / trip_->span, looks / 4.0));
    for (int k = 1; k < points; ++k)
      if (felt(steps_->polynomial(static_cast<double>(k) / points))) return true;
    return false;
  }
  /// Measures the error of a step from one kink to the next, which is the same in all runs, so that comparing
  /// them does not show it: by the same step in two halves. @return true if the sum of such errors may show
  /// at the end
  bool errs_between_kinks() {
    const auto halves = steps_->clone();
    State<dynamic> z = before_;
    for (int k = 0; k < 2; ++k) {
      const StepReport half = halves->step_inside(z, 0.5 * steps_->size());
      run.evaluations += half.evaluations;
      trip_->budget.sweeps += half.evaluations;
      if (!half.ok()) return true;
    }
    find_slope(z_);
    const Eigen::Index n = z_.q.size();
    double apart = 0.0;
    for (Eigen::Index i = 0; i < trip_->seen; ++i) {
      const double late = z_.t - z.t;  // with a monitor
      const double q = z_.q[i] - z.q[i] - late * slope_[i], p = z_.p[i] - z.p[i] - late * slope_[n + i];
      const double of_q = std::max(ranges.high[i], z_.q[i]) - std::min(ranges.low[i], z_.q[i]),
                   of_p = std::max(ranges.high[n + i], z_.p[i]) - std::min(ranges.low[n + i], z_.p[i]);
      if (of_q > 0.0) apart = std::max(apart, std::abs(q) / of_q);
      if (of_p > 0.0) apart = std::max(apart, std::abs(p) / of_p);
    }
    if (apart > 1e-14) unseen_ += apart;
    return unseen_ > trip_->kick;
  }
  /// Returns true if the last step went over a place where H is infinite.
  bool crosses() {
    from_.resize(2 * z_.q.size()), to_.resize(2 * z_.q.size());
    from_ << before_.q, before_.p;
    to_ << z_.q, z_.p;
    return field_->crosses(from_, to_);
  }
  /// Takes in a step that was made: counts it, and checks it.
  void made(const StepReport& report) {
    const double sense = trip_->sense;
    spend(report);
    if (ok() && !z_.finite()) run.outcome = Outcome::non_finite;
    if (ok() && (!(sense * (z_.t - before_.t) > 0.0) || hardly_moves())) run.outcome = Outcome::stalled;
    if (ok() && field_->barriers && crosses()) run.outcome = Outcome::not_converged, crossed = true;
    if (!ok()) return;
    const bool between = std::exchange(at_kink_, steps_->ended_at_kink()) && at_kink_;
    if (!jumped) jumped = passes_over() || (between && errs_between_kinks());
    ++run.steps;
    const double size = std::abs(steps_->size());
    gone += size;
    if (size == h) ++whole;
    if (run.steps <= few) look_at_tail();
    ranges.add(z_);
    const bool closely = trip_->passes && !coarse;
    const double error = look_at_energy(z_);
    if (closely) look_for_passes();
    if (trip_->timed()) look_at_work();
    pauses.add(before_, z_, ranges.low, ranges.high, error > 10.0 * trip_->rounding ? error : 0.0,
               [&]() -> const VectorX& {
                 find_slope(z_);
                 return slope_;
               });
    if (!ok()) return;
    if (const Outcome bound = trip_->budget.met(z_.t, run.steps, 0); bound != Outcome::ok) {
      run.outcome = bound;
      spent = true;
    } else if (static_cast<double>(run.evaluations) > most) {
      run.outcome = Outcome::stopped;
    }
    if (!ok()) before_ = z_;
  }

  static constexpr double looks = 1000.0;  // number of looks at H in a run without forces

  Trip* trip_;
  PointField* field_;
  std::unique_ptr<OrbitSteps> steps_;
  bool at_kink_ = false;              // the last step ended at a kink
  double unseen_ = 0.0;               // sum of the errors of steps between kinks
  double half_way_ = 0.0;             // time covered when the number of steps last was a power of two
  State<dynamic> z_, before_;         // after the last whole step, and before it
  VectorX tail_, slope_, from_, to_;  // scratch
  NearPasses::Distances last_, now_;
};

}  // namespace avi::detail
