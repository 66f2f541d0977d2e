#include "src/delivery/delivery.hpp"

#include "src/choice/choose.hpp"
#include "src/delivery/track.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace avi::detail {

namespace {

/// Number of steps after which a run that is kept restarts its method. The method remembers earlier steps,
/// and that memory is not kept: so a resumed run has the same bits as one that was not interrupted.
constexpr long block = 4096;

/// Number of steps before which no run is given up.
constexpr long least_steps = 16384;

State<dynamic> start_of(const OrbitQuestion& question) {
  return state_of<dynamic>(question.t, question.q.data(), question.p.data(),
                           static_cast<int>(question.q.size()));
}

}  // namespace

Delivery::Delivery(const OrbitQuestion& question, int degrees, const Choice& choice, Budget& budget,
                   const Prepared* prepared)
    : question_(question), degrees_(degrees), budget_(budget),
      field_(prepared ? prepared->field : PointField(question.graph, question.energy, question.gradient)),
      energy_at_start_(energy_at_start(question)),
      candidate_(candidate_of(choice.name, question, energy_at_start_, choice, prepared)), choice_(choice),
      sense_(question.t_end < question.t ? -1.0 : 1.0), h_(sense_ * choice.h),
      state_(start_of(question)), plan_{.horizon = question.t_end, .pause = question.t_end} {
  pace_.time = question.t;
  for (std::size_t i = 0; i < question.events.size(); ++i)
    watches_.emplace_back(question.events[i], degrees, i);
  candidate_.supplied = question.gradient, candidate_.switches = question.switches,
  candidate_.kinks = question.kinks;
  steps_ = method();
  if (question.options.dense) track_ = std::make_shared<Track>(method(), candidate_, field_, h_, degrees_);
  for (; next_ < question.times.size() && question.times[next_] == question.t; ++next_)
    add(states_, state_, question.t);
}

void Delivery::add(OrbitPoints& points, const State<dynamic>& z, double t) const {
  points.t.push_back(t);
  points.z.insert(points.z.end(), z.q.data(), z.q.data() + degrees_);
  points.z.insert(points.z.end(), z.p.data(), z.p.data() + degrees_);
}

void Delivery::look_at_energy(const State<dynamic>& z) {
  const double energy = field_.energy(z.q.data(), z.p.data());
  if (std::isnan(energy)) run_.outcome = Outcome::non_finite;
  energy_error_ = std::max(energy_error_, std::abs(energy - energy_at_start_) / choice_.energy_scale);
}

/// Gives up a run whose monitor makes steps ever shorter before a singularity, which it never passes: each
/// time, twice the steps add less to the time, which then has a limit. This does not apply where a run is
/// known that came further, nor with a user's own monitor, which may be what makes the steps short.
void Delivery::look_at_pace() {
  const bool known = plan_.most < std::numeric_limits<long>::max();
  if (known || question_.given >= 0 || run_.steps < 2 * pace_.steps) return;
  const double gain = std::abs(state_.t - pace_.time);
  const int fading = gain < 0.9 * pace_.gained ? pace_.fading + 1 : 0;
  pace_ = {run_.steps, state_.t, gain, fading};
  if (run_.steps < least_steps || fading < 4) return;
  std::ostringstream text;
  text << "The run was given up near t = " << state_.t << ", after " << run_.steps
       << " steps, which become shorter all the time: the orbit meets a singularity of H, or comes too near "
          "one.";
  run_.outcome = Outcome::step_limit;
  run_.message = text.str();
}

void Delivery::go() {
  const bool kept = !question_.options.checkpoint.empty();
  while (run_.ok() && !arrived() && run_.steps < plan_.most && sense_ * (state_.t - plan_.pause) < 0.0) {
    if (kept && run_.steps % block == 0) begin_block();
    step();
  }
  if (!run_.ok() && run_.message.empty()) {
    State<dynamic> there = state_;
    there.q.conservativeResize(degrees_), there.p.conservativeResize(degrees_);
    run_.message = describe_end(run_.outcome, there, run_.steps, 0.0,
                                run_.outcome == Outcome::not_converged && reason_.empty()
                                    ? "the equations of a step were not solved"
                                    : reason_);
  }
  if (!kept) return;
  if (run_.ok() && arrived())
    std::remove(question_.options.checkpoint.c_str());
  else if (!written_)
    write();
}

