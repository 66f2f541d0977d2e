#pragma once
#include "avi/core/integrate.hpp"
#include "avi/core/root.hpp"

#include <algorithm>
#include <cmath>
#include <string>

/// @file
/// States at requested physical times.

namespace avi {

/// Ends a run exactly at t_end: advances with step h while t < t_end, then repeats the last step with the
/// smaller fictive step whose physical one ends at t_end, found by the secant method with bisection as its
/// safeguard. Every step, the last one included, is a step of the method and so symplectic. `observer` as in
/// integrate(): where it returns bool, false stops the run.
/// @throws std::invalid_argument as integrate(), or unless h > 0 and t_end >= state.t.
template <class State, class M, class Observer = NoObserver>
Run integrate_to(M& method, State& state, double h, double t_end, Observer&& observer = {}) {
  require_positive("Step size h", h);
  require(std::isfinite(t_end) && t_end >= state.t, "End time", t_end, "finite and not before the start");
  State before = state;
  long steps = 0;
  Run run = integrate(method, state, h, {.time = t_end}, [&](const State& z, long k) {
    if (z.t >= t_end) return true;  // not shown: it will be repeated
    before = z;
    steps = k;
    return detail::goes_on(observer, z, k);
  });
  if (run.outcome != Outcome::ok || run.steps == 0) return run;
  const double miss = state.t - t_end;
  if (miss > 0.0) {
    State landed = state;
    StepReport report;
    bracketed_root(
        [&](double step_size) {
          landed = before;
          report = method.step(landed, step_size);
          run.evaluations += report.evaluations;
          return report.outcome == Outcome::ok ? landed.t - t_end : std::nan("");
        },
        0.0, before.t - t_end, h, miss, 4e-16 * std::max(1.0, std::abs(t_end)));
    if (report.outcome != Outcome::ok) {
      state = before;
      run.steps = steps;
      run.outcome = report.outcome;
      run.message = detail::describe_end(run.outcome, state, run.steps, report.residual);
      return run;
    }
    state = landed;
  }
  if (!detail::goes_on(observer, state, run.steps)) {
    run.outcome = Outcome::stopped;
    run.message = detail::describe_end(run.outcome, state, run.steps, 0.0);
  }
  return run;
}

/// Dense output: the state at physical time t inside the last step of an HTVI, from the Taylor polynomial of
/// that step about its own expansion point. Its error is O(h^(r+1)); nothing is evaluated and the run is not
/// touched.
///
/// @param method one that has just stepped from time `t_before` @param t between the two ends of that step
/// @throws std::invalid_argument when t lies outside the step.
template <class HtviMethod>
auto dense_output(const HtviMethod& method, double t_before, double t) {
  const double t_after = method.polynomial(1.0, t_before).t;
  const double slack = 1e-9 * std::abs(t_after - t_before);
  require(t >= t_before - slack && t <= t_after + slack, "Time of dense output", t,
          "in the last step, [" + std::to_string(t_before) + ", " + std::to_string(t_after) + "]");
  double c = t <= t_before ? 0.0 : 1.0;
  if (t > t_before && t < t_after)
    c = bracketed_root([&](double x) { return method.polynomial(x, t_before).t - t; }, 0.0, t_before - t, 1.0,
                       t_after - t, 2e-16 * std::abs(t));
  auto z = method.polynomial(c, t_before);
  z.t = t;  // the clock of the expansion is off by rounding
  return z;
}

}  // namespace avi
