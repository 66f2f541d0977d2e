#include "src/choice/orbiter.hpp"

#include "avi/core/dot.hpp"
#include "avi/core/require.hpp"
#include "src/autodiff/rounded_formula.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

/// @file
/// The beginning of the choice in solve(): a sketch of the orbit, the menu of candidates, the marks at which
/// runs are compared, and the first setting. Runs are made in pair_of_runs.cpp and compared in
/// comparison.cpp; the next setting is in next_setting.cpp and after_a_failure.cpp, the wording of the answer
/// in verdict.cpp.

namespace avi::detail {

double energy_at_start(const OrbitQuestion& question) {
  if (question.timed) return 0.0 * question.p.back();  // H + p_t
  std::vector<double> start = question.q;
  start.insert(start.end(), question.p.begin(), question.p.end());
  return RoundedFormula(question.graph, question.energy).rounded_once(start);
}

void require_energy(double energy, const OrbitQuestion& question) {
  if (std::isfinite(energy)) return;
  std::ostringstream text;
  const auto point = [&](const char* name, const std::vector<double>& numbers) {
    const std::size_t n = numbers.size() - (question.timed ? 1 : 0);
    for (std::size_t i = 0; i < std::min<std::size_t>(n, 6); ++i)
      text << (i == 0 ? name : ", ") << numbers[i];
    text << (n > 6 ? ", ...)" : ")");
  };
  const double value = question.timed ? -question.p.back() : energy;
  text << "H is ";
  if (std::isnan(value))
    text << "nan";  // streams may print -nan
  else
    text << value;
  text << " at the start, where ";
  point("q = (", question.q), point(", p = (", question.p);
  if (question.timed) text << ", t = " << question.t;
  text << "; an orbit needs an energy that is finite.";
  throw std::invalid_argument(text.str());
}

/// Returns true if the time limit of the call was used up by its preparation, which takes long for an H of
/// very many operations.
bool Orbiter::late() const {
  return field_.operations() > 1e5 && budget_.seconds() > question_.options.seconds;
}

/// A system at rest that only the time dependence of H sets in motion hardly moves at first, so a sketch of
/// its beginning says nothing about the rest. Restarts the sketch from its own end until the motion no longer
/// grows by orders of magnitude over it.
void Orbiter::follow_the_take_off(Eigen::Index seen) {
  if (!question_.timed) return;
  const auto motion = [&](std::size_t last) {
    const auto moved = (sketch_->samples[last].z - sketch_->samples[0].z).cwiseAbs().eval();
    return std::max(moved.head(seen).maxCoeff(), moved.segment(seen + 1, seen).maxCoeff());
  };
  double before = 0.0;
  for (int parts = 0; parts < 64 && before < span_; ++parts) {
    const std::size_t count = sketch_->samples.size();
    if (sketch_->stuck || count < Sketch::few || !(motion(count - 1) > 1e3 * motion(count / 2))) return;
    before += sketch_->time - sketch_->samples.back().h;
    const VectorX from = sketch_->samples.back().z;
    sketch_.emplace(field_, from, span_ - before, metric_);
  }
}

/// Sets the unit of energy errors, the rounding error of H in that unit, and the change of H inside a step
/// that is not taken for an error of the step.
void Orbiter::take_unit_of_energy(double scale) {
  const double rounding =
      std::numeric_limits<double>::epsilon() * (std::abs(trip_->energy_at_start) / scale + 1.0);
  answer_.choice.energy_scale = trip_->energy_scale = scale;
  answer_.energy_rounding = trip_->rounding = rounding;
  // Inside a step, the polynomial is right to only half of the digits of its end.
  const double inside = std::max(0.1 * std::sqrt(question_.tolerance), 10.0 * question_.tolerance);
  trip_->felt = std::max(inside, 1e3 * rounding) * scale;
}

/// Returns the energy at the start and sets the slope there. @throws std::invalid_argument unless both are
/// finite
double Orbiter::energy_and_slope(const VectorX& start, VectorX& slope) {
  const int n = field_.size();
  const double energy = field_(start, slope);
  require_energy(energy, question_);
  const auto name = [&](int i) {
    if (question_.timed && i == 2 * n - 1) return std::string("t");
    return (i < n ? "p[" : "q[") + std::to_string(i % n) + "]";
  };
  for (int i = 0; i < 2 * n; ++i)
    if (!std::isfinite(slope[i]))
      require(false, "The derivative of H by " + name(i) + " at the start", i < n ? slope[i] : -slope[i],
              "finite");
  return energy_at_start(question_);
}

/// Makes the sketch: a run of low accuracy that stands for the orbit during the rest of the choice.
void Orbiter::sketch_from(const VectorX& start) {
  field_.sense = sense_;
  bends_.emplace(question_.graph, question_.energy, question_.timed);
  if (closely_) {
    constexpr double begun = std::numeric_limits<double>::min();
    sketch_.emplace(field_, start, span_, metric_, 4 * parts_of_close_sketch, begun,
                    span_ / parts_of_close_sketch);
    bends_->measure(*sketch_);
    return;
  }
  sketch_.emplace(field_, start, span_, metric_);
  // If nothing happens on the sketch, its long steps may have passed over something: limit them.
  if (sketch_->radians < 1e-4 && sketch_->time == span_)
    sketch_.emplace(field_, start, span_, metric_, 512, 0.0, span_ / 256.0);
  follow_the_take_off(start.size() / 2 - 1);
  bends_->measure(*sketch_);
  const std::string& named = question_.options.monitor.name;
  if (named == "poles" || (named.empty() && question_.given < 0)) look_at_bends(start);
}

/// Returns true if something other than time and its momentum changes at a sample.
bool Orbiter::moves(const Sketch::Sample& sample) const {
  const Eigen::Index n = field_.size(), seen = question_.timed ? n - 1 : n;
  return !sample.slope.head(seen).isZero(0.0) || !sample.slope.segment(n, seen).isZero(0.0);
}

/// Makes the sketch again, with short steps near bends of H, if it has missed some.
void Orbiter::look_at_bends(const VectorX& start) {
  // Of what does not move yet, a sketch shows no bend.
  if (sketch_->samples.size() < 2 || !moves(sketch_->samples.front())) return bends_->forget();
  if (question_.timed) bends_->look_ahead(start, question_.t_end);
  if (late() || !bends_->take_missed(*sketch_)) return;
  const VectorX first = sketch_->samples.front().z;  // at the start, or after the take-off
  const double before = question_.timed ? std::abs(first[first.size() / 2 - 1] - question_.t) : 0.0;
  const double usual = sketch_->radians / sketch_->time;
  field_.limit = [this](const VectorX& z) { return 0.7 * bends_->time_to_nearest(z.data()); };
  sketch_.emplace(field_, first, span_ - before, metric_, 512);
  field_.limit = nullptr;
  // A sketch of low order hardly feels a short bend, but a step of high order does.
  for (Sketch::Sample& sample : sketch_->samples)
    sample.frequency = std::max(sample.frequency, 1.0 / bends_->time_to_nearest(sample.z.data()));
  sketch_->radians = std::max(sketch_->radians, usual * sketch_->time);
  bends_->measure(*sketch_);
  if (question_.timed) bends_->look_ahead(start, question_.t_end);
}

/// Returns energies and forces along the sketch with everything at rest. @param drifting set if something
/// moves although all momenta are zero
Resting Orbiter::at_rest(Eigen::Index seen, bool& drifting) {
  const int n = field_.size();
  Resting resting;
  resting.energy.reserve(sketch_->samples.size());
  resting.forces.reserve(sketch_->samples.size() * static_cast<std::size_t>(n));
  VectorX rest(2 * n), falling(2 * n);
  for (const Sketch::Sample& sample : sketch_->samples) {
    rest.head(n) = sample.z.head(n);
    rest.tail(n).setZero();
    if (question_.timed) rest[n + seen] = sample.z[n + seen];
    double potential = field_(rest, falling);
    if (drifting || !falling.head(seen).isZero(0.0)) {
      // These momenta stop all motion if H is quadratic in p with a diagonal; the forces there are those of
      // V.
      drifting = true;
      rest.segment(n, seen) = -sense_ * falling.head(seen).cwiseQuotient(metric_.head(seen));
      potential = field_(rest, falling);
    }
    resting.energy.push_back(potential);
    resting.forces.insert(resting.forces.end(), falling.begin() + n, falling.end());
  }
  return resting;
}

/// Sets the mean speed along the sketch and the highest speed that is expected. @return the mean of half
/// of |p q'|, which serves as unit of energy
double Orbiter::mean_motion(const Ranges& ranges, Eigen::Index seen) {
  const VectorX scales = distance_->scales(ranges);
  double work = 0.0, highest = 0.0;
  for (const Sketch::Sample& sample : sketch_->samples) {
    work += sample.h * 0.5 * std::abs(dot(sample.z.segment(field_.size(), seen), sample.slope.head(seen)));
    const double speed = distance_->speed(sample.slope, scales);
    usual_speed_ += sample.h * speed;
    highest = std::max(highest, speed);
  }
  const double time = std::max(sketch_->time, 1e-300);
  usual_speed_ /= time;
  high_speed_ = std::min(highest, 20.0 * usual_speed_);
  if (!(high_speed_ > 0.0)) high_speed_ = usual_speed_ = 1.0 / span_;
  return work / time;
}

/// Sets the constants of the monitors: those of an earlier choice if there is one, else means over the
/// sketch.
void Orbiter::describe_motion(const Resting& resting, Eigen::Index seen, bool drifting) {
  Choice& choice = answer_.choice;
  if (question_.made) {
    choice.kinetic = question_.made->kinetic;
    choice.accelerations = question_.made->accelerations;
    choice.poles = question_.made->poles;
    choice.drifts = question_.made->drifts;
    return;
  }
  double kinetic = 0.0;
  for (std::size_t i = 0; i < resting.energy.size(); ++i)
    kinetic += sketch_->samples[i].h * (sketch_->samples[i].energy - resting.energy[i]);
  choice.kinetic = kinetic / std::max(sketch_->time, 1e-300);
  choice.accelerations = accelerations(*sketch_, metric_, seen);
  if (drifting) choice.drifts.assign(metric_.begin(), metric_.begin() + seen);
}

/// Looks for features of H that the orbit may meet: kinks, jumps and poles.
void Orbiter::look_for_features(double scale) {
  features_.emplace(question_.graph, question_.energy, *sketch_, question_.timed);
  if (!features_->none() || features_->hides()) trip_->features = &*features_;
  parts_ = parts_of(*field_.recording());
  // The effect of a kick grows with the phase up to the end of the run: a kick of this size is felt there.
  const double kick = std::max(question_.tolerance / std::max(radians_, 1.0), 30.0 * answer_.energy_rounding);
  trip_->kick = kick;
  passes_.emplace(question_.graph, question_.energy, *sketch_, scale, distance_->frequency, kick);
  if (passes_->none()) return;
  trip_->passes = &*passes_;
  const Eigen::Index n = field_.size();
  const auto& moves = sketch_->samples.front().slope;
  const bool diagonal =
      parts_ == Parts::nystrom &&
      (moves.head(n) - sense_ * metric_.cwiseProduct(trip_->start.p)).cwiseAbs().maxCoeff() <=
          1e-9 * moves.head(n).cwiseAbs().maxCoeff();
  if (diagonal) trip_->inverse_masses = metric_;
}

/// Leaves only the requested monitor in the menu. @throws std::invalid_argument if that monitor has no
/// meaning for this H
void Orbiter::take_the_named(const std::string& wanted) {
  const Choice& choice = answer_.choice;
  const double energy = trip_->energy_at_start;
  const std::string_view kept = wanted == splitting ? "fixed" : std::string_view(wanted);
  std::erase_if(menu_, [&](const Candidate& it) { return it.name != kept; });
  if (question_.given >= 0) {
    Candidate own = candidate_of(wanted, question_, energy, choice, question_.prepared.get());
    const auto require_good = [&](const std::string& where, double g) {
      require(std::isfinite(g) && g > 0.0, "The given monitor " + where, g, "finite and positive");
    };
    require_good("at the start", own.rate_at(trip_->start));
    double t = question_.t;
    for (const Sketch::Sample& sample : sketch_->samples) {
      if (menu_.empty()) require_good(joined({"near t = ", t}), own.rate_at(sample.z.data()));
      t += sense_ * sample.h;
    }
  }
  if (!menu_.empty()) return;
  if (wanted == "poles" && choice.poles.empty())
    throw std::invalid_argument("Monitor poles has no meaning here: H divides by no function of q alone, "
                                "nor takes its logarithm, nor bends within a short length; take monitor "
                                "fixed.");
  if (!(choice.kinetic > 0.0) && wanted.starts_with("energy"))
    throw std::invalid_argument("Monitor " + wanted +
                                " has no meaning here: its kinetic energy is not positive along the orbit; "
                                "take monitor fixed.");
  menu_.push_back(candidate(wanted, question_, energy, choice));
}

/// Sets the menu of candidates, the most promising first, and the order of the first runs.
void Orbiter::write_menu(const Resting& resting) {
  const double energy = trip_->energy_at_start;
  menu_ = candidates(question_, energy, *sketch_, *bends_, radians_, resting, metric_, answer_.choice,
                     field_.operations());
  if (const std::string& wanted = question_.options.monitor.name; !wanted.empty()) {
    take_the_named(wanted);
  } else {
    for (Candidate& it : menu_)
      it.aside = it.noise * radians_ > std::max(0.3 * question_.tolerance, 3e-15 * radians_);
    std::stable_partition(menu_.begin(), menu_.end(), [](const Candidate& it) { return !it.aside; });
  }
  for (Candidate& it : menu_) {
    it.supplied = question_.gradient, it.recording = field_.recording(), it.switches = question_.switches,
    it.kinks = question_.kinks;
    it.brief = radians_ < 8.0 && parts_ != Parts::coupled;  // machine code pays off after some 90 sweeps
  }
  aim_ = std::max(question_.tolerance / std::max(radians_, 1.0), 1e-16);
  // Order 8 is for runs of few steps whose sweeps contract well: there order 16 takes up to a tenth more
  // time. Over ten turns at tolerances 1e-2 and 1e-3, order 16 takes a tenth to a seventh less (means over
  // twenty problems).
  const bool brief = radians_ < 20.0 && aim_ > 2e-6 && parts_ != Parts::coupled;
  order_ = question_.options.order > 0 ? question_.options.order : brief ? 8 : 16;
  offer_splitting();
  if (question_.prepared)
    for (Candidate& it : menu_)
      it.take(question_.prepared->formulas_at(energy, answer_.choice.kinetic));
}

/// Prepares the runs: makes the sketch, the scales and the menu.
void Orbiter::prepare() {
  const int n = field_.size();
  VectorX start(2 * n), slope(2 * n);
  std::copy(question_.q.begin(), question_.q.end(), start.data());
  std::copy(question_.p.begin(), question_.p.end(), start.data() + n);
  const double energy = energy_and_slope(start, slope);
  metric_ = field_.metric(start);
  // Time as a coordinate and its momentum are auxiliary: their errors do not count.
  const int seen = question_.timed ? n - 1 : n;
  distance_.emplace(metric_, question_.tolerance, seen);
  sketch_from(start);
  if (late()) return;
  dead_end_ = sketch_->stuck ? sketch_->time : 0.0;
  const double time = std::max(sketch_->time, 1e-300);
  distance_->frequency = sketch_->radians / time;
  radians_ = sketch_->radians / time * span_;
  distance_->noise = rounding_of(*sketch_, metric_);

  const State<dynamic> z{.q = start.head(n), .p = start.tail(n), .t = question_.t};
  Ranges ranges(z);
  for (const Sketch::Sample& sample : sketch_->samples)
    ranges.add(sample.z.data(), sample.z.data() + n);
  bool drifting = false;  // something moves although all momenta are zero
  const Resting resting = at_rest(seen, drifting);
  field_.sense = 1.0;
  const double work = mean_motion(ranges, seen);
  describe_motion(resting, seen, drifting);
  // For a body at rest, or where rounding hides the kinetic energy, the unit is a small part of H itself.
  double scale = std::max(std::isfinite(work) ? work : 0.0, 1e-13 * std::abs(energy));
  if (!(scale > 0.0)) scale = 1.0;
  trip_.emplace(Trip{z, energy, scale, sense_, budget_});
  take_unit_of_energy(scale);
  trip_->span = span_;
  trip_->ranges = ranges.high - ranges.low;
  trip_->seen = seen;
  look_for_features(scale);
  write_menu(resting);
}

/// Returns how far rounding of the slopes may move each entry in a hundred radians, if all rounding errors
/// have the same sign.
VectorX Orbiter::rounding_of(const Sketch& sketch, const VectorX& metric) {
  const Eigen::Index n = metric.size();
  VectorX slope = VectorX::Zero(2 * n);
  const std::size_t every = sketch.samples.size() / 8 + 1;
  for (std::size_t i = 0; i < sketch.samples.size(); i += every)
    field_.add_sensitivity(sketch.samples[i].z, sketch.samples[i].slope, i, slope);
  slope *= 10.0 * std::numeric_limits<double>::epsilon();
  const double frequency = distance_->frequency, time = frequency > 0.0 ? 100.0 / frequency : span_;
  VectorX moved = std::min(time, span_) * slope;
  moved.head(n) += std::min(time, span_) * metric.cwiseProduct(moved.tail(n));
  return moved;
}

/// Sets the times at which two runs are compared: the end, three quarters, a half, three eighths and so on of
/// the way, down to a few turns. Runs that are too short to show how errors grow have only every third of
/// these marks.
void Orbiter::set_marks() {
  const bool is_long = radians_ > shortest_growth;
  const double least = is_long ? 25.0 : field_.size() > 1 ? 12.0 : 20.0;
  for (double part = 1.0; marks_.size() < 80 && (part == 1.0 || part * radians_ >= least);) {
    marks_.push_back(part == 1.0 ? question_.t_end : question_.t + sense_ * part * span_);
    part *= !is_long ? 0.375 : marks_.size() % 2 == 1 ? 0.75 : 2.0 / 3.0;
  }
  std::ranges::reverse(marks_);
  compared_ = marks_.size();
  // Without a check, only the beginning of a long run is compared, up to the first mark that is at least a
  // twenty-fifth of the way.
  if (!question_.options.check && radians_ > shortest_growth)
    for (compared_ = 1; compared_ < marks_.size() && since_start(compared_ - 1) < 0.04 * span_;)
      ++compared_;
}

/// Returns the step with which a candidate begins.
double Orbiter::first_step(const Candidate& it) {
  // The constants are medians over some hundred systems drawn at random. With a monitor they are larger,
  // because the motion is smoother in fictive time than the frequency of its fastest part suggests.
  const int order = order_of(it);
  const double usual = it.splits() ? 8.0 : it.fixed() ? (order == 8 ? 6.0 : 7.2) : (order == 8 ? 9.5 : 10.5);
  // Low orders need far shorter steps.
  const double radians = std::clamp(usual * std::pow(aim_, 1.0 / order), order < 6 ? 1e-5 : 0.01,
                                    !it.fixed()                ? 3.5
                                    : parts_ == Parts::coupled ? 1.8
                                                               : 2.2);
  return std::min({it.longest > 0.0 ? radians / it.longest : infinity, longest_step(it) / longer,
                   field_.size() > 4 ? stable_step(it) / longer : infinity});
}

/// Lengthens a step if its run would be stopped for its price before the end of the sketch, as one into a
/// singularity: such a run comes farther with longer steps. @return h, or a step with which the run costs a
/// hundredth of that price
double Orbiter::affordable(Candidate& it, double h) {
  const double steps = expected_steps(it, h, std::min(span_, sketch_->time)),
               most = its_patience() / (10.0 * it.price());
  return steps > most && order_of(it) >= 6 ? h * (steps / (0.01 * most)) : h;
}

/// Returns the longest fixed step whose sweeps still contract if something moves a little faster than the
/// sketch shows; for the splitting, the longest step with which small oscillations stay small.
double Orbiter::stable_step(const Candidate& it) {
  if (!it.fixed()) return infinity;
  if (fastest_ < 0.0) fastest_ = field_.fastest(stacked(trip_->start), metric_);
  // An oscillation grows if step times frequency is 6.15 or more. Near 3.14 it grows by at most 6e-4 a step,
  // and only one of two runs can be that near.
  if (it.splits()) return fastest_ > 0.0 ? 5.5 / fastest_ : infinity;
  // Parts much faster than the visible motion are left to Newton's method.
  return fastest_ > 0.0 && fastest_ < 6.0 * it.longest ? 3.1 / fastest_ : infinity;
}

/// Adds the explicit splitting to the menu if fixed steps come first there: before them if it should take
/// less time, behind them if it should take less than twice as much. If it was asked for by name, it replaces
/// them.
void Orbiter::offer_splitting() {
  const SolveOptions& options = question_.options;
  const bool asked = options.monitor.name == splitting;
  if (!asked && (!options.monitor.name.empty() || options.order > 0 || menu_.empty() ||
                 !menu_.front().fixed() || !(aim_ > 1e-13)))
    return;
  if (parts_ != Parts::nystrom) {
    if (!asked) return;
    throw std::invalid_argument(
        "Monitor splitting has no meaning here: it is for H = T(p) + V(q) with T quadratic in p.");
  }
  if (asked) {
    menu_.front().name = splitting;
    return;
  }
  (void)menu_.front().formulas();  // made once, for both
  menu_.insert(menu_.begin(), menu_.front());
  menu_.front().name = splitting;
  // The splitting makes two runs side by side for the price of one; for collocation, ten sweeps a step are
  // usual.
  const double split = 14.0 * menu_[0].price() * 2.0 / first_step(menu_[0]);
  const double other = 10.0 * menu_[1].price() * (order_ == 8 ? 0.6 : 1.0) * 1.8 / first_step(menu_[1]);
  // The usable step of the splitting varies by a factor of two from orbit to orbit; in a long run, trials
  // decide.
  if (!(split < other)) std::swap(menu_[0], menu_[1]);
  if (!(split < 2.0 * other)) menu_.erase(menu_.begin() + 1);
}

/// Whether the next setting asks for far more steps than the sketch took for the whole way: then its long
/// steps passed over something, such as an encounter on the way of a free particle, of which a sketch takes
/// six or seven steps.
bool Orbiter::was_blind(const Setting& setting) const {
  const bool quick = sketch_->time == span_ && sketch_->samples.size() < 16;
  if (closely_ || !quick || question_.made || question_.options.h > 0.0) return false;
  return expected_steps(*setting.candidate, setting.h, span_) > 1000.0;
}

/// Begins anew with a sketch of short steps.
OrbitAnswer Orbiter::look_closely() {
  Orbiter close(question_, budget_);
  close.closely_ = true;
  close.answer_.choice.trials = std::move(answer_.choice.trials);
  return close.solve();
}

OrbitAnswer Orbiter::solve() {
  answer_.tolerance = question_.tolerance;
  answer_.q = question_.q, answer_.p = question_.p, answer_.t = question_.t;
  if (span_ == 0.0) {
    require_energy(field_.energy(question_.q.data(), question_.p.data()), question_);
    return answer_;
  }
  std::ranges::fill(answer_.q, std::numeric_limits<double>::quiet_NaN());
  std::ranges::fill(answer_.p, std::numeric_limits<double>::quiet_NaN());
  if (!late()) prepare();
  if (late()) return fail(Outcome::time_limit, "The bound on seconds was met while the run was prepared.");
  const double since_zero = distance_->frequency * std::abs(question_.t);
  constexpr double most = 0.5 / std::numeric_limits<double>::epsilon();
  if (radians_ > most) return too_far("The end, t = ", question_.t_end, radians_);
  if (since_zero > most) return too_far("The zero of time, seen from t = ", question_.t, since_zero);
  set_marks();
  answer_.choice.time = since_start(0);
  Setting setting{&menu_.front(), question_.options.h};
  if (!(setting.h > 0.0)) setting.h = affordable(menu_.front(), first_step(menu_.front()));
  while (pursue(setting))
    if (was_blind(setting)) return look_closely();
  take_furthest();
  if (!fine_ || (!fine_->ok() && fine_->run.steps == 0)) return give_up();
  return finish();
}

OrbitAnswer choose(const OrbitQuestion& question, Budget& budget) {
  return Orbiter(question, budget).solve();
}

}  // namespace avi::detail
