#include "src/choice/orbiter.hpp"

#include <algorithm>
#include <utility>

/// @file
/// The search in solve(): what two runs that came to a mark say about the setting, and the next one.

namespace avi::detail {

namespace {

/// Whether the same steps can be solved to more digits. Explicit ones have nothing to solve.
bool sweeps_leave_more(const Journey& run) {
  return !run.candidate->splits() && run.solved > least_of_sweeps;
}

}  // namespace

/// If H depends on time, the motion may be far larger later than at its beginning, whose mean of half
/// of |p q'| is the unit of energy errors. Then the mean up to this mark becomes the unit.
void Orbiter::look_at_work(std::size_t mark) {
  const double mean = fine_->work / since_start(mark), unit = known_.trip->energy_scale;
  if (!(mean > unit) || !std::isfinite(mean)) return;
  // A run whose steps are too long for the later motion may run away.
  const double apart = coarse_->work / fine_->work;
  const bool at_one_time = coarse_->ok() && coarse_->marks.size() == mark + 1;
  if (at_one_time && !(apart > 0.5 && apart < 2.0)) return;
  known_.take_unit_of_energy(mean);
  coarse_->energy_error *= unit / mean, fine_->energy_error *= unit / mean;
}

/// Asks for another pair of runs, with steps longer by a factor. @return true
bool Orbiter::again(Setting& setting, double factor) {
  note_trial(*coarse_, infinity);
  if (factor > 0.87) note_trial(*fine_, seen_.error);
  setting.h = fine_->h * factor;
  if (setting.h * longer > menu_.longest_step(*setting.candidate))
    setting.h = menu_.longest_step(*setting.candidate) / longer;
  return true;
}

/// Classifies energy errors of runs that agree. Errors that do not fall with the step are rounding of H
/// somewhere on the way, or chance; errors are also rounding if the tolerance asks for less than rounding of
/// H. Those over ten tolerances have to be shown to be rounding.
Orbiter::Alike Orbiter::alike_energies() {
  const double errs = fine_->energy_error;
  if (!(seen_.error < 1e-7 && fine_->run.steps > Journey::few && errs > energy_left_by_sweeps(*fine_)))
    return Alike::no;
  const bool falls = !(errs > 0.5 * coarse_->energy_error);
  if (falls && errs <= 3.0 * question_.tolerance) return Alike::no;
  if ((!falls && passes(*fine_)) || errs < 100.0 * rounding_of_energy(*fine_)) return Alike::rounding;
  if (falls) return Alike::no;
  if (!(errs < most_rounding) || follows_another_gradient()) return Alike::unexplained;
  if (errs <= 10.0 * question_.tolerance) return Alike::harmless;
  return known_.features->has_kinks() ? Alike::rounding : Alike::unexplained;
}

/// The tolerance is kept at the end. Two runs of few steps may agree by chance, so an error not far below it
/// is believed only if a third run, with shorter steps, confirms it. @param factor by which the step would
/// have to change to just keep it @return true if a third run is to be made
bool Orbiter::confirm(Setting& setting, double error, double factor) {
  constexpr double clear = 0.3;
  constexpr long few = 300;
  if (resolved_ == 0.0) resolved_ = fine_->h;
  if (confirmed_ || !question_.options.check || !(error > clear) || fine_->run.steps > few) return false;
  confirmed_ = unstable_ = true;
  return again(setting, std::min(factor, 1.0 / 1.2));
}

/// The tolerance is kept on the way. A longer step pays if enough of the run is left. @param factor by which
/// the step would have to change to just keep it @return true if the step is changed
bool Orbiter::lengthen(Setting& setting, std::size_t mark, double factor) {
  const double here = since_start(mark);
  if (resolved_ == 0.0) resolved_ = fine_->h;
  // Where sweeps converge slowly, a shorter step costs less.
  const long steps = fine_->run.steps;
  if (!slow_ && mark == 0 && steps >= fewest && fine_->run.evaluations > 20 * steps) {
    slow_ = true;
    return again(setting, 0.7);
  }
  const double most = std::min(menu_.longest_step(*setting.candidate), menu_.stable_step(*setting.candidate));
  const double gain = std::min({0.9 * factor, 2.0, most / (longer * fine_->h)});
  // A longer step may need Newton's method, which takes many times as long as a sweep.
  const bool laborious = !setting.candidate->splits() && fine_->run.evaluations > 14 * steps;
  if (lengthened_ == most_lengthened || mark > 1 || steps < 6 || laborious || !(gain > 1.15) ||
      (1.0 - 1.0 / gain) * (known_.span - here) < 2.0 * here)
    return false;
  ++lengthened_;
  lengthened_for_ = setting.candidate;
  return again(setting, gain);
}

/// The tolerance is not kept. Tries a shorter step unless that would be in vain. @param factor by which the
/// step would have to change to just keep it @return true if the step is changed
bool Orbiter::shorten(Setting& setting, std::size_t mark, const ErrorsAtMark& errors, double factor) {
  const bool last = mark + 1 == marks_.size();
  const double error = std::max(errors.of_state, errors.of_energy);
  // At a point of rest, runs may part because of what the sweeps left, and where terms of H cancel, that may
  // be the energy error: first try the same steps, solved to the last digit.
  if ((lost_ || (errors.steady && steady_)) && sweeps_leave_more(*fine_)) {
    unstable_ = true;
    return again(setting, 1.0);
  }
  const double spent = static_cast<double>(budget_.sweeps - began_) * setting.candidate->price();
  const double pair = known_.span / since_start(mark) * setting.candidate->price() *
                      static_cast<double>(coarse_->run.evaluations + fine_->run.evaluations);
  // Errors set by rounding go up and down, so a pair that does not improve on the best one is in vain.
  // Without a check, a prediction stands for the whole run, and each pair is compared with the one before.
  // While energy errors near the tolerance still fall fast, steps do not resolve the motion yet.
  const bool resolving = errors.of_energy > 0.01 && fine_->energy_error < 0.1 * coarse_->energy_error;
  // At a saddle, runs are wholly apart until the error of the energy is less than what is left of it there.
  const double of_run = errors.hidden ? infinity : fine_->energy_error;
  const bool nearer = lost_ && !forgiven_ && of_run < 0.1 * energy_before_;
  energy_before_ = of_run;
  const bool in_vain = mark <= before_at_ && error > 0.3 * before_ && !resolving && !nearer;
  forgiven_ = forgiven_ || (nearer && mark <= before_at_ && error > 0.3 * before_);
  // Beyond a kink, errors fall slowly and by chance: steps could be shortened without end.
  const bool endless = known_.features->has_kinks() && pair > 0.5 * patience * std::max(factor, 0.35);
  if (errors.of_energy < errors.of_state && errors.of_energy <= 3.0) {
    // Once steps resolve the motion, steps a third as long have a ten million times smaller error. If that is
    // not enough, it is chaos or noise; unless the step was made longer, as the shorter one is known to work.
    // A prediction may be wrong as long as it has not come true.
    const bool beyond = fine_->h * std::max(factor, 0.35) < resolved_ / 3.0 ||
                        (factor < 0.25 && fine_->h <= 1.05 * resolved_);
    // If so, the pair goes on to the next mark instead: its error here is small, and only a prediction says
    // otherwise.
    if (resolved_ > 0.0 && beyond && seen_.error <= question_.tolerance && !last) return false;
    vain_ = in_vain ? vain_ + 1 : 0;
    const bool lost = errors.hidden && last && mark > 0 && !(seen_.error < 1e-3) && !(fine_->h > resolved_);
    // Energy errors this small that do not fall with the step are rounding on the way.
    const bool rounds = errors.hidden || (fine_->energy_error > 0.5 * coarse_->energy_error &&
                                          fine_->energy_error < 1e4 * answer_.energy_rounding);
    resigned_ = lost || vain_ > (known_.features->has_kinks() || thin_ ? 3 : 1) ||
                (rounds && resolved_ > 0.0 && beyond) || endless || spent > std::max(patience, 3.0 * pair);
  } else {
    vain_ = in_vain ? vain_ + 1 : 0;
    // A feature that the steps do not see, or do not resolve yet, is worth some patience, unless the errors
    // stay the same. Each pair takes three times as long as the one before, so all pairs never take longer
    // than three of the last.
    resigned_ = (errors.steady && steady_) || endless || (vain_ > 1 && spent > 0.2 * patience) ||
                spent > std::max(2.0 * patience, 3.0 * pair);
  }
  steady_ = errors.steady;
  resigned_at_ = mark;
  if (resigned_) return !last && take_from_aside(setting, 0.3 * pair);
  if (mark > 0) lengthened_ = most_lengthened;  // the prediction of the first mark was wrong
  before_ = in_vain && question_.options.check ? std::min(before_, error) : error, before_at_ = mark;
  // Where errors do not fall by the order yet, halve the step.
  return again(setting, std::max(vain_ > 0 ? std::min(factor, 0.5) : factor, 0.35));
}

/// Where the motion becomes faster, steps that resolved its beginning resolve it no longer: energy errors are
/// then more than rounding and fall with the step. Two conclusions are withdrawn: that these steps resolve
/// the motion and, if drawn at an earlier mark, that shorter ones do not help.
void Orbiter::doubt_beginning(std::size_t mark, double of_energy) {
  const bool falls = fine_->energy_error < 0.5 * coarse_->energy_error;
  // Energy errors far below the tolerance say nothing about the state.
  const bool kept = of_energy <= 3.0 && (of_energy < 1e-4 || seen_.error <= 3.0 * question_.tolerance);
  if (!falls || kept) return;
  if (resigned_ && mark > resigned_at_ && of_energy > 3.0) resigned_ = false, vain_ = 0;
  if (resolved_ >= fine_->h) resolved_ = 0.0;
}

/// Where energy errors are large, looks at the motion from where they are largest. @return true if it is
/// much faster than the sketch of the beginning shows: other candidates may follow it better
bool Orbiter::is_outrun(double of_energy) {
  if (also_ || looks_ == most_looks || !(of_energy > 3.0) || question_.made || question_.options.h > 0.0 ||
      !question_.options.monitor.name.empty())
    return false;
  ++looks_;
  known_.field.sense = known_.sense;
  const State<dynamic>& z = fine_->worst;
  const Sketch there(known_.field, stacked(z), std::abs(question_.t_end - z.t), known_.metric, Sketch::few,
                     std::abs(z.t - question_.t));
  known_.field.sense = 1.0;
  constexpr double much = 3.0;
  return outrun_ = there.highest_frequency() > much * known_.sketch->highest_frequency();
}

/// Compares the two runs at a mark. @return true if the step is changed
bool Orbiter::judge(Setting& setting, std::size_t mark) {
  const bool last = mark + 1 == marks_.size();
  const double here = since_start(mark), tolerance = question_.tolerance;
  look_at_work(mark);
  // Steps that switches cut are the same in both runs, whose difference then says nothing.
  const bool cut = question_.switches && 4 * coarse_->whole < coarse_->run.steps;
  if (question_.options.h > 0.0) {
    if (cut && last)
      answer_.note +=
          "Most steps are cut where H switches with time, alike in both runs, which say nothing of the error "
          "then: take a shorter h. ";
    seen_ = coarse_->ok() && !cut ? compare(*coarse_, *fine_) : Comparison();
    return false;
  }
  if (cut && round_ < most_rounds) {
    const double mean = coarse_->gone / static_cast<double>(coarse_->run.steps);
    setting.candidate->between = std::min(0.9 * mean, 0.8 * coarse_->h);
    return again(setting, setting.candidate->between / (longer * fine_->h));
  }
  if (fine_->jumped && round_ < most_rounds) {
    thin_ = true;
    return again(setting, 0.4);
  }
  seen_ = cut ? Comparison() : compare(*coarse_, *fine_);
  // The energy error that the sweeps leave may decide how long the motion stays near a saddle.
  if (!unstable_ && sweeps_leave_more(*fine_) &&
      lag_at_saddles(*fine_, 0.2 * fine_->solved) * known_.high_speed > wanted_part * tolerance) {
    unstable_ = true;
    return again(setting, 1.0);
  }
  const Alike alike = alike_energies();
  if (alike == Alike::rounding)
    answer_.energy_rounding = std::max(answer_.energy_rounding, 0.01 * fine_->energy_error);
  // Above the tolerance it may be more than rounding; then its effect on the state does not fall either.
  if (alike == Alike::rounding || alike == Alike::harmless)
    coarse_grained_ = coarse_grained_ || fine_->energy_error > 3.0 * tolerance;
  const bool hidden = fine_->energy_error <= 100.0 * answer_.energy_rounding;
  const double of_energy = hidden || alike == Alike::harmless ? 0.0 : fine_->energy_error / (3.0 * tolerance);
  const double of_state = foretold(seen_, here, known_.span, known_.high_speed) / tolerance;
  if (!hidden) doubt_beginning(mark, of_energy);
  if (!hidden && mark > 0 && is_outrun(of_energy)) return true;
  if (mark == 0 && !others_tried_ && try_others(setting)) return true;
  if (resigned_ || round_ >= most_rounds) return false;
  // No step adds digits to distant coordinates, or to a distant clock.
  const double digits =
      std::max(known_.distance->rounding_of(fine_->state, fine_->ranges), rounding_of_clock(*fine_));
  if (digits > tolerance && seen_.error <= 1e3 * digits) {
    resigned_ = true, resigned_at_ = marks_.size();
    return false;
  }
  const double error = std::max(of_state, of_energy);
  const double factor = std::pow(wanted_part / std::max(error, 1e-300), 1.0 / fine_->order);
  if (last && error <= 3.0) return confirm(setting, error, factor);
  if (error <= 2.0) return lengthen(setting, mark, factor);
  return shorten(setting, mark, {of_state, of_energy, hidden, alike == Alike::unexplained}, factor);
}

/// Takes a candidate that was set aside for its noise, as no other keeps the tolerance; unless it fails, it
/// will do. @param others work of a pair of runs, which it has to undercut @return true if one is taken
bool Orbiter::take_from_aside(Setting& setting, double others) {
  const auto work = [&](Candidate& it) {
    return 2.0 * 10.0 * it.price() * menu_.expected_steps(it, menu_.first_step(it), known_.span);
  };
  Candidate* best = nullptr;
  for (Candidate& it : menu_.all)
    if (it.aside && work(it) < (best ? work(*best) : others)) best = &it;
  if (!best) return false;
  if (coarse_ && coarse_->ok()) note_trial(*coarse_, infinity);
  if (fine_ && fine_->ok()) note_trial(*fine_, seen_.error);
  drop_runs();
  best->aside = false;
  instead_of_ = std::exchange(setting, {best, menu_.first_step(*best)});
  resigned_ = steady_ = false;
  resolved_ = 0.0, before_ = infinity, vain_ = 0;
  return true;
}

/// Runs the other candidates to the first mark, if that is a small part of the whole. @return true if one of
/// them is taken
bool Orbiter::try_others(Setting& setting) {
  others_tried_ = true;
  const double here = since_start(0);
  if (!(known_.span > 8.0 * here) || !menu_.has_a_choice()) return false;
  const double behind = std::max(seen_.behind, 1e-300);
  const double wanted =
      wanted_part * question_.tolerance * here / known_.span / std::max(known_.high_speed, 1e-300);
  // Factor by which its steps may become longer.
  const auto gain = [&](const Journey& run, double its_behind) {
    const double most =
        std::min(run.candidate->splits() ? 3.0 : 2.0, menu_.stable_step(*run.candidate) / (longer * run.h));
    return std::clamp(std::pow(wanted / its_behind, 1.0 / run.order), 0.2, std::max(most, 0.2));
  };
  const auto cost = [&](const Journey& run, double its_behind) {
    return static_cast<double>(run.run.evaluations) * run.candidate->price() / gain(run, its_behind);
  };
  double best = cost(*fine_, behind);
  const double radians = setting.h * setting.candidate->longest;
  std::optional<Journey> winner;
  double its_behind = 0.0;
  for (Candidate& it : menu_.all) {
    const bool dear = it.outlook > 2.5 * menu_.all.front().outlook;
    if (&it == setting.candidate || it.aside || dear || !(it.longest > 0.0)) continue;
    const bool same = it.splits() == setting.candidate->splits();
    const double first = same ? radians / it.longest : menu_.first_step(it);
    Journey run = begin({&it, std::min({first, menu_.longest_step(it), it.below})}, 1.0);
    // A run that takes more cannot win, however much longer its steps may become.
    run.most = 50.0 + (it.splits() ? 2.7 : 1.8) * best / it.price();
    run.advance(marks_[0], false);
    if (!run.ok()) {
      note_trial(run, infinity);
      continue;
    }
    const double apart = (*known_.distance)(run.marks[0], fine_->marks[0], fine_->ranges);
    const double speed = std::max(speed_at(fine_->marks[0], fine_->ranges), 0.03 * known_.usual_speed);
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
  setting = {winner->candidate, winner->h * std::clamp(gain(*winner, its_behind), 0.35,
                                                       winner->candidate->splits() ? 2.0 : 1.5)};
  fine_ = std::move(winner);
  return true;
}

}  // namespace avi::detail