void Delivery::begin_block() {
  steps_ = method();
  block_ = {.state = state_,
            .steps = run_.steps,
            .evaluations = run_.evaluations,
            .energy_error = energy_error_,
            .next = next_,
            .states = states_.t.size(),
            .events = events_.size(),
            .track = track_ ? track_->times().size() : 0,
            .watches = {},
            .pace = pace_};
  for (Watch& watch : watches_)
    block_.watches.push_back(watch.memory());
  written_ = false;
  if (budget_.seconds() >= due_) write();
}

void Delivery::write() {
  Record record;
  const auto put = [&](const auto&... each) { (record.put(each), ...); };
  put(fingerprint(question_), question_.q, question_.p, question_.t, question_.t_end, question_.tolerance,
      question_.times, question_.options.dense);
  const SolveOptions& asked = question_.options;  // if another choice has to be made
  put(asked.order, asked.monitor.name, asked.h, asked.check);
  put(choice_.name, choice_.order, choice_.h, choice_.energy_scale, choice_.kinetic, choice_.accelerations,
      choice_.poles, choice_.drifts, choice_.solved, choice_.time, report_.choice.sweeps,
      report_.choice.check);
  put(report_.state_error, report_.energy_rounding, report_.note);
  put(plan_.horizon, plan_.pause, plan_.most, static_cast<int>(plan_.failure), plan_.message);
  const State<dynamic>& z = block_.state;
  put(std::vector<double>(z.q.begin(), z.q.end()), std::vector<double>(z.p.begin(), z.p.end()), z.t,
      block_.steps, block_.evaluations, block_.energy_error, block_.next);
  put(block_.pace.steps, block_.pace.time, block_.pace.gained, block_.pace.fading);
  const std::size_t entries = 2 * static_cast<std::size_t>(degrees_);
  record.put(states_.t, block_.states), record.put(states_.z, block_.states * entries);
  record.put(events_, block_.events);
  record.put(event_states_.t, block_.events), record.put(event_states_.z, block_.events * entries);
  for (const Watch::Memory& it : block_.watches)
    put(it.found, it.level, it.leaving);
  if (track_) track_->put(record, block_.track);
  record.write(question_.options.checkpoint);
  written_ = true;
  due_ = budget_.seconds() + question_.options.checkpoint_seconds;
}

void Delivery::follow(const SolutionReport& report, Plan plan) {
  report_ = report;
  plan_ = std::move(plan);
}

Choice choice_in(Record& record, SolutionReport& report) {
  Choice& choice = report.choice;
  const auto get = [&](auto&... each) { (record.get(each), ...); };
  get(choice.name, choice.order, choice.h, choice.energy_scale, choice.kinetic, choice.accelerations,
      choice.poles, choice.drifts, choice.solved, choice.time, choice.sweeps, choice.check);
  get(report.state_error, report.energy_rounding, report.note);
  return choice;
}

std::uint64_t question_in(Record& record, OrbitQuestion& question) {
  std::uint64_t of_file = 0;
  SolveOptions& asked = question.options;
  const auto get = [&](auto&... each) { (record.get(each), ...); };
  get(of_file, question.q, question.p, question.t, question.t_end, question.tolerance, question.times,
      asked.dense, asked.order, asked.monitor.name, asked.h, asked.check);
  return of_file;
}

void Delivery::restore(Record& record, const SolutionReport& report) {
  report_ = report;
  const auto get = [&](auto&... each) { (record.get(each), ...); };
  int failure = 0;
  get(plan_.horizon, plan_.pause, plan_.most, failure, plan_.message);
  plan_.failure = static_cast<Outcome>(failure);
  std::vector<double> q, p;
  get(q, p, state_.t, run_.steps, run_.evaluations, energy_error_, next_);
  get(pace_.steps, pace_.time, pace_.gained, pace_.fading);
  get(states_.t, states_.z, events_, event_states_.t, event_states_.z);
  std::ranges::copy(q, state_.q.data());
  std::ranges::copy(p, state_.p.data());
  for (Watch& watch : watches_) {
    Watch::Memory& it = watch.memory();
    get(it.found, it.level, it.leaving);
  }
  if (track_) track_->get(record);
}

