#include "orbiter.hpp"

#include "distance.hpp"
#include "journey.hpp"

#include <optional>
#include <sstream>

namespace avi {

namespace detail {

namespace {

/// Runs of fewer steps are not compared: the last step is cut to end in time, and would be the same in both.
constexpr int fewest = 3;
/// Pairs of runs.
constexpr int most_rounds = 30;
/// Part of the tolerance for which a step is chosen: what is foretold wavers.
constexpr double wanted_part = 0.2;
/// Largest factor between the errors of two runs that is believed.
constexpr double most_trusted = 20.0;
/// The step of the run that another one is compared with, over the step of that.
constexpr double longer = 1.25;

/// What two runs tell about the error of the finer one. Errors of a phase are larger where the motion is
/// faster, so how they grow is seen from the time by which one run is behind the other.
struct Comparison {
  double error = infinity;   ///< At the last mark, relative to the ranges.
  double behind = infinity;  ///< The largest error divided by the speed there: a time.
  double growth = 1.0;       ///< Exponent with which that grows in time.
  double rate = 0.0;         ///< Rate at which it grows exponentially, where it does.
};

/// Monitor, order and step of a pair of runs.
struct Setting {
  Candidate* candidate = nullptr;  ///< The monitor.
  double h = 0.0;                  ///< Fictive step of the finer run.
};

/// The error of a run with step h is (h / coarse h)^order of the coarse one's. Half of that is trusted, and a
/// factor of 20 at most: what is below it is rounding, or a feature that neither run resolves.
double trusted(const Journey& coarse, const Journey& fine) {
  return std::clamp(0.5 * std::pow(coarse.h / fine.h, fine.order), 1.0, most_trusted);
}

/// An orbit that is asked for. Two runs with different steps go along it side by side, from mark to mark;
/// where they are too far apart, or nearer than they need be, the step is another one and they begin anew.
class Orbiter {
 public:
  Orbiter(const OrbitQuestion& question, Budget& budget)
      : question_(question), budget_(budget), field_(question.graph, question.energy, question.gradient),
        sense_(question.t_end < question.t ? -1.0 : 1.0), span_(std::abs(question.t_end - question.t)) {}

  OrbitAnswer solve();

 private:
  void prepare();
  void set_marks();
  [[nodiscard]] double since_start(std::size_t mark) const { return std::abs(marks_[mark] - question_.t); }
  [[nodiscard]] Setting first_setting();
  Journey begin(const Setting& setting, double factor);
  bool go_on(Journey& journey, std::size_t mark);
  bool pursue(Setting& setting);
  bool failed(const Journey& journey, Setting& setting);
  bool judge(Setting& setting, std::size_t mark);
  bool try_others(Setting& setting);
  Comparison compare(const Journey& coarse, const Journey& fine);
  double speed_at(const State<dynamic>& z, const Ranges& ranges);
  [[nodiscard]] double foretold(const Comparison& seen, double from, double to, double speed) const;
  [[nodiscard]] double longest_step(const Candidate& it) const {
    return it.fictive > 0.0 ? span_ * it.fictive / std::max(sketch_->time, 1e-300) / fewest : span_ / fewest;
  }
  [[nodiscard]] double expected_steps(const Candidate& it, double h, double time) const {
    return time * it.fictive / std::max(sketch_->time, 1e-300) / h;
  }
  void note_trial(const Journey& journey, double error);
  OrbitAnswer fail(Outcome outcome, std::string message);
  OrbitAnswer give_up();
  OrbitAnswer finish();

