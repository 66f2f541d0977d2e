#include "common/methods/attempt.hpp"

#include <algorithm>

namespace experiment {

std::string Attempt::ending() const {
  if (run.outcome == avi::Outcome::stopped) return "energy";
  return run.outcome == avi::Outcome::ok && late ? "phase" : std::string(avi::name(run.outcome));
}

Attempt attempt(const Runner& runner, const State2& start, double h, const Limits& limits) {
  Attempt made{.run = {}, .end = start};
  const double first = runner.energy(start);
  double before = start.t, step = HUGE_VAL;
  made.run =
      runner.advance(start, made.end, h, {.time = limits.time, .steps = limits.steps}, [&](const State2& z) {
        made.least_step = std::min(made.least_step, step);
        step = z.t - before;
        before = z.t;
        const double error = std::abs((runner.energy(z) - first) / first);
        if (!(error <= made.energy_error)) made.energy_error = error;
        return error <= limits.energy_error;
      });
  made.late =
      std::isfinite(limits.phase_error) && !(std::abs(phase_error(start, made.end)) <= limits.phase_error);
  return made;
}

}  // namespace experiment
