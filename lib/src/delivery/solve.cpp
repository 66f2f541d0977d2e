#include "avi/solve.hpp"

#include "avi/core/require.hpp"
#include "src/autodiff/rounded_formula.hpp"
#include "src/choice/choose.hpp"
#include "src/delivery/delivery.hpp"
#include "src/features/barriers.hpp"
#include "src/features/kinks.hpp"
#include "src/features/switches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace avi::detail {

namespace {

void require_question(const OrbitQuestion& question) {
  const SolveOptions& options = question.options;
  require_finite("Time of the start", question.t);
  require(std::isfinite(question.t_end), "End time", question.t_end, "finite");
  require(question.tolerance >= 1e-13 && question.tolerance <= 1e-2, "Tolerance", question.tolerance,
          "in [1e-13, 1e-2]");
  require(options.seconds >= 0.0, "Bound on seconds", options.seconds, "at least 0");
  require(options.sweeps >= 1, "Bound on sweeps", options.sweeps, "at least 1");
  require(options.steps >= 1, "Bound on steps", options.steps, "at least 1");
  require(options.order == 0 || (options.order >= 2 && options.order <= 16 && options.order % 2 == 0),
          "Order", options.order, "even and in [2, 16], or 0 to have it chosen");
  const std::string& monitor = options.monitor.name;
  require(monitor.empty() || question.given >= 0 || is_monitor(monitor), "Monitor", monitor, "one of ",
          names_of_monitors());
  require(options.monitor.name != splitting || options.order == 0 || options.order == 6,
          "Order of the splitting", options.order, "6, or 0");
  require(std::isfinite(options.h) && options.h >= 0.0, "Fictive step h", options.h,
          "finite and positive, or 0 to have it chosen");
  require(options.h == 0.0 || !monitor.empty(), "Monitor", "not set", "set where h is: one of ",
          names_of_monitors());
  require(options.checkpoint_seconds >= 0.0, "Seconds between checkpoints", options.checkpoint_seconds,
          "at least 0");
  if (!options.checkpoint.empty()) require_regular(options.checkpoint);
}

/// Requires finite entries; the message names the one that is not, or says that it was not given.
void require_entries(const char* name, const std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i]))
      require(false, "At the start " + std::string(name) + "[" + std::to_string(i) + "]", x[i], "finite",
              std::isnan(x[i]) ? ", and what is not given is nan" : "");
}

}  // namespace

void require_times(double start, const std::vector<double>& times) {
  require(!times.empty(), "Number of output times", times.size(), "at least 1");
  require_finite("Time of the start", start);
  const bool back = times.back() < start;
  for (std::size_t i = 0; i < times.size(); ++i) {
    require_finite("Output time", times[i]);
    const double last = i == 0 ? start : times[i - 1];
    require(back ? times[i] <= last : times[i] >= last, "Output time", times[i],
            back ? "at most the one before it, " : "at least the one before it, ", last,
            i == 0 ? ", the start" : "");
  }
}

void require_arguments(int inputs, int n) {
  require(inputs == 2 * n || inputs == 2 * n + 1, "Number of arguments of H", inputs, "", 2 * n, ", or ",
          2 * n + 1, " where it depends on time");
}

void add_functions(OrbitQuestion& question) {
  const int n = static_cast<int>(question.q.size());
  SolveMonitor& monitor = question.options.monitor;
  if (monitor.g) {
    const Formula g = monitor.g(n);
    const int most = question.graph.inputs();
    require(g.inputs() == 2 * n || g.inputs() == most, "Number of arguments of the monitor", g.inputs(), "",
            2 * n, most == 2 * n ? ", or one more where H depends on time" : ", or one more for time");
    question.given = question.graph.substitute(g.graph(), g.node());
    monitor.g = {};
  }
  for (const SolveEvent& event : question.options.events) {
    if (!event.g) throw std::invalid_argument("An event has no function g; avi::when(g) makes one.");
    const EventRules& rules = event.rules;
    require(rules.direction >= -1 && rules.direction <= 1, "Direction of an event", rules.direction,
            "-1, 0 or 1");
    require(rules.count >= 0, "Count of an event", rules.count, "at least 0");
    Formula g = event.g(n);
    require(g.inputs() == 2 * n || g.inputs() == 2 * n + 1, "Number of arguments of an event", g.inputs(), "",
            2 * n, ", or ", 2 * n + 1, " where it depends on time");
    question.events.push_back({std::move(g), rules});
  }
  question.options.events.clear();
}

