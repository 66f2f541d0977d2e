#include "src/choice/orbiter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

/// @file
/// The search in solve(): two runs with different steps, side by side.

namespace avi::detail {

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

Journey Orbiter::begin(const Setting& setting, double factor) {
  const double h = factor * setting.h;
  // The sweeps may leave a twentieth of the tolerance at most, see left_by_sweeps, unless small errors grow.
  const double steps = std::max(1.0, menu_.expected_steps(*setting.candidate, h, known_.span));
  const double usual = std::clamp(question_.tolerance / (10.0 + 0.1 * steps * steps), least_of_sweeps, 1e-6);
  const double tolerance = unstable_ ? least_of_sweeps : usual;
  return {*known_.trip,
          known_.field,
          *setting.candidate,
          menu_.order_of(*setting.candidate),
          h,
          {.tolerance = tolerance, .max_sweeps = 60}};
}

/// Sets how many sweeps a run may take up to a mark.
void Orbiter::bound(Journey& journey, std::size_t mark) {
  // A run that takes over a hundred times what the sketch suggests has met something else; over ten times,
  // another monitor may be better.
  const bool first = journey.candidate->failures == 0 && menu_.has_a_choice();
  journey.most =
      1e4 + (first ? 3e2 : 3e3) * menu_.expected_steps(*journey.candidate, journey.h, since_start(mark));
  // Nor should a run take long where the sketch took some hundred steps.
  if (!is_stopped_for_price()) return;
  if (resolved_ == 0.0 || std::abs(journey.state.t - question_.t) < known_.sketch->time)
    journey.most = std::min(journey.most, its_patience() / journey.candidate->price());
}

/// Takes a run to a mark, unless it is there already. @return true if the run has not failed
bool Orbiter::go_on(Journey& journey, std::size_t mark) {
  if (journey.marks.size() > mark || !journey.ok()) return journey.ok();
  bound(journey, mark);
  journey.advance(marks_[mark], mark + 1 == marks_.size());
  return journey.ok();
}

/// Keeps the failed run that came furthest: if all runs fail, its state is the answer.
void Orbiter::keep_furthest() {
  for (std::optional<Journey>* run : {&coarse_, &fine_})
    if (*run && !(*run)->ok() && (!furthest_run_ || is_further(**run, *furthest_run_)))
      furthest_run_ = std::exchange(*run, std::nullopt);
}

void Orbiter::drop_runs() {
  keep_furthest();
  coarse_.reset(), fine_.reset();
}

/// Whether the first step passes over a change with time alone soon after the start, as of coefficients near
/// a singularity in time. What begins there is over within the step, and a longer step errs alike, so the two
/// runs agree. The same step in parts shows it, each part as long as all those before it.
bool Orbiter::passes_over_start(const Journey& run) {
  if (!question_.timed) return false;
  const State<dynamic>& start = known_.trip->start;
  if (rate_ < 0.0) {
    VectorX slope(2 * known_.field.size());
    known_.field(start, slope);
    rate_ = known_.field.rate_in_time(stacked(start), slope);
  }
  constexpr double resolved = 10.0;
  const double changes = rate_ * run.h * run.candidate->rate_at(start);
  if (!(changes > resolved)) return false;
  State<dynamic> whole = start, parts = start;
  const auto advance = [&](OrbitSteps& method, State<dynamic>& z, double size) {
    const StepReport report = method.step(z, known_.sense * size);
    budget_.sweeps += report.evaluations;
    return report.ok() && z.finite();
  };
  const auto method = [&] {
    return run.candidate->steps(run.order, {.tolerance = run.solved, .max_sweeps = 60});
  };
  if (!advance(*method(), whole, run.h)) return false;
  const int halves = std::min(40, static_cast<int>(std::ceil(std::log2(changes))) + 1);
  double size = std::ldexp(run.h, -halves);
  const auto in_parts = method();
  for (int k = 0; k <= halves; ++k, size *= k > 1 ? 2.0 : 1.0)
    if (!advance(*in_parts, parts, size)) return false;
  return (*known_.distance)(whole, parts, run.ranges) > question_.tolerance;
}

/// Makes two runs side by side, from mark to mark. @return true if another setting is to be tried
bool Orbiter::pursue(Setting& setting) {
  ++round_;
  keep_furthest();
  Candidate& it = *setting.candidate;
  const double ratio = fine_ && fine_->ok() && fine_->candidate == &it ? fine_->h / setting.h : 0.0;
  if (ratio >= 1.15 && ratio <= 1.04 * std::pow(2.0 * most_trusted, 1.0 / fine_->order)) {
    coarse_ = std::move(fine_);
  } else {
    coarse_.emplace(begin(setting, longer));
    coarse_->coarse = true;
  }
  fine_.emplace(begin(setting, 1.0));
  parted_ = false;
  const bool given = question_.options.h > 0.0;
  for (std::size_t mark = 0; mark < marks_.size(); ++mark) {
    const bool compared = mark < compared_ && !parted_;
    if (compared && coarse_->marks.size() == mark) {
      bound(*coarse_, mark), bound(*fine_, mark);
      fine_->go_beside(*coarse_, marks_[mark]);
    }
    if (compared && !given && !go_on(*coarse_, mark)) return failed(*coarse_, setting);
    if (!go_on(*fine_, mark)) return failed(*fine_, setting);
    // A run with the step that is given is the answer whatever the other one does: it comes first.
    if (compared && given && !go_on(*coarse_, mark) && coarse_->spent) return failed(*coarse_, setting);
    if (mark == 0 && passes_over_start(*fine_)) fine_->jumped = true;
    if (compared) {
      judged_ = mark;
      if (judge(setting, mark)) return true;
      parted_ = resigned_ && seen_.error > 1.0;
    }
  }
  return false;
}

}  // namespace avi::detail
