#include "src/autodiff/rounded_formula.hpp"
#include "src/choice/orbiter.hpp"

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
    const double whole = (*known_.distance)(coarse.marks[i], fine.marks[i], fine.ranges),
                 apart = whole / ratio;
    const double speed = std::max(speed_at(fine.marks[i], fine.ranges), 0.03 * known_.usual_speed);
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

/// Two runs that are compared: what their difference says at first, and what is known to make errors larger
/// than that.
struct Orbiter::TwoRuns {
  Orbiter& orbiter;
  const Journey &coarse, &fine;
  std::size_t marks = std::min(coarse.marks.size(), fine.marks.size());
  double until = orbiter.since_start(marks - 1);
  bool seen_to_fall = false;  // whether energy errors above rounding show how fast errors fall with the step
  double ratio = 1.0;         // factor by which the error of the finer run is smaller than the difference
  double left = 0.0;          // error of the state that the sweeps left
  Lags lag{};
  Comparison seen{};

  Comparison compare() {
    trust();
    lag = orbiter.lags(coarse, fine, ratio);
    seen.furthest = lag.furthest;
    seen.error = lag.last;
    // No order reduces what the sweeps left.
    seen.error = std::max(seen.error, std::min(left, ratio * seen.error));
    raise_to_lag(orbiter.lag_at_saddles(fine, 0.0), fine.marks[marks - 1]);
    // If the lag grew by a power of time, its factor from a half to the whole would be that from a quarter to
    // a half. Rounding, which may be small by chance at first, is not taken for exponential growth.
    seen.exponential =
        lag.furthest > 1e-7 && std::log(lag.late / lag.halfway) > 1.4 * std::log(lag.halfway / lag.early);
    doubt_meeting();
    if (fine.run.steps <= Journey::few && fine.tails.size() > 0) add_what_few_steps_lack();
    doubt_pauses();
    seen.behind = lag.late;
    find_growth();
    // Output times and events may be where the motion is fast.
    const OrbitQuestion& question = orbiter.question_;
    if (!question.times.empty() || !question.events.empty() || question.options.dense)
      seen.error = std::max(seen.error, seen.behind * orbiter.known_.high_speed);
    return seen;
  }

 private:
  [[nodiscard]] double speed_at(const State<dynamic>& z) const {
    return std::max(orbiter.speed_at(z, fine.ranges), 0.03 * orbiter.known_.usual_speed);
  }

  /// Finds the factor between the two errors. They fall slower than by the order if steps do not resolve all
  /// of the way.
  void trust() {
    seen_to_fall =
        fine.energy_error > std::max(1e3 * orbiter.answer_.energy_rounding, energy_left_by_sweeps(fine));
    const double falls =
        seen_to_fall ? std::max(1.0, 0.5 * coarse.energy_error / fine.energy_error) : infinity;
    if (!orbiter.known_.features->has_kinks() && !orbiter.coarse_grained_)
      ratio = std::min(trusted(coarse, fine), falls);
    left = left_by_sweeps(fine);
  }

  /// Takes in that a run may be late by this time, at a state.
  void raise_to_lag(double late, const State<dynamic>& at) {
    lag.late = std::max(lag.late, late);
    seen.error = std::max(seen.error, late * speed_at(at));
  }

  /// Where orbits diverge, all errors come to lie in one direction, in which the two runs may be close by
  /// chance: about once in k times, errors are k times as large as the difference of the runs, whatever the
  /// order. Once errors are no longer small, runs may meet anywhere. Of 6000 orbits of Henon and Heiles near
  /// escape, over 30 to 100 turns at tolerances 1e-2 to 1e-6, 24 of 3075 that counted as kept were wrong by
  /// more than ten tolerances; with these rules, 3 of 2872. A prediction from a mark on the way is doubted
  /// less, as it has yet to come true.
  void doubt_meeting() {
    constexpr double by_chance = 3.0, few_times = 4.0;
    if (lag.runaway && lag.furthest > 0.01)
      seen.error = std::max(lag.furthest, 1.0), lag.late *= ratio;
    else if (lag.furthest > 0.1)
      seen.error = lag.furthest, lag.late *= ratio;
    else if (lag.runaway)
      seen.error *= by_chance * ratio, lag.late *= std::max(1.0, ratio / few_times);
  }

  /// Runs of few steps may err alike. The error of the action, and with it that of the end, is of second
  /// order in what the curve lacks, which is about the last term of its polynomial. Measured errors are 1 to
  /// 20 times the square of that term.
  void add_what_few_steps_lack() {
    const double lacking =
        orbiter.known_.distance->speed(fine.tails, orbiter.known_.distance->scales(fine.ranges));
    const double speed = speed_at(fine.state);
    seen.error = std::max(seen.error, lacking * lacking);
    lag.late = std::max(lag.late, speed > 0.0 ? lacking * lacking / speed : lacking * lacking);
  }