void no_curve() {
  throw std::logic_error(
      "The solution has no curve: it was made without SolveOptions::dense, or ended before the run that is "
      "delivered; it has states at the end and at output times only.");
}

namespace {

/// Finds the kinks and the barriers of H and, if time is a coordinate, the times in the run at which H
/// switches.
void find_breaks(OrbitQuestion& question) {
  if (question.timed)
    question.switches = Switches::of(question.graph, question.energy, question.t, question.t_end);
  question.kinks = Kinks::of(question.graph, question.energy, question.timed);
  question.barriers = Barriers::of(question.graph, question.energy);
}

/// The node of H without constants that are added to it, as its sum is written: the orbit does not depend on
/// them, but H - H_0 in a monitor has their rounding error.
int without_constants(ExpressionGraph& graph, int energy) {
  const auto is = [&](int node, Operation operation) { return graph[node].operation == operation; };
  std::vector<std::pair<Operation, int>> terms;  // from the last one to the second
  int first = energy;
  for (; is(first, Operation::add) || is(first, Operation::subtract); first = graph[first].a)
    terms.emplace_back(graph[first].operation, graph[first].b);
  if (is(first, Operation::constant) && !terms.empty() && terms.back().first == Operation::add) {
    first = terms.back().second;
    terms.pop_back();
  }
  int sum = first;
  for (; !terms.empty(); terms.pop_back())
    if (const auto [operation, term] = terms.back(); !is(term, Operation::constant))
      sum = graph.binary(operation, sum, term);
  return sum;
}

/// Makes time a coordinate if H depends on it. The energy is then H + p_t, which is zero along the orbit.
void extend(OrbitQuestion& question) {
  question.energy = without_constants(question.graph, question.energy);
  const int n = static_cast<int>(question.q.size());
  if (question.graph.inputs() == 2 * n) return find_breaks(question);
  ExpressionGraph graph(2 * n + 2);
  std::vector<int> places;
  std::vector<double> start = question.q;
  start.insert(start.end(), question.p.begin(), question.p.end());
  start.push_back(question.t);
  for (int i = 0; i < n; ++i)
    places.push_back(i);
  for (int i = 0; i < n; ++i)
    places.push_back(n + 1 + i);
  places.push_back(n);
  const double energy = RoundedFormula(question.graph, question.energy).rounded_once(start);
  const int node = graph.substitute(question.graph, question.energy, places);
  if (question.given >= 0) question.given = graph.substitute(question.graph, question.given, places);
  question.energy = graph.binary(Operation::add, node, 2 * n + 1);
  question.graph = std::move(graph);
  question.q.push_back(question.t);
  question.p.push_back(-energy);
  question.timed = true;
  find_breaks(question);
}

void tell_cancelled(const Budget& budget, OrbitAnswer& answer) {
  if (!budget.cancelled()) return;
  answer.run.outcome = Outcome::stopped;
  answer.run.message = "The run was stopped by the callback that is told of its progress.";
  answer.state_error = infinity;
}

/// Returns the time `factor` times as far from the start, or the end if that comes first.
double beyond(const OrbitQuestion& question, double time, double factor) {
  const double there = question.t + factor * (time - question.t), end = question.t_end;
  return end < question.t ? std::max(there, end) : std::min(there, end);
}

/// A call of solve() that delivers more than the state at the end.
class Call {
 public:
  /// @param replaces whether a checkpoint of an earlier call exists, which this one replaces
  Call(const OrbitQuestion& question, int degrees, Budget& budget, bool replaces = false)
      : question_(question), degrees_(degrees), budget_(budget), replaces_(replaces) {}

