#include "avi/solve.hpp"

#include "distance.hpp"
#include "journey.hpp"

#include <optional>
#include <sstream>

namespace avi {

namespace detail {

namespace {

/// Runs of fewer steps are not compared: the last step is cut to end in time, and would be the same in both.
constexpr int fewest = 3;

/// What two runs tell about the error of the finer one. Errors of a phase are larger where the motion is
/// faster, so how they grow is seen from the time by which one run is behind the other.
struct Comparison {
  double error = infinity;   ///< At the last mark, relative to the ranges.
  double behind = infinity;  ///< The largest error divided by the speed there: a time.
  double growth = 1.0;       ///< Exponent with which that grows in time.
  double rate = 0.0;         ///< Rate at which it grows exponentially, where it does.
};

/// An orbit that is asked for.
class Orbiter {
 public:
  explicit Orbiter(const OrbitQuestion& question)
      : question_(question), field_(question.graph, question.energy),
        sense_(question.t_end < question.t ? -1.0 : 1.0) {}

  OrbitAnswer solve();

 private:
  Journey run(Candidate& candidate, int order, double h, double end, const std::vector<double>& marks,
              double dearest = infinity);
  Comparison compare(const Journey& coarse, const Journey& fine);
  double speed_at(const State<dynamic>& z, const Ranges& ranges);
  double foretold(const Comparison& seen, double from, double to, double speed) const;
  Candidate* choose(std::vector<Candidate>& menu, double piece, double aim, int order, double& h);
  void note_trial(const Journey& journey, double error);
  [[nodiscard]] double guess(const Candidate& it, double aim, int order) const;

