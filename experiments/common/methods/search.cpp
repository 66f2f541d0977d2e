#include "common/methods/search.hpp"

#include "common/methods/phase.hpp"

#include <algorithm>
#include <utility>

namespace experiment {

std::string Attempt::ending() const {
  if (run.outcome == avi::Outcome::stopped) return "energy";
  return run.outcome == avi::Outcome::ok && late ? "phase" : std::string(avi::name(run.outcome));
}

Attempt attempt(const Method2& runner, const State2& start, double h, const Limits& limits) {
  Attempt made{.run = {}, .end = start};
  const double first = runner.energy(start);
  avi::AnyMethod<2> method = runner.make(start);
  made.run = avi::integrate(method, made.end, h, {.time = limits.time, .steps = limits.steps},
                            [&](const State2& z, long) {
                              const double error = std::abs((runner.energy(z) - first) / first);
                              if (!(error <= made.energy_error)) made.energy_error = error;
                              return error <= limits.energy_error;
                            });
  made.late =
      std::isfinite(limits.phase_error) && !(std::abs(phase_error(start, made.end)) <= limits.phase_error);
  return made;
}

Largest largest_step(const Method2& runner, const State2& start, double coarse, const Limits& limits,
                     double precision) {
  Largest found;
  for (double h = coarse;; h *= 0.5) {
    Attempt made = attempt(runner, start, h, limits);
    if (made.good()) {
      found.h = h;
      found.at = std::move(made);
      break;
    }
    found.h_beyond = h;
    found.beyond = std::move(made);
    if (found.beyond.run.outcome == avi::Outcome::step_limit || h < coarse * 1e-15) return found;
  }
  if (std::isnan(found.h_beyond)) return found;
  while (found.h_beyond > (1.0 + precision) * found.h) {
    const double h = std::sqrt(found.h * found.h_beyond);
    Attempt made = attempt(runner, start, h, limits);
    (made.good() ? found.h : found.h_beyond) = h;
    (found.h == h ? found.at : found.beyond) = std::move(made);
  }
  return found;
}

double matched_step(const std::function<double(double h)>& error, double target, double h,
                    const Match& match) {
  double best = std::nan(""), distance = HUGE_VAL, below = best, above = best;
  for (int k = 0; k < match.tries; ++k) {
    const double ratio = error(h) / target;
    if (std::isnan(ratio)) return std::nan("");
    (ratio > 1.0 ? above : below) = h;
    if (ratio > match.too_coarse) {
      h *= 0.5;
    } else {
      const double off = std::abs(std::log(ratio));
      if (off < distance) distance = off, best = h;
      if (off < match.within) break;
      h *= std::min(std::pow(ratio, -1.0 / match.order), match.longest);
    }
    // Where the error grows much faster than its order, as near the limit of stability, the correction would
    // jump from one side of the target to the other for ever.
    if (!(h > std::min(below, above) && h < std::max(below, above)) && std::isfinite(below * above))
      h = std::sqrt(below * above);
  }
  return best;
}

}  // namespace experiment
