#pragma once
#include "avi/core/integrate.hpp"
#include "avi/core/state.hpp"

#include <cmath>
#include <functional>
#include <string>

/// @file
/// A run that may fail, of a method whose type nobody needs to know.

namespace experiment {

using State2 = avi::State<2>;

/// How far a run goes, and what it must not exceed on the way.
struct Limits {
  double time;
  long steps;
  double energy_error;  ///< |H - H_0| / |H_0| beyond which the run is given up.
};

/// How a run ended.
struct Attempt {
  avi::Run run;
  State2 end;                                ///< The last good state.
  double energy_error = 0.0;                 ///< Largest |H - H_0| / |H_0| after any step.
  double least_step = 0.0, most_step = 0.0;  ///< In physical time, the last step left out.

  /// Reached the end within every bound.
  [[nodiscard]] bool good() const { return run.outcome == avi::Outcome::ok && !late; }
  bool late = false;  ///< Reached it, but elsewhere on its orbit; set by who knows the orbit.

  /// `ok`, `energy` or `phase` where that bound was exceeded, else the outcome's name.
  [[nodiscard]] std::string ending() const {
    if (run.outcome == avi::Outcome::stopped) return "energy";
    return run.outcome == avi::Outcome::ok && late ? "phase" : std::string(avi::name(run.outcome));
  }
};

/// A whole run from `start` with step h.
using Runner = std::function<Attempt(const State2& start, double h, const Limits&)>;

/// Runner of make(start), a Method, watching H.
template <class H, class Make>
Runner runner(const H& hamiltonian, Make make) {
  return [=](const State2& start, double h, const Limits& limits) {
    auto method = make(start);
    Attempt attempt{.run = {}, .end = start, .least_step = HUGE_VAL};
    const double energy = hamiltonian(start.q, start.p);
    double before = start.t, step = 0.0;
    attempt.run = avi::integrate(method, attempt.end, h, {.time = limits.time, .steps = limits.steps},
                                 [&](const State2& z, long k) {
                                   const double error = std::abs((hamiltonian(z.q, z.p) - energy) / energy);
                                   if (k > 1) {
                                     attempt.least_step = std::min(attempt.least_step, step);
                                     attempt.most_step = std::max(attempt.most_step, step);
                                   }
                                   step = z.t - before;
                                   before = z.t;
                                   if (!(error <= attempt.energy_error)) attempt.energy_error = error;
                                   return error <= limits.energy_error;
                                 });
    return attempt;
  };
}

}  // namespace experiment