  OrbitAnswer make() {
    budget_.share = 0.5;
    return make_for(may_stop() && !question_.made ? scout() : question_.t_end);
  }
  /// Makes the answer, given the time at which the end, or an event that stops the run, is expected.
  OrbitAnswer make_for(double horizon) {
    OrbitAnswer failure;  // answer of the choice for the whole way, if it failed; later ones are for less
    int shortened = 0;
    for (int round = 0;; ++round) {
      (void)budget_.was_met();
      OrbitAnswer answer = chosen(horizon, question_.tolerance, question_.options.check);
      // A cancelled call that can be resumed goes on until its file is written.
      const bool ends = budget_.cancelled() && question_.options.checkpoint.empty();
      if (!(answer.choice.h > 0.0) || ends) return answer;
      const bool bounded = budget_.was_met() && !answer.ok();
      if (!answer.ok() && !repeats() && !bounded) {
        if (shortened == 0) failure = answer;
        horizon = before_failure(answer, horizon, shortened++);
        if (horizon == question_.t) return failure;
        spent_ += answer.choice.sweeps + answer.choice.check + answer.run.evaluations;
        continue;
      }
      budget_.share = 1.0;
      budget_.phase = SolvePhase::running;
      if (round == 60) horizon = question_.t_end;
      Plan plan{.horizon = horizon, .pause = beyond(question_, horizon, 1.2)};
      // With the same step, the delivered run cannot take many more steps than the one before.
      if (answer.ok() && !repeats()) plan.most = 3 * answer.run.steps + 1000;
      if (shortened > 0) {
        if (!may_stop()) plan.pause = horizon;
        plan.failure = failure.run.outcome, plan.message = failure.run.message;
      }
      const Run planned = answer.run;
      answer.choice.sweeps += spent_ + planned.evaluations;
      if (std::exchange(replaces_, false)) std::remove(question_.options.checkpoint.c_str());
      Delivery delivery(question_, degrees_, answer.choice, budget_, answer.prepared.get());
      delivery.follow(answer, plan);
      delivery.go();
      if (comes_later(delivery)) {
        spent_ += delivery.run().evaluations;
        budget_.sweeps += delivery.run().evaluations;
        horizon = beyond(question_, horizon, 2.0);
        event_ = question_.t;
        continue;
      }
      delivery.deliver(answer);
      const bool same = planned.outcome == delivery.run().outcome && planned.steps == delivery.run().steps;
      if (!answer.run.ok() && !planned.ok() && same) answer.run.message = planned.message;
      // The run that is delivered came to its end, but the bound kept another one from confirming it. With a
      // checkpoint, an outcome other than ok would say that there is something to resume.
      if (answer.run.ok() && bounded && question_.options.checkpoint.empty())
        answer.run.outcome = planned.outcome, answer.run.message = planned.message;
      return answer;
    }
  }
  /// Returns true if the event that ends the run comes later than in the first run.
  [[nodiscard]] bool comes_later(const Delivery& delivery) const {
    const Plan& plan = delivery.plan();
    return delivery.run().ok() && !delivery.arrived() && plan.failure == Outcome::ok &&
           plan.horizon != question_.t_end;
  }