void Delivery::step() {
  const double end = question_.t_end;
  const State<dynamic> before = state_;
  State<dynamic> after = before;
  spend(steps_->step(after, h_));
  if (run_.ok() && !after.finite()) run_.outcome = Outcome::non_finite;
  if (run_.ok() && !(sense_ * (after.t - before.t) > 0.0)) run_.outcome = Outcome::stalled;
  if (!run_.ok()) return;
  State<dynamic> last = after;
  double part = 1.0;
  if (sense_ * (after.t - end) > 0.0) {
    double size = 0.0;
    spend(land(*steps_->clone(), candidate_, field_, before, steps_->size(), after.t, end, last, &size));
    if (!run_.ok()) return;
    part = size / steps_->size();
  }
  const Stride stride{*steps_, before, last, steps_->size(), part};
  if (!watches_.empty()) find_events(stride, last);
  if (run_.ok()) find_outputs(before, after, last);
  if (!run_.ok()) return;
  if (track_) track_->add(before, last);
  state_ = last;
  ++run_.steps;
  if (!arrived() || !steps_->is_at_switch(state_.t)) look_at_energy(state_);
  if (arrived()) return;
  run_.outcome = budget_.met(state_.t, run_.steps, run_.evaluations);
  if (run_.ok()) look_at_pace();
}

/// Finds the events of a step up to the first one that ends the run; its state becomes the end of the step.
void Delivery::find_events(const Stride& stride, State<dynamic>& last) {
  std::vector<Hit> hits;
  for (Watch& watch : watches_)
    run_.evaluations += watch.look(stride, run_.steps == 0, hits);
  std::ranges::stable_sort(hits, {}, [&](const Hit& hit) { return sense_ * hit.state.t; });
  for (const Hit& hit : hits) {
    if (hit.outcome != Outcome::ok) {
      run_.outcome = hit.outcome;
      reason_ = hit.reason;
      return;
    }
    if (watches_[hit.index].over()) continue;
    events_.push_back(static_cast<int>(hit.index));
    add(event_states_, hit.state, hit.state.t);
    if (watches_[hit.index].take()) {
      last = hit.state;
      by_event_ = true;
      return;
    }
  }
}

void Delivery::find_outputs(const State<dynamic>& before, const State<dynamic>& after,
                            const State<dynamic>& last) {
  const std::vector<double>& times = question_.times;
  for (; next_ < times.size() && sense_ * (times[next_] - last.t) <= 0.0; ++next_) {
    const double t = times[next_];
    if (next_ > 0 && t == times[next_ - 1]) {
      const std::vector<double> again(states_.z.end() - 2 * degrees_, states_.z.end());
      states_.t.push_back(t);
      states_.z.insert(states_.z.end(), again.begin(), again.end());
    } else if (t == last.t) {
      add(states_, last, t);
    } else {
      State<dynamic> there;
      spend(land(*steps_->clone(), candidate_, field_, before, steps_->size(), after.t, t, there));
      if (!run_.ok()) return;
      add(states_, there, t);
    }
  }
}

void Delivery::deliver(OrbitAnswer& answer) const {
  answer.run = run_;
  answer.q.assign(state_.q.data(), state_.q.data() + degrees_);
  answer.p.assign(state_.p.data(), state_.p.data() + degrees_);
  answer.t = state_.t;
  answer.energy_error = energy_error_;
  answer.states = states_;
  answer.events = events_;
  answer.event_states = event_states_;
  if (track_ && !track_->times().empty()) answer.curve = track_;
  if (run_.ok() && !arrived()) {
    const bool failed = plan_.failure != Outcome::ok;
    answer.run.outcome = failed ? plan_.failure : Outcome::step_limit;
    answer.run.message = failed ? plan_.message
                                : "The run was given up: it takes several times the steps of the run that it "
                                  "repeats.";
  }
  if (!answer.run.ok()) answer.state_error = infinity;
  if (!by_event_) return;
  std::ostringstream text;
  text << (answer.note.empty() ? "" : " ") << "Event " << events_.back()
       << " ended the run at t = " << state_.t << ".";
  answer.note += text.str();
}

}  // namespace avi::detail
