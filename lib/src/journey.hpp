#pragma once
#include "avi/core/integrate_to.hpp"
#include "avi/solve.hpp"
#include "candidates.hpp"
#include "sharp.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

/// @file
/// Runs of a candidate, and how far apart two of them end.

namespace avi::detail {

/// What is the same for all runs along an orbit.
struct Trip {
  const ExpressionGraph& graph;       ///< Of (q, p).
  int energy;                         ///< Node of H.
  State<dynamic> start;               ///< Where it begins.
  double energy_at_start;             ///< H_0.
  double energy_scale;                ///< Of energy errors.
  double sense;                       ///< 1, or -1 where the end lies before the start.
  SolveOptions options;               ///< Bounds.
  SharpFeatures* features = nullptr;  ///< Looked for, if there are any.
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();  ///< Of the call.
  long sweeps = 0;                                                                 ///< Spent so far.

  /// The bound of the call that is met, or ok. @param now sweeps of the run that is under way
  [[nodiscard]] Outcome bound(long now) const {
    if (sweeps + now >= options.sweeps) return Outcome::step_limit;
    const bool late =
        std::isfinite(options.seconds) &&
        std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() >= options.seconds;
    return late ? Outcome::time_limit : Outcome::ok;
  }
};

/// The smallest and largest value of every entry of (q, p) on the way.
struct Ranges {
  VectorX low, high;  ///< 2n entries each.

  /// Begins with a state.
  explicit Ranges(const State<dynamic>& z) : low(2 * z.q.size()), high(low.size()) {
    low << z.q, z.p;
    high = low;
  }
  /// Takes in another one.
  void add(const State<dynamic>& z) {
    const Eigen::Index n = z.q.size();
    for (Eigen::Index i = 0; i < n; ++i) {
      low[i] = std::min(low[i], z.q[i]), high[i] = std::max(high[i], z.q[i]);
      low[n + i] = std::min(low[n + i], z.p[i]), high[n + i] = std::max(high[n + i], z.p[i]);
    }
  }
};

/// A run that was made, and what was seen on it.
struct Journey {
  Candidate* candidate = nullptr;     ///< Its monitor.
  int order = 0;                      ///< Of its method.
  double h = 0.0;                     ///< Fictive step, positive.
  Run run;                            ///< How it ended.
  State<dynamic> state;               ///< Where it ended.
  std::vector<State<dynamic>> marks;  ///< At the times asked for, as far as it came.
  Ranges ranges;                      ///< Of all states.
  double energy_error = 0.0;          ///< Largest |H - H_0| over the scale.
  bool spent = false;                 ///< It met a bound of the call.
  bool jumped = false;                ///< A step went over a feature of H that it did not see.

  /// At the start of a trip.
  explicit Journey(const State<dynamic>& start) : state(start), ranges(start) {}
  /// It reached its end.
  [[nodiscard]] bool ok() const { return run.outcome == Outcome::ok; }
};

/// The state at the time t, of a step from `before` that passes it: by shorter steps of `method` from there,
/// found by Newton's method for dt/dtau = g, and a straight line for the last 1e-9 of the step.
/// @return outcome of the last step
inline StepReport land(OrbitSteps& method, Candidate& candidate, PointField& field,
                       const State<dynamic>& before, double h, double after, double t, State<dynamic>& z) {
  StepReport report{.evaluations = 0};
  double size = h * (t - before.t) / (after - before.t);
  z = before;
  VectorX at(2 * z.q.size()), slope(2 * z.q.size());
  for (int k = 0; k < 12 && size != 0.0; ++k) {
    z = before;
    const StepReport step = method.step(z, size);
    report.outcome = step.outcome;
    report.evaluations += step.evaluations;
    if (step.outcome != Outcome::ok) return report;
    at << z.q, z.p;
    if (std::abs(t - z.t) <= 1e-9 * std::abs(after - before.t)) break;
    const double next = size + (t - z.t) / candidate.rate(at.data());
    size = next / h > 0.0 && next / h < 1.0 ? next : size * (t - before.t) / (z.t - before.t);
  }
  const Eigen::Index n = z.q.size();
  at << z.q, z.p;
  field(at, slope);
  const double late = t - z.t;
  z.q += late * slope.head(n);
  z.p += late * slope.tail(n);
  z.t = t;
  if (!z.finite()) report.outcome = Outcome::non_finite;
  return report;
}

/// Makes a run with step h to the time `end`, where its last, shorter step ends.
/// @param marks times on the way where the state is wanted, the last of which may be the end
/// @param judge called as judge(journey) after each step; false ends the run as stopped
template <class Judge>
Journey travel(Trip& trip, PointField& field, Candidate& candidate, int order, double h, double end,
               const std::vector<double>& marks, const Judge& judge) {
  Journey journey(trip.start);
  journey.candidate = &candidate;
  journey.order = order;
  journey.h = h;
  auto& method = candidate.solver(order);
  State<dynamic>& z = journey.state;
  Run& run = journey.run;
  const double sense = trip.sense;
  const auto energy_error = [&] {
    return std::abs(field.energy(z.q.data(), z.p.data()) - trip.energy_at_start) / trip.energy_scale;
  };
  State<dynamic> before = z;
  std::size_t next = 0;
  while (run.outcome == Outcome::ok && z.t != end) {
    before = z;
    const StepReport report = method.step(z, sense * h);
    run.outcome = report.outcome;
    run.evaluations += report.evaluations;
    if (run.outcome == Outcome::ok && !z.finite()) run.outcome = Outcome::non_finite;
    if (run.outcome == Outcome::ok && !(sense * (z.t - before.t) > 0.0)) run.outcome = Outcome::stalled;
    if (run.outcome == Outcome::ok && trip.features && !journey.jumped)
      journey.jumped = trip.features->jumped(method, before, z);
    const double after = z.t;
    for (; run.outcome == Outcome::ok && next < marks.size() && sense * (marks[next] - after) <= 0.0 &&
           marks[next] != end;
         ++next) {
      State<dynamic> there;
      const StepReport landed =
          land(candidate.beside(order), candidate, field, before, sense * h, after, marks[next], there);
      run.outcome = landed.outcome;
      run.evaluations += landed.evaluations;
      journey.marks.push_back(std::move(there));
    }
    if (run.outcome == Outcome::ok && sense * (after - end) > 0.0) {
      const StepReport landed = land(method, candidate, field, before, sense * h, after, end, z);
      run.outcome = landed.outcome;
      run.evaluations += landed.evaluations;
    }
    if (run.outcome != Outcome::ok) {
      z = before;
      break;
    }
    ++run.steps;
    journey.ranges.add(z);
    journey.energy_error = std::max(journey.energy_error, energy_error());
    if (const Outcome bound = trip.bound(run.evaluations); bound != Outcome::ok) {
      run.outcome = bound;
      journey.spent = true;
    } else if (!judge(journey)) {
      run.outcome = Outcome::stopped;
    }
  }
  if (journey.ok() && next < marks.size() && marks[next] == end) journey.marks.push_back(z);
  trip.sweeps += run.evaluations;
  return journey;
}

}  // namespace avi::detail
