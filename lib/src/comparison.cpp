#include "orbiter.hpp"
#include "rounded_formula.hpp"

#include <algorithm>
#include <limits>

/// @file
/// The errors of two runs, as their difference shows them, and the part of them that is rounding.

namespace avi::detail {

/// Finds how far one run lags behind the other at all marks. @param ratio factor by which the error of the
/// finer one is smaller than their distance
Orbiter::Lags Orbiter::lags(const Journey& coarse, const Journey& fine, double ratio) {
  Lags lags;
  const std::size_t marks = std::min(coarse.marks.size(), fine.marks.size());
  const double until = since_start(marks - 1);
  double least = infinity;
  for (std::size_t i = 0; i < marks; ++i) {
    const double whole = (*distance_)(coarse.marks[i], fine.marks[i], fine.ranges), apart = whole / ratio;
    const double speed = std::max(speed_at(fine.marks[i], fine.ranges), 0.03 * usual_speed_);
    const double behind = speed > 0.0 ? apart / speed : apart;
    const double since = since_start(i);
    if (since <= (compared_ > 3 ? 0.251 : 0.376) * until) lags.early = std::max(lags.early, behind);
    if (since <= 0.501 * until) lags.halfway = std::max(lags.halfway, behind);
    lags.late = std::max(lags.late, behind);
    lags.runaway = lags.runaway || lags.late > 10.0 * least * since * since;
    least = std::min(least, lags.late / (since * since));
    lags.furthest = std::max(lags.furthest, whole);
    lags.last = apart;
  }
  return lags;
}

Comparison Orbiter::compare(const Journey& coarse, const Journey& fine) {
  Comparison seen;
  const std::size_t marks = std::min(coarse.marks.size(), fine.marks.size());
  // Energy errors above rounding show how fast errors fall with the step: slower than by the order if steps
  // do not resolve all of the way.
  const bool seen_to_fall =
      fine.energy_error > std::max(1e3 * answer_.energy_rounding, energy_left_by_sweeps(fine));
  const double falls = seen_to_fall ? std::max(1.0, 0.5 * coarse.energy_error / fine.energy_error) : infinity;
  const double ratio = features_->bends() || coarse_grained_ ? 1.0 : std::min(trusted(coarse, fine), falls),
               until = since_start(marks - 1);
  auto [early, halfway, late, furthest, last, runaway] = lags(coarse, fine, ratio);
  seen.furthest = furthest;
  seen.error = last;
  // No order reduces what the sweeps left.
  const double left = left_by_sweeps(fine);
  seen.error = std::max(seen.error, std::min(left, ratio * seen.error));
  const double lag = lag_at_saddles(fine, 0.0);
  late = std::max(late, lag);
  seen.error =
      std::max(seen.error, lag * std::max(speed_at(fine.marks[marks - 1], fine.ranges), 0.03 * usual_speed_));
  // If the lag grew by a power of time, its factor from a half to the whole would be that from a quarter to a
  // half. Rounding, which may be small by chance at first, is not taken for exponential growth.
  seen.exponential = furthest > 1e-7 && std::log(late / halfway) > 1.4 * std::log(halfway / early);
  // Where orbits diverge, all errors come to lie in one direction, in which the two runs may be close by
  // chance: about once in k times, errors are k times as large as the difference of the runs, whatever the
  // order. Once errors are no longer small, runs may meet anywhere. Of 6000 orbits of Henon and Heiles near
  // escape, over 30 to 100 turns at tolerances 1e-2 to 1e-6, 24 of 3075 that counted as kept were wrong by
  // more than ten tolerances; with these rules, 3 of 2872. A prediction from a mark on the way is doubted
  // less, as it has yet to come true.
  constexpr double by_chance = 3.0, few_times = 4.0;
  if (runaway && furthest > 0.01)
    seen.error = std::max(furthest, 1.0), late *= ratio;
  else if (furthest > 0.1)
    seen.error = furthest, late *= ratio;
  else if (runaway)
    seen.error *= by_chance * ratio, late *= std::max(1.0, ratio / few_times);
  // Runs of few steps may err alike. The error of the action, and with it that of the end, is of second order
  // in what the curve lacks, which is about the last term of its polynomial. Measured errors are 1 to 20
  // times the square of that term.
  if (fine.run.steps <= Journey::few && fine.tails.size() > 0) {
    const double lacking = distance_->speed(fine.tails, distance_->scales(fine.ranges));
    const double speed = std::max(speed_at(fine.state, fine.ranges), 0.03 * usual_speed_);
    seen.error = std::max(seen.error, lacking * lacking);
    late = std::max(late, speed > 0.0 ? lacking * lacking / speed : lacking * lacking);
  }
  // Orbits that leave a point of rest at different times may come to another one, where they are close again;
  // and the delay does not depend on the order.
  const double parted = parted_by(coarse.pauses, fine.pauses, question_.t, marks_[marks - 1]);
  lost_ = parted > 1.0 || (fine.pauses.undecided && !question_.timed);
  if (lost_)
    seen.error = std::max(seen.error, 1.0), late = std::max(late, 1.0 / usual_speed_), unstable_ = true;
  else if (parted > 0.3)
    seen.error *= ratio, late *= ratio;
  seen.behind = late;
  // The growth of rounding says nothing about the growth of errors.
  const double rounding = (100.0 * std::numeric_limits<double>::epsilon() + 10.0 * fine.candidate->noise) *
                          distance_->frequency * until;
  // Over fewer turns, errors fluctuate by more than they grow.
  const bool seen_long = distance_->frequency * until > shortest_growth || late > 1e3 * early;
  // What the sweeps leave grows with the square of time, which says nothing about errors either.
  const bool grows = late > 20.0 * early && (furthest > 10.0 * left || late > 1e3 * early);
  if (early > 0.0 && grows) {
    if (seen_long && late * usual_speed_ * ratio > rounding) {
      seen.growth = std::min(3.0, std::log(late / early) / std::log(4.0));
      if (late > 60.0 * early) seen.rate = std::log(late / early) / (0.75 * until);
    }
    // An error that grows so much may have begun as what the sweeps left, or as rounding, which no order
    // reduces.
    unstable_ = true;
    const double doubted = std::min(ratio, late / (20.0 * early));
    if (!seen_to_fall) seen.error *= doubted, seen.behind *= doubted;
  }
  // Output times and events may be where the motion is fast.
  if (!question_.times.empty() || !question_.events.empty() || question_.options.dense)
    seen.error = std::max(seen.error, seen.behind * high_speed_);
  return seen;
}

/// Returns the time by which a run may be late because of saddles: the energy that is left at a saddle
/// decides how long the motion stays near it. With several degrees of freedom, of which time may be one, a
/// pause may have other reasons, as in a motion that a clock drives with a small amplitude, so 0 is returned.
/// @param unseen see Pauses
double Orbiter::lag_at_saddles(const Journey& journey, double unseen) const {
  return field_.size() == 1 ? journey.pauses.lag(unseen) : 0.0;
}

double Orbiter::speed_at(const State<dynamic>& z, const Ranges& ranges) {
  VectorX slope(2 * z.q.size());
  field_(z, slope);
  return (*distance_)(slope, ranges);
}

/// Returns how far rounding of time moves a state along the orbit. A clock that begins at zero has as many
/// digits as the phase.
double Orbiter::rounding_of_clock(const Journey& journey) {
  if (question_.t == 0.0) return 0.0;
  return 0.5 * std::numeric_limits<double>::epsilon() * std::abs(question_.t) *
         speed_at(journey.state, journey.ranges);
}

/// Returns the rounding error of H in the unit of energy errors: the largest value found where the energy of
/// a run errs most, at the marks of the run, and on the sketch.
double Orbiter::rounding_of_energy(const Journey& journey) {
  RoundedFormula h(question_.graph, question_.energy);
  double most = h.rounding(stacked(journey.worst));
  for (const State<dynamic>& mark : journey.marks)
    most = std::max(most, h.rounding(stacked(mark)));
  for (const Sketch::Sample& sample : sketch_->samples)
    most = std::max(most, h.rounding(sample.z));
  return most / trip_->energy_scale;
}

/// Returns true if the energy errs most where the monitor is small, and by no more than rounding explains.
/// The method preserves g (H - H_0), so the error is that much smaller where g is large again.
bool Orbiter::passes(const Journey& journey) const {
  Candidate& it = *journey.candidate;
  double usual = it.rate_at(journey.state);
  for (const State<dynamic>& mark : journey.marks)
    usual = std::max(usual, it.rate_at(mark));
  return journey.energy_error * it.rate_at(journey.worst) < 1e3 * trip_->rounding * usual;
}

/// Returns true if the gradient that H supplies differs from that of its formula by more than rounding.
bool Orbiter::follows_another_gradient() {
  if (foreign_gradient_ || question_.gradient.empty()) return foreign_gradient_.value_or(false);
  const int n = field_.size();
  RecordedFormula<double> formula{Recording(question_.graph, question_.energy).gradient()};
  VectorX apart = VectorX::Zero(2 * n), size = apart;
  for (const Sketch::Sample& sample : sketch_->samples) {
    formula.run(sample.z.data(), sample.z.data() + n, n);
    for (int i = 0; i < 2 * n; ++i) {
      const double own = i < n ? sense_ * formula.partial(n + i) : -sense_ * formula.partial(i - n);
      apart[i] = std::max(apart[i], std::abs(sample.slope[i] - own));
      size[i] = std::max(size[i], std::abs(own));
    }
  }
  constexpr double rounding = 3e-12;
  return *(foreign_gradient_ = (apart.array() > rounding * size.array()).any());
}

/// Predicts the error at the time `to` after the start from a comparison of runs up to `from`.
double Orbiter::foretold(const Comparison& seen, double from, double to, double speed) const {
  if (!(to > from)) return seen.error;
  const double behind =
      seen.behind * (seen.rate > 0.0 ? std::exp(seen.rate * (to - from)) : std::pow(to / from, seen.growth));
  return behind * std::max(speed, 0.03 * usual_speed_);
}

}  // namespace avi::detail