 private:
  [[nodiscard]] bool may_stop() const {
    return std::ranges::any_of(question_.events, [](const OrbitEvent& event) { return event.rules.stop; });
  }
  /// Returns true if no run is made before the one that is delivered.
  [[nodiscard]] bool repeats() const { return question_.made && !question_.options.check; }
  /// Returns an earlier time for which a choice may succeed after one failed: that of the event before it or,
  /// with each further try, a smaller part of the way that was covered. Returns the start if nothing is to be
  /// delivered before that time.
  [[nodiscard]] double before_failure(const OrbitAnswer& answer, double horizon, int tries) const {
    if (tries == 0 && event_ != question_.t && sense_ * (event_ - horizon) < 0.0) return event_;
    constexpr std::array<double, 4> parts{0.99, 0.9, 0.6, 0.3};
    if (tries >= static_cast<int>(parts.size())) return question_.t;
    double reached = std::max(std::abs(answer.t - question_.t), sketched().time);
    for (const SolveTrial& trial : answer.choice.trials)
      reached = std::max(reached, trial.time);
    reached = std::min(reached, std::abs(horizon - question_.t)) * parts[static_cast<std::size_t>(tries)];
    if (question_.options.dense || !question_.events.empty()) return question_.t + sense_ * reached;
    double last = question_.t;
    for (const double t : question_.times)
      if (std::abs(t - question_.t) <= reached) last = t;
    return last;
  }
  /// Returns what is known about a run with an earlier choice before the run begins.
  [[nodiscard]] OrbitAnswer made() const {
    OrbitAnswer answer;
    answer.choice = *question_.made;
    answer.prepared = question_.prepared;
    answer.choice.trials.clear();
    answer.choice.sweeps = answer.choice.check = 0;
    answer.tolerance = question_.tolerance;
    answer.state_error = infinity;
    PointField field = field_of(question_);
    const double energy = field.energy(question_.q.data(), question_.p.data());
    require_energy(energy, question_);
    answer.energy_rounding =
        std::numeric_limits<double>::epsilon() * (std::abs(energy) / answer.choice.energy_scale + 1.0);
    return answer;
  }
  OrbitAnswer chosen(double end, double tolerance, bool check) {
    if (question_.made && !check) return made();
    OrbitQuestion question = question_;
    question.t_end = end;
    question.tolerance = tolerance;
    question.options.check = check;
    budget_.phase = SolvePhase::choosing;
    budget_.earlier += std::exchange(budget_.sweeps, 0);
    budget_.end = end;
    OrbitAnswer answer = choose(question, budget_);
    answer.tolerance = question_.tolerance;
    return answer;
  }
  [[nodiscard]] Sketch sketched() const {
    PointField field = field_of(question_);
    const VectorX z = stacked_start(question_);
    field.sense = sense_;
    return {field, z, std::abs(question_.t_end - question_.t), field.metric(z)};
  }
  /// Returns a time by which an event that ends the run should have come, found by a run of low accuracy. The
  /// accurate runs are chosen for the way to that time.
  double scout() {
    const double span = std::abs(question_.t_end - question_.t);
    const double first = question_.t + sense_ * std::min(span, sketched().time_of(20.0));
    const OrbitAnswer answer = chosen(first, std::max(question_.tolerance, 1e-4), false);
    if (!(answer.choice.h > 0.0)) return first;
    OrbitQuestion events = question_;
    events.times.clear();
    events.options.dense = false;
    events.options.checkpoint.clear();
    std::erase_if(events.events, [](const OrbitEvent& event) { return !event.rules.stop; });
    Delivery delivery(events, degrees_, answer.choice, budget_, answer.prepared.get());
    budget_.end = question_.t_end;
    delivery.go();
    spent_ += answer.choice.sweeps + answer.run.evaluations + delivery.run().evaluations;
    budget_.sweeps += delivery.run().evaluations;
    // A run that met a bound does not show where the event is, so the choice is made for the whole way.
    if (budget_.was_met()) return question_.t_end;
    const double reached = delivery.state().t;  // the start if the first step failed
    if (delivery.run().ok()) event_ = reached;
    return reached == question_.t ? first : beyond(question_, reached, 1.02);
  }

  const OrbitQuestion& question_;
  int degrees_;
  Budget& budget_;
  bool replaces_;
  long spent_ = 0;  // sweeps of runs that served only to find the horizon
  double sense_ = question_.t_end < question_.t ? -1.0 : 1.0;
  double event_ = question_.t;  // time of the event that ended the first run, or the start
};

/// The curve of a solution that ends at its start: a single point.
class Point final : public OrbitCurve {
 public:
  explicit Point(const OrbitAnswer& answer) : times_{answer.t}, z_(answer.q) {
    z_.insert(z_.end(), answer.p.begin(), answer.p.end());
  }
  void at(double t, double* z) const override {
    require(t == times_[0], "Time of a solution", t, "that of the run, ", times_[0]);
    std::ranges::copy(z_, z);
  }
  [[nodiscard]] const std::vector<double>& times() const override { return times_; }

