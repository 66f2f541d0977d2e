#include "avi/core/require.hpp"
#include "orbiter.hpp"

#include <cmath>

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

void add_events(OrbitQuestion& question) {
  const int n = static_cast<int>(question.q.size());
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
  throw std::logic_error("The solution was made without SolveOptions::dense; it has states at the end and at "
                         "output times only.");
}

OrbitAnswer answer(const OrbitQuestion& question) {
  require_question(question);
  return choose(question);
}

}  // namespace avi::detail
