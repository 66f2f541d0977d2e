#include "src/choice/orbiter.hpp"

#include <algorithm>
#include <utility>

/// @file
/// The search in solve(): the setting to try after a run that failed.

namespace avi::detail {

/// Far from all poles, something may be fast that the beginning did not show, as in a rotating frame. Gives
/// the monitor of poles a constant with which steps there are no longer, in radians, than they were before.
void Orbiter::stay_near(Candidate& it, const Sketch& there) {
  Choice& choice = answer_.choice;
  if (question_.made || !(it.longest > 0.0)) return;
  const double usual = known_.distance->frequency, before = std::sqrt(choice.poles.front());
  double root = before;
  for (const Sketch::Sample& sample : there.samples) {
    if (sample.frequency > usual) continue;  // near a pole
    const double near = std::sqrt(1.0 / it.rate_at(sample.z.data())) - before;
    root = std::max(root, std::sqrt(sample.frequency / it.longest) - near);
  }
  if (!(root > 1.1 * before)) return;
  choice.poles.front() = root * root;
  it.take(candidate(it.name, question_, known_.trip->energy_at_start, choice));
  it.below = it.between = infinity;
}

/// Makes another sketch from where a run failed: what it meets sets the steps from here on.
void Orbiter::look_from(const State<dynamic>& z) {
  known_.field.sense = known_.sense;
  const Sketch there(known_.field, stacked(z), std::abs(question_.t_end - z.t), known_.metric, 512,
                     std::abs(z.t - question_.t));
  known_.field.sense = 1.0;
  dead_end_ = there.stuck ? std::abs(z.t - question_.t) + there.time : 0.0;
  for (Candidate& it : menu_.all) {
    it.failures = 0;
    if (it.name == "poles") stay_near(it, there);
    double longest = it.longest, fictive = it.fictive;
    for (const Sketch::Sample& sample : there.samples) {
      const double g = it.rate_at(sample.z.data());
      longest = std::max(longest, g * sample.frequency);
      fictive += sample.h / g;
    }
    if (!(it.longest > 0.0) || !std::isfinite(longest)) continue;
    longest =
        std::min(longest, 30.0 * it.longest);  // a sketch is not exact, and a step may be shortened again
    it.outlook *= longest / it.longest;
    // A monitor that suits the beginning may be far too small here.
    const double slower = fictive / it.fictive * known_.sketch->time / (known_.sketch->time + there.time);
    if (std::isfinite(slower)) it.outlook *= slower;
    it.longest = longest;
  }
}

/// Goes back to the setting that the failed one was to improve on. @return true if there is one
bool Orbiter::goes_back(Setting& setting) {
  if (instead_of_.candidate) {  // set aside before
    setting.candidate->aside = true;
    setting = std::exchange(instead_of_, {});
    drop_runs();
    resolved_ = setting.h;  // this setting ran before: it is not stopped for its price
    resigned_ = true, resigned_at_ = marks_.size();
    return true;
  }
  // The step was made longer than one that worked.
  if (lengthened_ > 0 && resolved_ > 0.0 && setting.h > 1.05 * resolved_ &&
      setting.candidate == lengthened_for_) {
    setting.h = resolved_;
    lengthened_ = most_lengthened;
    lengthened_for_ = nullptr;
    drop_runs();
    return true;
  }
  return false;
}

/// Takes in where and how a run failed.
void Orbiter::note_failure(const Journey& journey, const Setting& setting) {
  const double reached = std::abs(journey.state.t - question_.t);
  const bool again = std::abs(reached - failed_at_) <= 1e-2 * reached;
  if (reached > 1.01 * repeated_) repeated_ = infinity;  // this run came past it
  Candidate& it = *setting.candidate;
  // A run that was stopped for its price has met no obstacle, but other candidates may be cheaper there.
  const bool stopped = journey.run.outcome == Outcome::stopped;
  if (!stopped) {
    furthest_ = std::max(furthest_, reached);
    if (again) repeated_ = std::min(repeated_, std::max(reached, failed_at_));
  }
  // A step that was too long, as one into a wall, may end on an orbit of another energy, which shows nothing.
  // Where the sketch ended at a singularity, that is the reason.
  const bool elsewhere = !again && journey.energy_error > 10.0 && !known_.sketch->stuck;
  const bool looks = stopped ? it.failures == 0 && menu_.has_a_choice() : !again || owes_look_;
  if (looks && !elsewhere) look_from(journey.state);
  owes_look_ = elsewhere;
  if (journey.run.outcome == Outcome::stalled) {
    // Runs with two monitors stall at the same time: the orbit ends there.
    if (stalled_with_ && stalled_with_ != &it && std::abs(reached - stalled_at_) <= 1e-2 * reached)
      dead_end_ = reached;
    stalled_at_ = reached, stalled_with_ = &it;
  }
  failed_at_ = reached;
  // A monitor may have a singularity of its own there, or be undefined.
  const bool undefined = journey.run.outcome == Outcome::non_finite && !it.fixed();
  it.failures += undefined ? 2 : 1;
  // A run may be caught where the monitor is small, by a step whose energy errs.
  const bool astray = it.failures > 1 && journey.energy_error > 0.01;
  if (!stopped || astray || elsewhere) it.below = setting.h * (it.failures > 2 ? 0.25 : 0.5);
}

/// The candidate with the least expected work, with steps that have not failed; null if all are hopeless. If
/// a sketch ends where runs fail, monitors that the singularity makes many times dearer do not pass it
/// either.
Candidate* Orbiter::most_hopeful() {
  const auto work = [&](const Candidate& each) {
    return each.outlook * std::max(1.0, menu_.first_step(each) / each.below);
  };
  double least = infinity;
  for (const Candidate& each : menu_.all)
    if (!each.aside) least = std::min(least, each.outlook);
  Candidate* best = nullptr;
  const int most = dead_end_ > 0.0 ? 2 : menu_.has_a_choice() ? 4 : 8;
  const double there = std::min(failed_at_, known_.sketch->time);
  for (Candidate& each : menu_.all) {
    if (each.aside) continue;
    // Its run would be stopped before it comes to where the last one failed.
    const double steps = menu_.expected_steps(each, std::min(menu_.first_step(each), each.below), there);
    const bool dear = is_stopped_for_price() && steps * each.price() > its_patience();
    const bool hopeless = dear || each.failures >= most || (dead_end_ > 0.0 && each.outlook > 30.0 * least);
    if (!hopeless && !(best && work(each) >= work(*best))) best = &each;
  }
  return best;
}

/// Handles a run that ended before its mark. @return true if there is another setting to try
bool Orbiter::failed(const Journey& journey, Setting& setting) {
  note_trial(journey, infinity);
  if (journey.spent) bound_ = journey.run.outcome;
  if (journey.spent || round_ >= most_rounds || question_.options.h > 0.0) return false;
  if (goes_back(setting)) return true;
  note_failure(journey, setting);
  Candidate* const best = most_hopeful();
  if (!best || static_cast<double>(budget_.sweeps - began_) * setting.candidate->price() > its_patience()) {
    in_the_way_ = std::isfinite(repeated_) ? repeated_ : best ? 0.0 : furthest_;
    return false;
  }
  if (best != setting.candidate) {
    drop_runs();
    resolved_ = 0.0, before_ = infinity;
  }
  setting = {best, std::min(menu_.first_step(*best), best->below)};
  return true;
}

}  // namespace avi::detail