 private:
  std::vector<double> times_, z_;
};

}  // namespace

OrbitAnswer answer(OrbitQuestion&& question) {
  require_question(question);
  require_entries("q", question.q), require_entries("p", question.p);
  const int degrees = static_cast<int>(question.q.size());
  extend(question);
  const std::vector<double>& times = question.times;
  const bool end_alone = times.empty() || (times.size() == 1 && times[0] == question.t_end);
  if (question.made) {
    question.options.monitor.name = question.made->name;
    question.options.order = question.made->order;
    question.options.h = question.made->h;
  }
  const bool more = !end_alone || !question.events.empty() || question.options.dense ||
                    !question.options.checkpoint.empty() || (question.made && !question.options.check);
  const bool replaces = is_kept(question.options.checkpoint);
  Budget budget(question.options);
  budget.start = question.t, budget.end = question.t_end;
  OrbitAnswer answer = more && question.t_end != question.t ? Call(question, degrees, budget, replaces).make()
                                                            : choose(question, budget);
  answer.q.resize(static_cast<std::size_t>(degrees)), answer.p.resize(static_cast<std::size_t>(degrees));
  if ((!more || question.t_end == question.t) && answer.ok())
    for (const double t : times) {
      answer.states.t.push_back(t);
      answer.states.z.insert(answer.states.z.end(), answer.q.begin(), answer.q.end());
      answer.states.z.insert(answer.states.z.end(), answer.p.begin(), answer.p.end());
    }
  if (replaces && question.t_end == question.t) std::remove(question.options.checkpoint.c_str());
  if (question.options.dense && question.t_end == question.t) answer.curve = std::make_shared<Point>(answer);
  tell_cancelled(budget, answer);
  return answer;
}

OrbitAnswer answer_from(const std::string& file, OrbitQuestion&& question) {
  Record record(file);
  const auto degrees = static_cast<std::size_t>(question.q.size());
  extend(question);
  const std::size_t size = question.q.size();
  const std::uint64_t its = question_in(record, question);
  if (question.q.size() != size || question.p.size() != size || its != fingerprint(question))
    throw std::invalid_argument("The checkpoint " + file +
                                " is of another H, of other events, or of another dimension.");
  question.options.checkpoint = file;
  require_question(question);
  find_breaks(question);
  OrbitAnswer answer;
  const Choice choice = choice_in(record, answer);
  if (question.given < 0 && !is_monitor(choice.name))
    throw std::invalid_argument("The checkpoint " + file + " has an unknown monitor.");
  answer.tolerance = question.tolerance;
  Budget budget(question.options);
  budget.phase = SolvePhase::running;
  budget.start = question.t, budget.end = question.t_end;
  Delivery delivery(question, static_cast<int>(degrees), choice, budget, nullptr);
  delivery.restore(record, answer);
  delivery.go();
  Call call(question, static_cast<int>(degrees), budget);
  if (call.comes_later(delivery))  // as in a run that was not interrupted
    return call.make_for(beyond(question, delivery.plan().horizon, 2.0));
  delivery.deliver(answer);
  tell_cancelled(budget, answer);
  return answer;
}

SolutionReport choose_for(OrbitQuestion& question) {
  OrbitQuestion sample = question;
  sample.events.clear();
  sample.options.dense = false;
  sample.options.checkpoint.clear();
  OrbitAnswer report = answer(OrbitQuestion(sample));
  if (!(report.choice.h > 0.0))
    throw std::invalid_argument(
        "Nothing could be chosen for the orbit of the Solver: " +
        (report.run.message.empty() ? "it ends where it starts." : report.run.message));
  question.made = std::make_shared<const Choice>(report.choice);
  if (report.prepared) {
    extend(sample);
    question.prepared = std::make_shared<const Prepared>(
        Prepared{report.prepared->field, formulas_of(report.choice, sample)});
  }
  return SolutionReport(std::move(report));
}

}  // namespace avi::detail
