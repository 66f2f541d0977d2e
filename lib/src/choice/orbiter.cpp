#include "src/choice/orbiter.hpp"

#include "src/choice/choose.hpp"

#include <algorithm>
#include <limits>
#include <utility>

/// @file
/// The choice in solve() from its first look at the orbit to its answer. Runs are made in pair_of_runs.cpp
/// and compared in comparison.cpp; the next setting is in next_setting.cpp and after_a_failure.cpp, the
/// wording of the answer in verdict.cpp.

namespace avi::detail {

/// Sets the times at which two runs are compared: the end, three quarters, a half, three eighths and so on of
/// the way, down to a few turns. Runs that are too short to show how errors grow have only every third of
/// these marks.
void Orbiter::set_marks() {
  const bool is_long = known_.radians > shortest_growth;
  const double least = is_long ? 25.0 : known_.field.size() > 1 ? 12.0 : 20.0;
  for (double part = 1.0; marks_.size() < 80 && (part == 1.0 || part * known_.radians >= least);) {
    marks_.push_back(part == 1.0 ? question_.t_end : question_.t + known_.sense * part * known_.span);
    part *= !is_long ? 0.375 : marks_.size() % 2 == 1 ? 0.75 : 2.0 / 3.0;
  }
  std::ranges::reverse(marks_);
  compared_ = marks_.size();
  // Without a check, only the beginning of a long run is compared, up to the first mark that is at least a
  // twenty-fifth of the way.
  if (!question_.options.check && known_.radians > shortest_growth)
    for (compared_ = 1; compared_ < marks_.size() && since_start(compared_ - 1) < 0.04 * known_.span;)
      ++compared_;
}

/// Lengthens a step if its run would be stopped for its price before the end of the sketch, as one into a
/// singularity: such a run comes farther with longer steps. @return h, or a step with which the run costs a
/// hundredth of that price
double Orbiter::affordable(Candidate& it, double h) {
  const double steps = menu_.expected_steps(it, h, std::min(known_.span, known_.sketch->time)),
               most = its_patience() / (10.0 * it.price());
  return steps > most && menu_.order_of(it) >= 6 ? h * (steps / (0.01 * most)) : h;
}

/// Whether the next setting asks for far more steps than the sketch took for the whole way: then its long
/// steps passed over something, such as an encounter on the way of a free particle, of which a sketch takes
/// six or seven steps.
bool Orbiter::was_blind(const Setting& setting) const {
  const bool quick = known_.sketch->time == known_.span && known_.sketch->samples.size() < 16;
  if (closely_ || !quick || question_.made || question_.options.h > 0.0) return false;
  return menu_.expected_steps(*setting.candidate, setting.h, known_.span) > 1000.0;
}

/// Begins anew with another sketch. @param closely with short steps @param also a state from which the sketch
/// goes on, if any
OrbitAnswer Orbiter::look_again(bool closely, std::optional<State<dynamic>> also) {
  Orbiter again(question_, budget_);
  again.closely_ = closely;
  again.also_ = std::move(also);
  again.answer_.choice.trials = std::move(answer_.choice.trials);
  return again.solve();
}

OrbitAnswer Orbiter::solve() {
  answer_.tolerance = question_.tolerance;
  answer_.q = question_.q, answer_.p = question_.p, answer_.t = question_.t;
  if (known_.span == 0.0) {
    require_energy(known_.field.energy(question_.q.data(), question_.p.data()), question_);
    return answer_;
  }
  std::ranges::fill(answer_.q, std::numeric_limits<double>::quiet_NaN());
  std::ranges::fill(answer_.p, std::numeric_limits<double>::quiet_NaN());
  if (!known_.late()) known_.make(closely_, also_);
  if (!known_.late()) menu_.write(answer_.choice);
  if (known_.late())
    return fail(Outcome::time_limit, "The bound on seconds was met while the run was prepared.");
  dead_end_ = known_.sketch->stuck ? known_.sketch->time : 0.0;
  const double since_zero = known_.distance->frequency * std::abs(question_.t);
  constexpr double most = 0.5 / std::numeric_limits<double>::epsilon();
  if (known_.radians > most) return too_far("The end, t = ", question_.t_end, known_.radians);
  if (since_zero > most) return too_far("The zero of time, seen from t = ", question_.t, since_zero);
  set_marks();
  answer_.choice.time = since_start(0);
  Setting setting{&menu_.all.front(), question_.options.h};
  if (!(setting.h > 0.0)) setting.h = affordable(menu_.all.front(), menu_.first_step(menu_.all.front()));
  while (pursue(setting)) {
    if (outrun_) {
      note_trial(*coarse_, infinity), note_trial(*fine_, seen_.error);
      return look_again(closely_, fine_->worst);
    }
    if (was_blind(setting)) return look_again(true, also_);
  }
  take_furthest();
  if (!fine_ || (!fine_->ok() && fine_->run.steps == 0)) return give_up();
  return finish();
}

OrbitAnswer choose(const OrbitQuestion& question, Budget& budget) {
  return Orbiter(question, budget).solve();
}

}  // namespace avi::detail