  const OrbitQuestion& question_;
  PointField field_;
  double sense_;
  std::optional<Trip> trip_;
  std::optional<Sketch> sketch_;
  std::optional<Distance> distance_;
  double in_the_way_ = 0.0;   // time after which runs failed, whatever the step
  double per_time_ = 0.0;     // sweeps of the chosen candidate in a unit of time, times h
  double radians_ = 0.0;      // of the whole
  double usual_speed_ = 0.0;  // mean over the sketch
  double high_speed_ = 0.0;   // a speed that the end may have
  OrbitAnswer answer_;
};

Journey Orbiter::run(Candidate& candidate, int order, double h, double end, const std::vector<double>& marks,
                     double dearest) {
  return travel(*trip_, field_, candidate, order, h, end, marks, [&](const Journey& journey) {
    return static_cast<double>(journey.run.evaluations) <= dearest;
  });
}

void Orbiter::note_trial(const Journey& journey, double error) {
  answer_.choice.trials.push_back({.monitor = journey.candidate->name,
                                   .order = journey.order,
                                   .h = journey.h,
                                   .time = std::abs(journey.state.t - question_.t),
                                   .steps = journey.run.steps,
                                   .sweeps = journey.run.evaluations,
                                   .state_error = journey.ok() ? error : infinity,
                                   .outcome = journey.run.outcome});
  answer_.choice.sweeps += journey.run.evaluations;
}

/// The error of a run with step h is (h / coarse h)^order of the coarse one's. Half of that is trusted, and a
/// factor of 20 at most: what is below it is rounding, or a feature that neither run resolves.
double trusted(const Journey& coarse, const Journey& fine) {
  return std::clamp(0.5 * std::pow(coarse.h / fine.h, fine.order), 1.0, 20.0);
}

Comparison Orbiter::compare(const Journey& coarse, const Journey& fine) {
  Comparison seen;
  const std::size_t marks = std::min(coarse.marks.size(), fine.marks.size());
  if (marks == 0) return seen;
  const double ratio = trusted(coarse, fine);
  double early = 0.0, late = 0.0;
  for (std::size_t i = 0; i < marks; ++i) {
    const double apart = (*distance_)(coarse.marks[i], fine.marks[i], fine.ranges) / ratio;
    double& largest = 2 * (i + 1) <= marks ? early : late;
    const double speed = std::max(speed_at(fine.marks[i], fine.ranges), 0.03 * usual_speed_);
    largest = std::max(largest, speed > 0.0 ? apart / speed : apart);
    seen.error = apart;
  }
  seen.behind = std::max(early, late);
  // How rounding grows says nothing of how an error would.
  const double rounding = (100.0 * std::numeric_limits<double>::epsilon() + 10.0 * fine.candidate->noise) *
                          distance_->frequency * std::abs(fine.marks[marks - 1].t - question_.t);
  if (early > 0.0 && late > 3.5 * early && late * usual_speed_ * ratio > rounding) {
    seen.growth = std::min(3.0, std::log2(late / early));
    if (late > 12.0 * early)
      seen.rate = std::log(late / early) / std::abs(fine.marks[marks - 1].t - fine.marks[(marks - 1) / 2].t);
  }
  return seen;
}

double Orbiter::speed_at(const State<dynamic>& z, const Ranges& ranges) {
  VectorX at(2 * z.q.size()), slope(2 * z.q.size());
  at << z.q, z.p;
  field_(at, slope);
  return (*distance_)(slope, ranges);
}

/// The error at the time `to` after the start, from what was seen until `from`.
double Orbiter::foretold(const Comparison& seen, double from, double to, double speed) const {
  if (!(to > from)) return seen.error;
  const double behind = seen.rate > 0.0 ? seen.behind * std::exp(std::min(700.0, seen.rate * (to - from)))
                                        : seen.behind * std::pow(to / from, seen.growth);
  return behind * std::max(speed, 0.03 * usual_speed_);
}

double Orbiter::guess(const Candidate& it, double aim, int order) const {
  const double radians = std::clamp(6.0 * std::pow(aim, 1.0 / order), 0.05, 2.2);
  // The longest step in radians decides.
  double longest = 0.0;
  for (const Sketch::Sample& sample : sketch_->samples)
    longest = std::max(longest, const_cast<Candidate&>(it).rate(sample.z.data()) * sample.frequency);
  return longest > 0.0 ? radians / longest : infinity;
}

/// The candidate with the least work for the error `aim` at the end of a short piece, and a first step.
Candidate* Orbiter::choose(std::vector<Candidate>& menu, double piece, double aim, int order, double& h) {
  const double end = question_.t + sense_ * piece;
  const std::vector<double> marks{question_.t + 0.5 * sense_ * piece, end};
  std::optional<Journey> reference;
  double of_reference = 0.0, best = infinity;
  Candidate* chosen = nullptr;
  // Operations that all these runs may take, and each of them, besides some thousand sweeps.
  double left = 5e8;
  for (Candidate& it : menu) {
    if (left <= 0.0) break;
    if (!chosen && it.outlook > 100.0 * menu.front().outlook) break;
    if (trip_->bound(0) != Outcome::ok) break;
    if (chosen && it.outlook > 2.5 * chosen->outlook) break;
    if (it.noise * radians_ > std::max(0.3 * question_.tolerance, 3e-15 * radians_)) continue;
    const double longest = piece * it.fictive / sketch_->time / fewest;
    double first = std::min(guess(it, aim, order), longest);
    double failed_at = -1.0;
    int failures = 0;
    for (int attempt = 0; attempt < (in_the_way_ > 0.0 ? 4 : 10); ++attempt, first *= 0.4) {
      // As many sweeps as the sketch suggests, many times over; less where another candidate does with less.
      const double usual = 10.0 * longest / first;
      const double most = 1e4 + std::min(1e8, left) / it.operations();
      Journey journey = run(it, order, first, end, marks,
                            1e3 + std::min({100.0 * usual, 4.0 * best / it.operations(), most}));
      left -= static_cast<double>(journey.run.evaluations) * it.operations();
      if (!journey.ok()) {
        note_trial(journey, infinity);
        if (journey.run.outcome == Outcome::stopped || journey.spent) break;
        // Shorter steps that fail at the same time: there is something in the way.
        const double reached = std::abs(journey.state.t - question_.t);
        failures = reached > 0.0 && std::abs(reached - failed_at) <= 1e-2 * reached ? failures + 1 : 0;
        if (failures == (in_the_way_ > 0.0 ? 2 : 8)) {
          in_the_way_ = std::max(in_the_way_, reached);
          break;
        }
        failed_at = reached;
        continue;
      }
      if (journey.run.steps < fewest) {
        note_trial(journey, infinity);
        continue;
      }
      double error;
      if (!reference) {
        Journey finer = run(it, order, 0.8 * first, end, marks, 1e3 + std::min(200.0 * usual, 2.0 * most));
        if (!finer.ok()) {
          note_trial(finer, infinity);
          continue;
        }
        of_reference = compare(journey, finer).behind * high_speed_;
        error = of_reference * trusted(journey, finer);
        note_trial(finer, of_reference);
        reference = std::move(finer);
      } else {
        error =
            compare(journey, *reference).behind * trusted(journey, *reference) * high_speed_ + of_reference;
      }
      note_trial(journey, error);
      const double wanted =
          first * std::clamp(std::pow(0.5 * aim / std::max(error, 1e-300), 1.0 / order), 0.1, 2.0);
      const double cost = static_cast<double>(journey.run.evaluations) * it.operations() * first / wanted;
      if (cost < best) {
        best = cost;
        chosen = &it;
        h = std::min(wanted, longest);
        per_time_ = static_cast<double>(journey.run.evaluations) * first / piece;
      }
      break;
    }
  }
  return chosen;
}

OrbitAnswer Orbiter::solve() {
  const int n = field_.size();
  VectorX start(2 * n);
  std::copy(question_.q.begin(), question_.q.end(), start.data());
  std::copy(question_.p.begin(), question_.p.end(), start.data() + n);
  VectorX slope(2 * n);
  const double energy = field_(start, slope);
  if (!std::isfinite(energy) || !start.allFinite())
    throw std::invalid_argument("The energy at the start is not finite; an orbit needs one that is.");
  answer_.tolerance = question_.tolerance;
  answer_.q = question_.q, answer_.p = question_.p, answer_.t = question_.t;
  const double span = std::abs(question_.t_end - question_.t);
  if (span == 0.0) return answer_;
  for (double& x : answer_.q)
    x = std::numeric_limits<double>::quiet_NaN();
  for (double& x : answer_.p)
    x = std::numeric_limits<double>::quiet_NaN();

  const VectorX metric = metric_of(question_.graph, question_.energy, start);
  distance_.emplace(metric);
  field_.sense = sense_;
  sketch_.emplace(field_, start, span, metric);
  field_.sense = 1.0;
  const Sketch& sketch = *sketch_;
  distance_->frequency = sketch.radians / std::max(sketch.time, 1e-300);
  // Means over the sketch: kinetic energy, and half of p q'.
  double work = 0.0, kinetic = 0.0;
  {
    const VectorX rest = VectorX::Zero(n);
    VectorX dz(2 * n);
    for (const Sketch::Sample& sample : sketch.samples) {
      const double here = field_(sample.z, dz);
      work += sample.h * 0.5 * std::abs(sample.z.tail(n).dot(dz.head(n)));
      kinetic += sample.h * (here - field_.energy(sample.z.data(), rest.data()));
    }
    work /= std::max(sketch.time, 1e-300), kinetic /= std::max(sketch.time, 1e-300);
    Ranges ranges(State<dynamic>{.q = start.head(n), .p = start.tail(n)});
    for (const Sketch::Sample& sample : sketch.samples)
      ranges.add({.q = sample.z.head(n), .p = sample.z.tail(n)});
    double highest = 0.0;
    for (const Sketch::Sample& sample : sketch.samples) {
      const double speed = (*distance_)(sample.slope, ranges);
      usual_speed_ += sample.h * speed / std::max(sketch.time, 1e-300);
      highest = std::max(highest, speed);
    }
    high_speed_ = std::min(highest, 20.0 * usual_speed_);
    if (!(high_speed_ > 0.0)) high_speed_ = usual_speed_ = 1.0 / span;
  }
  // Of a body at rest, or where rounding hides the kinetic energy, some of H itself.
  double scale = std::max(std::isfinite(work) ? work : 0.0, 1e-13 * std::abs(energy));
  if (!(scale > 0.0)) scale = 1.0;
  answer_.choice.energy_scale = scale;
  answer_.energy_rounding = std::numeric_limits<double>::epsilon() * (std::abs(energy) / scale + 1.0);
  State<dynamic> z{.q = start.head(n), .p = start.tail(n), .t = question_.t};
  trip_.emplace(Trip{question_.graph, question_.energy, z, energy, scale, sense_, question_.options});

  std::vector<Candidate> menu =
      candidates(question_.graph, question_.energy, energy, start, sketch, metric, kinetic);

  // Radians of the whole, of the part over which two runs are compared, and of a short trial.
  const double per_time = sketch.radians / std::max(sketch.time, 1e-300);
  const double radians = radians_ = per_time * span;
  const double compared =
      radians <= 400.0 ? span : std::min(span, std::max(sketch.time_of(36.0), 0.06 * span));
  const double piece = std::min(compared, sketch.time_of(20.0));
  answer_.choice.time = piece;
  const double aim = std::max(question_.tolerance * compared / span, 1e-15);
  const int order = aim > 2e-6 ? 8 : 16;
  double h = 0.0;
  const double piece_aim = std::max(aim * piece / compared, 1e-15);
  Candidate* it = choose(menu, piece, piece_aim, order, h);
  const auto fail = [&](Outcome outcome, std::string message) {
    answer_.run.outcome = outcome;
    answer_.run.message = std::move(message);
    answer_.state_error = infinity;
    return answer_;
  };
  if (!it) {
    std::ostringstream text;
    text.precision(6);
    if (trip_->bound(0) != Outcome::ok) {
      text << "A bound of the call was met while monitor and step were being chosen.";
    } else if (in_the_way_ > 0.0) {
      text << "Runs fail at t = " << question_.t + sense_ * in_the_way_
           << " with every step: the orbit meets a singularity of H there, or comes too near one.";
    } else {
      text << "No run came through the time " << piece
           << " from the start on, with any step that was tried; bounds on a trial are 1e8 operations.";
    }
    return fail(trip_->bound(0) != Outcome::ok ? trip_->bound(0) : Outcome::not_converged, text.str());
  }
  // Two runs over the part that is compared, with shorter steps until they agree.
  std::vector<double> marks;
  if (compared < span)
    for (int k = 1; k <= 4; ++k)
      marks.push_back(question_.t + sense_ * compared * 0.25 * k);
  else
    marks = {question_.t_end};
  const double there = marks.back();
  SharpFeatures features(question_.graph, question_.energy);
  if (!features.none()) trip_->features = &features;
  const auto total = [&](const Journey& fine, const Comparison& seen) {
    if (fine.jumped) return 1e3;
    const bool hidden = fine.energy_error <= 100.0 * answer_.energy_rounding;
    return std::max(foretold(seen, compared, span, high_speed_) / question_.tolerance,
                    hidden ? 0.0 : fine.energy_error / (3.0 * question_.tolerance));
  };
  std::optional<Journey> coarse, fine, finest;
  Comparison seen;
  double error = infinity, before = infinity;
  const double longest = compared * it->fictive / sketch.time / fewest;
  double next = std::min(1.25 * h, longest);
  // What all these runs may take: some seconds, or three times the first of them where that is more.
  double allowed = 5e8 / it->operations();
  for (int round = 0, failures = 0; round < 30; ++round) {
    if (fine && !coarse) allowed = std::max(allowed, 4.0 * static_cast<double>(fine->run.evaluations));
    if (fine && static_cast<double>(fine->run.evaluations) * fine->h / next > allowed) break;
    Journey journey = run(*it, order, next, there, marks, 1e4 + 100.0 * per_time_ * compared / next);
    if (!journey.ok()) {
      note_trial(journey, infinity);
      if (journey.spent || journey.run.outcome == Outcome::stopped) {
        fine = std::move(journey);
        break;
      }
      if (fine && next > fine->h) break;  // the longer step does not pay
      next *= 0.5;
      if (++failures == 12) break;
      continue;
    }
    if (journey.run.steps < fewest) {
      note_trial(journey, infinity);
      if (fine && next > fine->h) break;
      next *= 0.4;
      continue;
    }
    if (fine && journey.h > fine->h) {
      // A longer step, to be judged by the shortest one.
      if (!finest) finest = fine;
      const Comparison longer = compare(journey, *finest);
      const double ratio = trusted(journey, *finest);
      const Comparison its{longer.error * ratio, longer.behind * ratio, longer.growth, longer.rate};
      const double its_error = total(journey, its);
      note_trial(journey, its.error);
      if (its_error > 1.0) break;
      fine = std::move(journey);
      seen = its;
      error = its_error;
    } else {
      coarse = std::move(fine);
      fine = std::move(journey);
      if (!coarse) {
        note_trial(*fine, infinity);
        next = 0.8 * fine->h;
        continue;
      }
      seen = compare(*coarse, *fine);
      before = error;
      error = total(*fine, seen);
      SolveTrial& longer = answer_.choice.trials.back();
      if (longer.outcome == Outcome::ok) longer.state_error = seen.error * trusted(*coarse, *fine);
      note_trial(*fine, seen.error);
      // Where shorter steps do not help though the energy is kept to rounding, it is chaos, or noise; else it
      // may be a feature that no step has seen yet, which is worth a while.
      const bool resolved = fine->energy_error <= 1e4 * answer_.energy_rounding || seen.error < 1e-7;
      const double spent = static_cast<double>(trip_->sweeps) * it->operations();
      if (error > 1.0 && error > 0.3 * before && !fine->jumped &&
          (resolved ? round > 2 : round > 3 && spent > 2e8))
        break;
    }
    if (fine->jumped) {
      next = 0.4 * fine->h;
    } else if (error > 1.0) {
      // Where errors do not fall by the order yet, by halves.
      next = fine->h * std::clamp(std::pow(0.4 / error, 1.0 / order), 0.35, round > 4 ? 0.5 : 0.85);
    } else {
      // Of a long run a longer step pays for one more trial.
      const double gain = std::min(std::pow(0.4 / std::max(error, 1e-300), 1.0 / order), 2.0);
      if (compared == span || gain < 1.15 || gain * fine->h > longest) break;
      next = gain * fine->h;
    }
  }
  if (!fine) return fail(Outcome::not_converged, "No step size brought a run to the end.");
  Journey whole = *fine;
  double checked = -1.0;
  if (compared < span && fine->ok()) {
    const std::vector<double> end{question_.t_end};
    const double rounding = 100.0 * answer_.energy_rounding;
    const double limit = std::max({3.0 * question_.tolerance, 3.0 * fine->energy_error, rounding});
    double step = fine->h;
    std::optional<Journey> other;
    for (int restart = 0; restart < 8; ++restart) {
      const double most = 1e6 + 100.0 * per_time_ * span / step;
      whole = travel(*trip_, field_, *it, order, step, question_.t_end, end, [&](const Journey& journey) {
        return static_cast<double>(journey.run.evaluations) <= most &&
               (restart == 7 || journey.energy_error <= limit);
      });
      if (whole.spent) break;
      if (whole.ok() && trip_->options.check) {
        if (!other) {
          other = travel(
              *trip_, field_, *it, order, 1.25 * step, question_.t_end, end,
              [&](const Journey& journey) { return static_cast<double>(journey.run.evaluations) <= most; });
          note_trial(*other, infinity);
        }
        if (other->ok())
          checked = compare(*other, whole).error;
        else if (other->run.outcome != Outcome::ok)
          checked = infinity;
        // What is not far off is made good by a shorter step; the rest is chaos, or rounding.
        if (!(checked > 3.0 * question_.tolerance) || !(checked < 1e-3) || restart >= 2) break;
        note_trial(whole, checked);
        other = whole;
        step *= std::clamp(std::pow(0.3 * question_.tolerance / checked, 1.0 / order), 0.4, 0.8);
        continue;
      }
      if (whole.ok()) break;
      note_trial(whole, infinity);
      step *= 0.8;
    }
  } else {
    answer_.choice.sweeps -= fine->run.evaluations;
    // The run that is taken is no trial.
    auto& trials = answer_.choice.trials;
    for (auto trial = trials.rbegin(); trial != trials.rend(); ++trial)
      if (trial->h == fine->h && trial->steps == fine->run.steps) {
        trials.erase(std::next(trial).base());
        break;
      }
  }
  answer_.choice.name = it->name;
  answer_.choice.order = order;
  answer_.choice.h = whole.h;
  answer_.run = whole.run;
  answer_.energy_error = whole.energy_error;
  // What rounding leaves grows with the phase.
  answer_.state_error = checked >= 0.0
                            ? checked + (it->noise + std::numeric_limits<double>::epsilon()) * radians
                            : foretold(seen, compared, span, speed_at(whole.state, whole.ranges)) +
                                  (it->noise + std::numeric_limits<double>::epsilon()) * radians;
  if (whole.jumped) {
    answer_.state_error = infinity;
    answer_.note += "A step went over a feature of H that is thinner than the step, and shorter steps would "
                    "cost too much: the orbit may "
                    "be another one. ";
  }
  if (!whole.ok()) {
    answer_.state_error = infinity;
    answer_.run.message = whole.run.outcome == Outcome::stopped
                              ? "The run was given up: it takes over a hundred times the steps that its "
                                "beginning suggests; the "
                                "orbit may come near a singularity of H."
                              : describe_end(whole.run.outcome, whole.state, whole.run.steps, 0.0, "");
    if (whole.run.outcome == Outcome::stopped) answer_.run.outcome = Outcome::step_limit;
  }
  if (seen.rate > 0.0 || (checked > 1e-3 && checked > 100.0 * foretold(seen, compared, span, high_speed_)))
    answer_.note += "Neighbouring orbits move apart exponentially here: the state at the end depends on more "
                    "digits than the tolerance has. ";
  std::copy(whole.state.q.begin(), whole.state.q.end(), answer_.q.begin());
  std::copy(whole.state.p.begin(), whole.state.p.end(), answer_.p.begin());
  answer_.t = whole.state.t;
  return answer_;
}

}  // namespace

OrbitAnswer answer(const OrbitQuestion& question) {
  require_finite("Time of the start", question.t);
  require(std::isfinite(question.t_end), "End time", question.t_end, "finite");
  require(question.tolerance >= 1e-13 && question.tolerance <= 1e-2, "Tolerance", question.tolerance,
          "in [1e-13, 1e-2]");
  require(question.options.seconds >= 0.0, "Bound on seconds", question.options.seconds, "at least 0");
  require(question.options.sweeps >= 1, "Bound on sweeps", question.options.sweeps, "at least 1");
  return Orbiter(question).solve();
}

}  // namespace detail

}  // namespace avi