  /// Orbits that leave a point of rest at different times may come to another one, where they are close
  /// again; and the delay does not depend on the order.
  void doubt_pauses() {
    const OrbitQuestion& question = orbiter.question_;
    const double parted = parted_by(coarse.pauses, fine.pauses, question.t, orbiter.marks_[marks - 1]);
    orbiter.lost_ = parted > 1.0 || (fine.pauses.undecided && !question.timed);
    if (orbiter.lost_) {
      seen.error = std::max(seen.error, 1.0), lag.late = std::max(lag.late, 1.0 / orbiter.known_.usual_speed);
      orbiter.unstable_ = true;
    } else if (parted > 0.3) {
      seen.error *= ratio, lag.late *= ratio;
    }
  }

  /// Finds how the lag grows. The growth of rounding, and of what the sweeps leave, which is by the square of
  /// time, says nothing about the growth of errors. Over few turns, errors fluctuate by more than they grow.
  void find_growth() {
    const double early = lag.early, late = lag.late;
    const bool grows = late > 20.0 * early && (lag.furthest > 10.0 * left || late > 1e3 * early);
    if (!(early > 0.0 && grows)) return;
    const double turns = orbiter.known_.distance->frequency * until;
    const double rounding =
        (100.0 * std::numeric_limits<double>::epsilon() + 10.0 * fine.candidate->noise) * turns;
    const bool seen_long = turns > shortest_growth || late > 1e3 * early;
    if (seen_long && late * orbiter.known_.usual_speed * ratio > rounding) {
      seen.growth = std::min(3.0, std::log(late / early) / std::log(4.0));
      if (late > 60.0 * early) seen.rate = std::log(late / early) / (0.75 * until);
    }
    // An error that grows so much may have begun as what the sweeps left, or as rounding, which no order
    // reduces.
    orbiter.unstable_ = true;
    const double doubted = std::min(ratio, late / (20.0 * early));
    if (!seen_to_fall) seen.error *= doubted, seen.behind *= doubted;
  }
};

Comparison Orbiter::compare(const Journey& coarse, const Journey& fine) {
  return TwoRuns{*this, coarse, fine}.compare();
}

/// Returns the time by which a run may be late because of saddles: the energy that is left at a saddle
/// decides how long the motion stays near it. With several degrees of freedom, of which time may be one, a
/// pause may have other reasons, as in a motion that a clock drives with a small amplitude, so 0 is returned.
/// @param unseen see Pauses
double Orbiter::lag_at_saddles(const Journey& journey, double unseen) const {
  return known_.field.size() == 1 ? journey.pauses.lag(unseen) : 0.0;
}

double Orbiter::speed_at(const State<dynamic>& z, const Ranges& ranges) {
  VectorX slope(2 * z.q.size());
  known_.field(z, slope);
  return (*known_.distance)(slope, ranges);
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
  for (const Sketch::Sample& sample : known_.sketch->samples)
    most = std::max(most, h.rounding(sample.z));
  return most / known_.trip->energy_scale;
}

/// Returns true if the energy errs most where the monitor is small, and by no more than rounding explains.
/// The method preserves g (H - H_0), so the error is that much smaller where g is large again.
bool Orbiter::passes(const Journey& journey) const {
  Candidate& it = *journey.candidate;
  double usual = it.rate_at(journey.state);
  for (const State<dynamic>& mark : journey.marks)
    usual = std::max(usual, it.rate_at(mark));
  return journey.energy_error * it.rate_at(journey.worst) < 1e3 * known_.trip->rounding * usual;
}

/// Returns true if the gradient that H supplies differs from that of its formula by more than rounding.
bool Orbiter::follows_another_gradient() {
  if (foreign_gradient_ || question_.gradient.empty()) return foreign_gradient_.value_or(false);
  const int n = known_.field.size();
  RecordedFormula<double> formula{Recording(question_.graph, question_.energy).gradient()};
  VectorX apart = VectorX::Zero(2 * n), size = apart;
  for (const Sketch::Sample& sample : known_.sketch->samples) {
    formula.run(sample.z.data(), sample.z.data() + n, n);
    for (int i = 0; i < 2 * n; ++i) {
      const double own =
          i < n ? known_.sense * formula.partial(n + i) : -known_.sense * formula.partial(i - n);
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
  return behind * std::max(speed, 0.03 * known_.usual_speed);
}

}  // namespace avi::detail
