#pragma once
#include "avi/diagnostics/drift.hpp"
#include "beyond/speed/automatic_monitors/cost.hpp"
#include "common/frame.hpp"

#include <algorithm>

// The measured drift of the energy with the choices of solve().

namespace experiment {

/// The energy errors of a long run, after each step.
struct Series {
  std::vector<double> times, errors;
  avi::Run run;
  double worst_first = 0.0, worst_last = 0.0;  ///< Largest error in the first and the last tenth.
  /// Half a unit in the last place of the largest kinetic energy, times the number of steps.
  double rounding = 0.0;
};
inline Series follow(const Scene& scene, const avi::Choice& choice, double end) {
  Series series;
  auto method =
      avi::collocation(poincare(scene.energy, scene.start, monitor_of(scene, choice)), choice.order);
  Point z = scene.start;
  const double h0 = scene.energy(scene.start.q, scene.start.p);
  double largest = 0.0;
  series.run = integrate(method, z, choice.h, {.time = end, .steps = 20'000'000}, [&](const Point& at, long) {
    const double error = (scene.energy(at.q, at.p) - h0) / choice.energy_scale;
    if (at.t < 0.1 * end) series.worst_first = std::max(series.worst_first, std::abs(error));
    if (at.t > 0.9 * end) series.worst_last = std::max(series.worst_last, std::abs(error));
    const double kinetic = std::abs(scene.energy(at.q, at.p) - scene.energy(at.q, 0.0 * at.p));
    largest = std::max(largest, kinetic / choice.energy_scale);
    series.times.push_back(at.t);
    series.errors.push_back(error);
  });
  series.rounding = 0x1p-53 * largest * series.run.steps;
  return series;
}

/// Energy errors over `repeats` times the horizon of each scene, with one choice of solve(), and the slope of
/// a line fitted to them: table <name>_drift.
inline void measure_drift(Frame& frame, const std::vector<Scene>& scenes, int repeats) {
  Table& table =
      frame.table("drift", {"problem", "held_out", "horizons", "monitor", "outcome", "energy_error",
                            "slope_times_horizon", "corrected_t", "rounding", "first_tenth", "last_tenth"});
  table.note("corrected_t", "slope over its standard error, correlation between blocks counted");
  for (const Scene& scene : scenes) {
    const double end = repeats * scene.time;
    // The step that keeps the tolerance over ten horizons, about a hundred periods; shorter if a step of the
    // long run cannot be solved.
    const avi::SolutionReport found = choose(scene, 10.0 * scene.time, 1e-3, 8);
    avi::Choice choice = found.choice;
    Series series;
    for (int attempt = 0; found.ok() && attempt <= 6; ++attempt) {
      if (attempt > 0) choice.h *= 0.7;
      series = follow(scene, choice, end);
      if (series.run.outcome == avi::Outcome::ok) break;
    }
    const avi::DriftFit fit =
        series.times.size() > 100 ? avi::fit_drift(series.times, series.errors, 20) : avi::DriftFit{};
    double worst = 0.0;
    for (const double error : series.errors)
      worst = std::max(worst, std::abs(error));
    table.row(scene.name, scene.held_out, repeats, choice.name, avi::name(series.run.outcome), worst,
              fit.slope * end, avi::corrected_t(fit), series.rounding, series.worst_first, series.worst_last);
  }
}

}  // namespace experiment
