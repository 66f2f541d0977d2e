#include "src/choice/orbiter.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

/// @file
/// The answer of solve(): the state, its error and, in a sentence, why a run ended early or why nothing is
/// promised about its accuracy.

namespace avi::detail {

OrbitAnswer Orbiter::fail(Outcome outcome, std::string message) {
  answer_.run.outcome = outcome;
  answer_.run.message = std::move(message);
  answer_.state_error = infinity;
  return answer_;
}

/// Answers that no run came to the end.
OrbitAnswer Orbiter::give_up() {
  std::ostringstream text;
  if (bound_ != Outcome::ok) {
    text << "A bound of the call was met while monitor and step were being chosen.";
    return fail(bound_, text.str());
  }
  const std::string& named = question_.options.monitor.name;
  if (in_the_way_ > 0.0)
    text << "Runs fail at t = " << question_.t + known_.sense * in_the_way_ << " with every step"
         << (named.empty() ? "" : " of monitor " + named + ", as asked for")
         << ": the orbit meets a singularity of H "
         << (question_.given >= 0 || !named.empty() ? "or of the monitor " : "")
         << "there, or comes too near one.";
  else
    text << (question_.made ? "No run came to the end with a step that was chosen for another start; solve() "
                              "chooses for this one."
                            : "No run came to the end, with any step that was tried.");
  return fail(Outcome::not_converged, text.str());
}

/// Answers that the start or the end is so far away that rounding of its time is more than a radian.
OrbitAnswer Orbiter::too_far(const char* what, double t, double radians) {
  std::ostringstream text;
  text << what << t << ", is some " << radians
       << " radians of the fastest motion away: the rounding of such a time alone hides where in its motion "
          "the system is.";
  return fail(Outcome::stalled, text.str());
}

/// Explains why a run was stopped on the way for its price.
std::string Orbiter::given_up(const Journey& run) const {
  std::ostringstream text;
  const double reached = std::abs(run.state.t - question_.t);
  const auto [when, faster] = known_.sketch->fastest();
  if (dead_end_ > 0.0)
    text << "The run was given up: from t = " << question_.t + known_.sense * dead_end_
         << " on no step is short enough; the orbit meets a singularity of H there, or leaves where H is a "
            "number.";
  else if (known_.sketch->stuck && known_.sketch->samples.empty())
    text << "The end, t = " << question_.t_end
         << ", is over 1e14 times as far as a step from the start may be: a nearer one will do.";
  else if (!(run.h > 0.0) || !std::isfinite(run.h))
    text
        << "Its numbers are beyond those of a double, 1e-308 to 1e308: other units of time, length or energy "
           "will do.";
  else if (run.run.steps == 0 && answer_.choice.trials.back().outcome == Outcome::stalled)
    text << "The time of the run is a few units of the rounding of t = " << question_.t
         << ": no step is shorter than that and moves the clock.";
  else if (const std::string& named = question_.options.monitor.name; !named.empty())
    text << "The run was given up: with monitor " << named
         << ", as asked for, it takes over a hundred times the steps that its beginning suggests; where none "
            "is named, one that suits the orbit is chosen.";
  else if (faster > 1e4 && when > reached)
    text << "The run was given up: near t = " << question_.t + known_.sense * when
         << " something is so much faster than at the start that H seems to have a singularity there.";
  else if (static_cast<double>(run.run.steps) < 10.0 * menu_.expected_steps(*run.candidate, run.h, reached))
    text << "The run was given up after " << run.run.steps << " steps: the end is some "
         << menu_.expected_steps(*run.candidate, run.h, known_.span)
         << " of them away, and no step was found with which the tolerance is kept so far.";
  else
    text << "The run was given up: it takes over a hundred times the steps that its beginning suggests; "
            "something on the way is far faster, as near a singularity of H.";
  return text.str();
}

/// Reports the setting of a run, and its work separately from that of all other runs.
void Orbiter::tell_work(const Journey& fine) {
  Choice& choice = answer_.choice;
  choice.sweeps = budget_.sweeps - fine.run.evaluations;
  if (coarse_) {
    if (coarse_->ok() && coarse_->run.steps > 0) note_trial(*coarse_, infinity);
    if (compared_ == marks_.size()) choice.check = coarse_->run.evaluations;
    choice.sweeps -= choice.check;
  }
  choice.name = fine.candidate->name;
  choice.order = fine.order;
  choice.h = fine.h;
  choice.solved = fine.solved;
  answer_.run = fine.run;
  if (bound_ != Outcome::ok)
    answer_.run.outcome = bound_;
  else if (fine.ok() && fine.state.t != question_.t_end)
    answer_.run.outcome = Outcome::stopped;
  answer_.energy_error = fine.energy_error;
}

/// Reports the error of the state: what two runs predict, plus what rounding adds.
void Orbiter::tell_error(const Journey& fine, double foreseen) {
  // The effect of rounding grows with the phase, and is larger where the motion is fast at the end.
  const double epsilon = std::numeric_limits<double>::epsilon(), of_clock = rounding_of_clock(fine),
               of_entries = known_.distance->rounding_of(fine.state, fine.ranges),
               phase = std::max(known_.radians, known_.span * speed_at(fine.state, fine.ranges));
  answer_.state_error = foreseen + (fine.candidate->noise + epsilon) * phase + of_clock + of_entries;
  if (of_entries > 10.0 * question_.tolerance)
    answer_.note +=
        "A coordinate or momentum is so far from zero that its rounding is more than the tolerance. ";
  if (of_clock > question_.tolerance)
    answer_.note += "Time is so far from zero that its rounding is more than the tolerance. ";
  if (fine.energy_error > 10.0 * question_.tolerance + 100.0 * answer_.energy_rounding)
    answer_.state_error = std::max(answer_.state_error, fine.energy_error);
  // A step that was chosen for another start may be so long here that both runs err alike; the energy shows
  // it.
  if (question_.made && fine.energy_error > 100.0 * answer_.energy_rounding)
    answer_.state_error = std::max(answer_.state_error, 4.0 * fine.energy_error);
  if (fine.jumped) {
    answer_.state_error = infinity;
    answer_.note += "A step went over a feature of H that is thinner than the step, and shorter steps would "
                    "cost too much: the orbit may be another one. ";
  }
}

/// Explains why the run did not come to its end.
void Orbiter::tell_end(const Journey& fine) {
  answer_.state_error = infinity;
  if (in_the_way_ > 0.0) {
    (void)give_up();
  } else if (answer_.run.outcome == Outcome::stopped) {
    answer_.run.message = given_up(fine);
    answer_.run.outcome = Outcome::step_limit;
  } else if (fine.state.t == question_.t_end) {
    answer_.run.message =
        question_.options.h > 0.0
            ? "A bound of the call was met by the run with a longer step, which was to show the error."
            : "A bound of the call was met by the run with the shorter step; the state is that of the one "
              "with the longer step.";
  } else {
    State<dynamic> there = fine.state;
    if (question_.timed)
      there.q.conservativeResize(known_.field.size() - 1),
          there.p.conservativeResize(known_.field.size() - 1);
    const bool unsolved = answer_.run.outcome == Outcome::not_converged;
    answer_.run.message = describe_end(answer_.run.outcome, there, fine.run.steps, 0.0,
                                       fine.crossed ? "a step went over a place where H is infinite"
                                       : unsolved   ? "the equations of a step were not solved"
                                                    : "");
  }
}

/// Explains why the state is not right to the tolerance.
void Orbiter::tell_doubts(const Journey& fine, double foreseen) {
  std::string& note = answer_.note;
  const bool apart = seen_.error > 1e-3;
  const bool compared = answer_.ok() && std::isfinite(seen_.error) && !(question_.options.h > 0.0);
  const bool unresolved =
      compared && !steady_ &&
      fine.energy_error > std::max(10.0 * question_.tolerance, 100.0 * answer_.energy_rounding);
  if (known_.features->has_kinks() && (seen_.rate > 0.0 || resigned_))
    note += "H has a kink, a jump or a branch, beyond which errors are larger than before. ";
  else if (unresolved)
    note += "Steps do not resolve all of the motion, and much shorter ones were not tried: a monitor that is "
            "small where the motion is fast helps. ";
  else if (seen_.rate > 0.0 && (seen_.exponential || apart))
    note += "Neighbouring orbits move apart exponentially here: the state at the end depends on more "
            "digits than the tolerance has. ";
  else if (apart && resigned_)
    note += "Two runs stay apart, however short their steps: the state at the end depends on more digits "
            "than there are. ";
  if (!answer_.ok()) return;
  if (lost_)
    note += "The orbit all but stops at a saddle, and how it goes on depends on more digits than the "
            "tolerance has. ";
  if (steady_ && fine.energy_error >= most_rounding) {
    note += "The energy errs alike however short the steps: ";
    note += question_.gradient.empty() ? "H has a jump or a bend within a step, or rounds by so much. "
                                       : "the gradient that H supplies is not its own, or H has a jump. ";
  }
  const bool adds_up = resigned_ || seen_.growth > 1.0 || answer_.state_error > 2.0 * foreseen;
  if (note.empty() && adds_up && !question_.made && !(question_.options.h > 0.0))
    note += "Shorter steps do not help: rounding adds up over the run to more than the tolerance. ";
  if (question_.made)
    note += "Monitor, order and step were chosen for another start; solve() chooses for this one. ";
}

/// Picks the run whose end is the answer if a bound was met or runs failed: the one that came furthest,
/// unless a step is given. If a bound was met, an earlier run that failed counts only where there is no
/// other.
void Orbiter::take_furthest() {
  if (fine_ && coarse_ && (bound_ != Outcome::ok || !coarse_->ok()) && !(question_.options.h > 0.0) &&
      is_further(*coarse_, *fine_))
    std::swap(coarse_, fine_);
  if (furthest_run_ && (!fine_ || (bound_ == Outcome::ok && is_further(*furthest_run_, *fine_))))
    fine_ = std::move(furthest_run_);
}

OrbitAnswer Orbiter::finish() {
  const Journey& fine = *fine_;
  tell_work(fine);
  // The predicted error is at most as large as the motion itself.
  const double told = parted_ ? seen_.error
                              : foretold(seen_, since_start(judged_), known_.span,
                                         speed_at(fine.state, fine.ranges)),
               foreseen = std::min(told, std::max(seen_.furthest, 1.0));
  tell_error(fine, foreseen);
  if (!answer_.ok()) tell_end(fine);
  if (std::isnan(answer_.state_error)) answer_.state_error = infinity;
  if (!answer_.kept()) tell_doubts(fine, foreseen);
  if (!answer_.note.empty()) answer_.note.pop_back();  // the space after the last sentence
  std::copy(fine.state.q.begin(), fine.state.q.end(), answer_.q.begin());
  std::copy(fine.state.p.begin(), fine.state.p.end(), answer_.p.begin());
  answer_.t = fine.state.t;
  answer_.prepared =
      std::make_shared<const Prepared>(Prepared{std::move(known_.field), fine.candidate->formulas()});
  return answer_;
}

}  // namespace avi::detail