  const OrbitQuestion& question_;
  Budget& budget_;
  PointField field_;
  double sense_, span_;
  std::optional<Trip> trip_;
  std::optional<Sketch> sketch_;
  std::optional<Distance> distance_;
  std::optional<SharpFeatures> features_;
  std::vector<Candidate> menu_;
  std::size_t choice_ = 0;  // in the menu, of the first candidate that has not failed
  int order_ = 16;
  double aim_ = 1e-15;        // error in a radian that is wanted
  double radians_ = 0.0;      // of the whole
  double usual_speed_ = 0.0;  // mean over the sketch
  double high_speed_ = 0.0;   // a speed that the end may have
  std::vector<double> marks_;
  std::size_t compared_ = 0;  // marks up to which there are two runs
  std::optional<Journey> coarse_, fine_;
  Comparison seen_;
  std::size_t judged_ = 0;    // mark of that comparison
  double before_ = infinity;  // the error foretold from the pair of runs before this one, and at which mark
  std::size_t before_at_ = 0;
  int vain_ = 0;               // pairs in a row that were not better than the one before
  int round_ = 0;              // pairs of runs so far
  int failures_ = 0;           // runs in a row that failed at the same time
  double failed_at_ = -1.0;    // that time
  int undefined_ = 0;          // runs whose monitor may have had no value
  double in_the_way_ = 0.0;    // time at which runs fail, whatever the step
  double resolved_ = 0.0;      // the first step that was short enough, as far as the first marks
  int lengthened_ = 0;         // times that a step was made longer
  bool others_tried_ = false;  // candidates other than the first one
  bool resigned_ = false;      // shorter steps do not help
  OrbitAnswer answer_;
};

void Orbiter::note_trial(const Journey& journey, double error) {
  answer_.choice.trials.push_back({.monitor = journey.candidate->name,
                                   .order = journey.order,
                                   .h = journey.h,
                                   .time = std::abs(journey.state.t - question_.t),
                                   .steps = journey.run.steps,
                                   .sweeps = journey.run.evaluations,
                                   .state_error = journey.ok() ? error : infinity,
                                   .outcome = journey.run.outcome});
}

Comparison Orbiter::compare(const Journey& coarse, const Journey& fine) {
  Comparison seen;
  const std::size_t marks = std::min(coarse.marks.size(), fine.marks.size());
  const double ratio = trusted(coarse, fine), until = since_start(marks - 1);
  double early = 0.0, late = 0.0;  // in the last quarter of the first quarter, and of the whole
  for (std::size_t i = 0; i < marks; ++i) {
    const double apart = (*distance_)(coarse.marks[i], fine.marks[i], fine.ranges) / ratio;
    const double speed = std::max(speed_at(fine.marks[i], fine.ranges), 0.03 * usual_speed_);
    const double behind = speed > 0.0 ? apart / speed : apart;
    if (since_start(i) <= 0.251 * until) early = std::max(early, behind);
    late = std::max(late, behind);
    seen.error = apart;
  }
  seen.behind = late;
  // How rounding grows says nothing of how an error would.
  const double rounding = (100.0 * std::numeric_limits<double>::epsilon() + 10.0 * fine.candidate->noise) *
                          distance_->frequency * until;
  // Over fewer turns errors waver by more than they grow.
  const bool seen_long = distance_->frequency * until > 400.0 || late > 1e3 * early;
  if (seen_long && early > 0.0 && late > 20.0 * early && late * usual_speed_ * ratio > rounding) {
    seen.growth = std::min(3.0, std::log(late / early) / std::log(4.0));
    if (late > 60.0 * early) seen.rate = std::log(late / early) / (0.75 * until);
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

/// Scales, sketch and menu.
void Orbiter::prepare() {
  const int n = field_.size();
  VectorX start(2 * n), slope(2 * n);
  std::copy(question_.q.begin(), question_.q.end(), start.data());
  std::copy(question_.p.begin(), question_.p.end(), start.data() + n);
  const double energy = field_(start, slope);
  if (!std::isfinite(energy) || !start.allFinite())
    throw std::invalid_argument("The energy at the start is not finite; an orbit needs one that is.");
  const VectorX metric = field_.metric(start);
  // Of time as a coordinate, and its momentum, nobody asks.
  const int seen = question_.timed ? n - 1 : n;
  distance_.emplace(metric, question_.tolerance, seen);
  field_.sense = sense_;
  sketch_.emplace(field_, start, span_, metric);
  field_.sense = 1.0;
  const Sketch& sketch = *sketch_;
  const double time = std::max(sketch.time, 1e-300);
  distance_->frequency = sketch.radians / time;
  radians_ = sketch.radians / time * span_;

  // Means over the sketch: kinetic energy, half of p q', and the speed in phase space.
  double work = 0.0, kinetic = 0.0, highest = 0.0;
  VectorX rest = VectorX::Zero(n);
  State<dynamic> z{.q = start.head(n), .p = start.tail(n), .t = question_.t};
  Ranges ranges(z);
  for (const Sketch::Sample& sample : sketch.samples)
    ranges.add({.q = sample.z.head(n), .p = sample.z.tail(n)});
  for (const Sketch::Sample& sample : sketch.samples) {
    work += sample.h * 0.5 * std::abs(sample.z.segment(n, seen).dot(sample.slope.head(seen)));
    if (question_.timed) rest[seen] = sample.z[n + seen];
    kinetic += sample.h * (sample.energy - field_.energy(sample.z.data(), rest.data()));
    const double speed = (*distance_)(sample.slope, ranges);
    usual_speed_ += sample.h * speed;
    highest = std::max(highest, speed);
  }
  work /= time, kinetic /= time, usual_speed_ /= time;
  Choice& choice = answer_.choice;
  if (question_.made) {
    choice.kinetic = question_.made->kinetic;
    choice.accelerations = question_.made->accelerations;
  } else {
    choice.kinetic = kinetic;
    choice.accelerations = accelerations(sketch, metric, seen);
  }
  high_speed_ = std::min(highest, 20.0 * usual_speed_);
  if (!(high_speed_ > 0.0)) high_speed_ = usual_speed_ = 1.0 / span_;
  // Of a body at rest, or where rounding hides the kinetic energy, some of H itself.
  double scale = std::max(std::isfinite(work) ? work : 0.0, 1e-13 * std::abs(energy));
  if (!(scale > 0.0)) scale = 1.0;
  choice.energy_scale = scale;
  answer_.energy_rounding = std::numeric_limits<double>::epsilon() * (std::abs(energy) / scale + 1.0);
  trip_.emplace(Trip{question_.graph, question_.energy, z, energy, scale, sense_, budget_});
  features_.emplace(question_.graph, question_.energy);
  if (!features_->none()) trip_->features = &*features_;
  menu_ = candidates(question_.graph, question_.energy, energy, sketch, metric, choice, question_.timed);
  const std::string& wanted = question_.options.monitor;
  if (!wanted.empty()) {
    std::erase_if(menu_, [&](const Candidate& it) { return it.name != wanted; });
    if (menu_.empty()) {
      if (!(choice.kinetic > 0.0) && wanted != "acceleration")
        throw std::invalid_argument("Monitor " + wanted +
                                    " has no meaning here: H - H(q, 0) is not positive along the orbit; take "
                                    "monitor fixed.");
      menu_.push_back(candidate(wanted, question_.graph, question_.energy, energy, choice, question_.timed));
    }
  } else {
    std::erase_if(menu_, [&](const Candidate& it) {
      return it.noise * radians_ > std::max(0.3 * question_.tolerance, 3e-15 * radians_);
    });
  }
  for (Candidate& it : menu_)
    it.supplied = question_.gradient;
}

/// The times at which two runs are compared: the end, three quarters, a half, three eighths and so on of it,
/// down to a few turns.
void Orbiter::set_marks() {
  for (double part = 1.0; marks_.size() < 80; part *= marks_.size() % 2 == 1 ? 0.75 : 2.0 / 3.0) {
    if (part < 1.0 && part * radians_ < 25.0) break;
    marks_.push_back(part == 1.0 ? question_.t_end : question_.t + sense_ * part * span_);
  }
  std::ranges::reverse(marks_);
  compared_ = marks_.size();
  // Without a check, over some turns, or the first twenty-fifth of many.
  if (!question_.options.check && radians_ > 400.0)
    for (compared_ = 1; compared_ < marks_.size() && since_start(compared_ - 1) < 0.04 * span_;)
      ++compared_;
}

Setting Orbiter::first_setting() {
  aim_ = std::max(question_.tolerance / std::max(radians_, 1.0), 1e-16);
  order_ = question_.options.order > 0 ? question_.options.order : aim_ > 2e-6 ? 8 : 16;
  Candidate& it = menu_[choice_];
  if (question_.options.h > 0.0) return {&it, question_.options.h};
  // Medians of what some hundred systems drawn at random came to. With a monitor the motion is smoother in
  // fictive time than the radians of its fastest part tell.
  const double usual = it.fixed() ? (order_ == 8 ? 6.0 : 7.2) : (order_ == 8 ? 9.5 : 10.5);
  const double radians = std::clamp(usual * std::pow(aim_, 1.0 / order_), 0.05, it.fixed() ? 2.2 : 3.5);
  return {&it, std::min(it.longest > 0.0 ? radians / it.longest : infinity, longest_step(it) / longer)};
}

Journey Orbiter::begin(const Setting& setting, double factor) {
  const double h = factor * setting.h;
  // What sweeps leave adds up with the square of the number of steps at most.
  const double steps = std::max(1.0, expected_steps(*setting.candidate, h, span_));
  const double tolerance = std::clamp(0.03 * question_.tolerance / (steps * steps), 6.25e-19, 1e-8);
  return {*trip_, field_, *setting.candidate, order_, h, {.tolerance = tolerance, .most = 60}};
}

/// Takes a run to a mark, unless it is there. @return it has not failed
bool Orbiter::go_on(Journey& journey, std::size_t mark) {
  if (journey.marks.size() > mark || !journey.ok()) return journey.ok();
  // Over a hundred times the sweeps that the sketch suggests is something else.
  journey.most = 1e4 + 3e3 * expected_steps(*journey.candidate, journey.h, since_start(mark));
  journey.advance(marks_[mark], mark + 1 == marks_.size());
  return journey.ok();
}

/// A run ended before its mark. @return there is another setting to try
bool Orbiter::failed(const Journey& journey, Setting& setting) {
  note_trial(journey, infinity);
  if (journey.spent || round_ >= most_rounds || question_.options.h > 0.0) return false;
  const double reached = std::abs(journey.state.t - question_.t);
  failures_ = reached > 0.0 && std::abs(reached - failed_at_) <= 1e-2 * reached ? failures_ + 1 : 1;
  failed_at_ = reached;
  const bool undefined = journey.run.outcome == Outcome::non_finite && !journey.candidate->fixed();
  undefined_ += undefined ? 1 : 0;
  if ((failures_ == 4 || undefined_ == 2) && choice_ + 1 < menu_.size()) {
    // A monitor may have a feature of its own there, or no value at all.
    ++choice_;
    undefined_ = 0;
    coarse_.reset(), fine_.reset();
    failures_ = 0, round_ = 0, resolved_ = 0.0, before_ = infinity;
    setting = first_setting();
    return true;
  }
  if (failures_ == 8) {
    in_the_way_ = reached;
    return false;
  }
  setting.h *= failures_ > 2 ? 0.25 : 0.5;
  return true;
}

/// Makes two runs side by side, from mark to mark. @return another setting is to be tried
bool Orbiter::pursue(Setting& setting) {
  ++round_;
  Candidate& it = *setting.candidate;
  const double ratio = fine_ && fine_->ok() && fine_->candidate == &it ? fine_->h / setting.h : 0.0;
  if (ratio >= 1.15 && ratio <= 1.04 * std::pow(2.0 * most_trusted, 1.0 / order_)) {
    coarse_ = std::move(fine_);
  } else {
    coarse_.emplace(begin(setting, longer));
  }
  fine_.emplace(begin(setting, 1.0));
  for (std::size_t mark = 0; mark < marks_.size(); ++mark) {
    if (mark < compared_ && !go_on(*coarse_, mark) && !(question_.options.h > 0.0))
      return failed(*coarse_, setting);
    if (!go_on(*fine_, mark)) return failed(*fine_, setting);
    if (mark < compared_) {
      judged_ = mark;
      if (judge(setting, mark)) return true;
    }
  }
  return false;
}

/// Compares the two runs at a mark. @return the step is to be another one
bool Orbiter::judge(Setting& setting, std::size_t mark) {
  const bool last = mark + 1 == marks_.size();
  const double here = since_start(mark), tolerance = question_.tolerance;
  const auto again = [&](double factor) {
    note_trial(*coarse_, infinity);
    if (factor > 0.87) note_trial(*fine_, seen_.error);
    setting.h = fine_->h * factor;
    if (setting.h * longer > longest_step(*setting.candidate))
      setting.h = longest_step(*setting.candidate) / longer;
    return true;
  };
  if (question_.options.h > 0.0) {
    seen_ = coarse_->ok() ? compare(*coarse_, *fine_) : Comparison();
    return false;
  }
  if (fine_->jumped && round_ < most_rounds) return again(0.4);
  seen_ = compare(*coarse_, *fine_);
  // Where runs agree and their energy errors do not fall with the step, that is rounding of H somewhere on
  // the way.
  if (seen_.error < 1e-7 && fine_->energy_error > 0.5 * coarse_->energy_error)
    answer_.energy_rounding = std::max(answer_.energy_rounding, 0.01 * fine_->energy_error);
  const bool hidden = fine_->energy_error <= 100.0 * answer_.energy_rounding;
  const double of_energy = hidden ? 0.0 : fine_->energy_error / (3.0 * tolerance);
  const double of_state = foretold(seen_, here, span_, high_speed_) / tolerance;
  if (mark == 0 && !others_tried_ && try_others(setting)) return true;
  if (resigned_ || round_ >= most_rounds) return false;
  const double error = std::max(of_state, of_energy);
  const double factor = std::pow(wanted_part / std::max(error, 1e-300), 1.0 / order_);
  if (error <= (last ? 3.0 : 2.0)) {
    if (resolved_ == 0.0) resolved_ = fine_->h;
    // A longer step pays where enough is left of the run.
    const double gain = std::min({factor, 2.0, longest_step(*setting.candidate) / (longer * fine_->h)});
    if (lengthened_ == 2 || mark > 1 || fine_->run.steps < 6 || !(gain > 1.15) ||
        (1.0 - 1.0 / gain) * (span_ - here) < 2.0 * here)
      return false;
    ++lengthened_;
    return again(gain);
  }
  const double spent = static_cast<double>(budget_.sweeps) * setting.candidate->operations();
  const double pair = span_ / here * setting.candidate->operations() *
                      static_cast<double>(coarse_->run.evaluations + fine_->run.evaluations);
  vain_ = mark <= before_at_ && error > 0.3 * before_ ? vain_ + 1 : 0;
  if (of_energy < of_state) {
    // Where steps resolve the motion, a third of them has ten million times less error: if that is not
    // enough, it is chaos, or noise. What is foretold may be wrong as long as it has not come true.
    const bool beyond = fine_->h * std::max(factor, 0.35) < resolved_ / 3.0 || factor < 0.25;
    if (resolved_ > 0.0 && beyond && seen_.error <= tolerance && !last) return false;
    const bool lost = last && marks_.size() > 1 && !(seen_.error < 1e-3);
    resigned_ = lost || vain_ > 1 || (resolved_ > 0.0 && beyond) || spent > std::max(5e8, 3.0 * pair);
  } else {
    // A feature that the steps do not see is worth a while.
    resigned_ = spent > std::max(1e9, 3.0 * pair);
  }
  if (resigned_) return false;
  before_ = error, before_at_ = mark;
  // Where errors do not fall by the order yet, by halves.
  return again(std::clamp(factor, 0.35, vain_ > 0 ? 0.5 : 0.9));
}

/// Runs the other candidates of the menu to the first mark, where that is a small part of the whole.
/// @return one of them is taken
bool Orbiter::try_others(Setting& setting) {
  others_tried_ = true;
  const double here = since_start(0);
  if (!(span_ > 8.0 * here) || menu_.size() < 2) return false;
  const double behind = std::max(seen_.behind, 1e-300);
  const double wanted = wanted_part * question_.tolerance * here / span_ / std::max(high_speed_, 1e-300);
  const auto cost = [&](const Journey& run, double its_behind) {
    const double longer_step = std::clamp(std::pow(wanted / its_behind, 1.0 / order_), 0.2, 2.0);
    return static_cast<double>(run.run.evaluations) * run.candidate->operations() / longer_step;
  };
  double best = cost(*fine_, behind);
  const double radians = setting.h * setting.candidate->longest;
  std::optional<Journey> winner;
  double its_behind = 0.0;
  for (Candidate& it : menu_) {
    if (&it == setting.candidate || it.outlook > 2.5 * menu_.front().outlook || !(it.longest > 0.0)) continue;
    Journey run = begin({&it, std::min(radians / it.longest, longest_step(it))}, 1.0);
    run.most = 1e3 + 4.0 * best / it.operations();
    run.advance(marks_[0], false);
    if (!run.ok()) {
      note_trial(run, infinity);
      continue;
    }
    const double apart = (*distance_)(run.marks[0], fine_->marks[0], fine_->ranges);
    const double speed = std::max(speed_at(fine_->marks[0], fine_->ranges), 0.03 * usual_speed_);
    const double late = std::max(apart / speed + behind, 1e-300);
    note_trial(run, apart);
    if (cost(run, late) < 0.9 * best) {
      best = cost(run, late);
      winner.emplace(std::move(run));
      its_behind = late;
    }
  }
  if (!winner) return false;
  note_trial(*coarse_, infinity), note_trial(*fine_, seen_.error);
  setting = {winner->candidate,
             winner->h * std::clamp(std::pow(wanted / its_behind, 1.0 / order_), 0.35, 1.5)};
  fine_ = std::move(winner);
  return true;
}

OrbitAnswer Orbiter::fail(Outcome outcome, std::string message) {
  answer_.run.outcome = outcome;
  answer_.run.message = std::move(message);
  answer_.state_error = infinity;
  return answer_;
}

/// No run came to the end.
OrbitAnswer Orbiter::give_up() {
  std::ostringstream text;
  text.precision(6);
  const Outcome bound = budget_.met(question_.t, 0, 0);
  if (bound != Outcome::ok) {
    text << "A bound of the call was met while monitor and step were being chosen.";
    return fail(bound, text.str());
  }
  if (in_the_way_ > 0.0)
    text << "Runs fail at t = " << question_.t + sense_ * in_the_way_
         << " with every step: the orbit meets a singularity of H there, or comes too near one.";
  else
    text << "No run came to the end, with any step that was tried.";
  return fail(Outcome::not_converged, text.str());
}

OrbitAnswer Orbiter::solve() {
  answer_.tolerance = question_.tolerance;
  answer_.q = question_.q, answer_.p = question_.p, answer_.t = question_.t;
  if (span_ == 0.0) {
    if (!std::isfinite(field_.energy(question_.q.data(), question_.p.data())))
      throw std::invalid_argument("The energy at the start is not finite; an orbit needs one that is.");
    return answer_;
  }
  std::ranges::fill(answer_.q, std::numeric_limits<double>::quiet_NaN());
  std::ranges::fill(answer_.p, std::numeric_limits<double>::quiet_NaN());
  prepare();
  set_marks();
  answer_.choice.time = since_start(0);
  for (Setting setting = first_setting(); pursue(setting);) {
  }
  if (!fine_ || (!fine_->ok() && fine_->run.steps == 0)) return give_up();
  return finish();
}

OrbitAnswer Orbiter::finish() {
  const Journey& fine = *fine_;
  const Candidate& it = *fine.candidate;
  answer_.choice.sweeps = budget_.sweeps - fine.run.evaluations;
  if (coarse_) {
    note_trial(*coarse_, infinity);
    if (compared_ == marks_.size()) answer_.choice.check = coarse_->run.evaluations;
    answer_.choice.sweeps -= answer_.choice.check;
  }
  answer_.choice.name = it.name;
  answer_.choice.order = order_;
  answer_.choice.h = fine.h;
  answer_.choice.solved = fine.solved;
  answer_.run = fine.run;
  if (fine.ok() && fine.state.t != question_.t_end) {
    const Outcome bound = budget_.met(question_.t, 0, 0);
    answer_.run.outcome = bound != Outcome::ok ? bound : Outcome::step_limit;
  }
  answer_.energy_error = fine.energy_error;
  const double here = since_start(judged_);
  // What rounding leaves grows with the phase.
  answer_.state_error = foretold(seen_, here, span_, speed_at(fine.state, fine.ranges)) +
                        (it.noise + std::numeric_limits<double>::epsilon()) * radians_;
  if (fine.energy_error > 10.0 * question_.tolerance + 100.0 * answer_.energy_rounding)
    answer_.state_error = std::max(answer_.state_error, fine.energy_error);
  if (fine.jumped) {
    answer_.state_error = infinity;
    answer_.note += "A step went over a feature of H that is thinner than the step, and shorter steps would "
                    "cost too much: the orbit may be another one. ";
  }
  if (!answer_.ok()) {
    answer_.state_error = infinity;
    if (in_the_way_ > 0.0) {
      (void)give_up();
    } else if (answer_.run.outcome == Outcome::stopped) {
      answer_.run.message =
          "The run was given up: it takes over a hundred times the steps that its beginning "
          "suggests; the orbit may come near a singularity of H.";
      answer_.run.outcome = Outcome::step_limit;
    } else {
      answer_.run.message = describe_end(answer_.run.outcome, fine.state, fine.run.steps, 0.0, "");
    }
  }
  if (seen_.rate > 0.0 || (seen_.error > 1e-3 && resigned_))
    answer_.note += "Neighbouring orbits move apart exponentially here: the state at the end depends on more "
                    "digits than the tolerance has. ";
  std::copy(fine.state.q.begin(), fine.state.q.end(), answer_.q.begin());
  std::copy(fine.state.p.begin(), fine.state.p.end(), answer_.p.begin());
  answer_.t = fine.state.t;
  return answer_;
}

}  // namespace

OrbitAnswer choose(const OrbitQuestion& question, Budget& budget) {
  return Orbiter(question, budget).solve();
}

}  // namespace detail

}  // namespace avi
