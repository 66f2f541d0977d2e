#include "beyond/speed/automatic_monitors/drift.hpp"

#include "beyond/speed/automatic_monitors/cost.hpp"
#include "beyond/speed/automatic_monitors/drift_verdict.hpp"

#include "avi/diagnostics/drift.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace experiment {

namespace {

/// What solve() chose, with the monitor as a formula.
struct Chosen : avi::Choice {
  avi::Formula monitor;
  /// The end of a run with it.
  template <class... Use>
  avi::Run run(const Scene& scene, Point start, const avi::Until& until, const Use&... use) const {
    auto method = avi::collocation(poincare(scene.energy, scene.start, monitor), order);
    return integrate(method, start, h, until, use...);
  }
};

/// How two orbits part that start side by side.
struct Parting {
  double growth = 0.0;         ///< Their largest distance in horizons 10 to 20 over that in the first ten.
  double distance = infinity;  ///< The former over the distance at the start.
  /// Neighbours part in proportion to time, growth 2, and have not come to where they part no more.
  [[nodiscard]] bool regular() const { return growth < 3.0 && distance < 3e7; }
};
Parting parting(const Scene& scene, const Chosen& choice) {
  std::vector<avi::VectorX> orbit;
  const double apart = 1e-9 * (scene.start.q.norm() + 1e-3);
  double most[2] = {0.0, 0.0};
  std::size_t steps = 0;
  for (const bool beside : {false, true}) {
    Point z = scene.start;
    if (beside) z.q.array() += apart;
    (void)choice.run(scene, z, {.time = 20.0 * scene.time}, [&](const Point& at, long) {
      if (!beside) {
        orbit.push_back(at.q);
      } else if (steps < orbit.size()) {
        double& largest = most[2 * steps >= orbit.size()];
        largest = std::max(largest, (at.q - orbit[steps]).norm());
        ++steps;
      }
    });
  }
  return {most[1] / most[0], most[1] / apart};
}

/// The energy error of a long run at its steps.
struct Series : ErrorSeries {
  avi::Run run;
  double worst_first = 0.0, worst_last = 0.0;  ///< In the first and the last tenth.
  double rounding = 0.0;  ///< Half a unit in the last place of the largest kinetic energy, for each step.
};
Series follow(const Scene& scene, const Chosen& choice, double end) {
  Series series;
  const double h0 = scene.energy(scene.start.q, scene.start.p);
  double largest = 0.0;
  series.run = choice.run(scene, scene.start, {.time = end, .steps = 20'000'000}, [&](const Point& at, long) {
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

}  // namespace

void measure_drift(const Frame& frame, const std::vector<Scene>& scenes, int repeats) {
  Table table = frame.table({"problem", "held_out", "horizons", "monitor", "outcome", "energy_error",
                             "slope_times_horizon", "corrected_t", "rounding", "first_tenth", "last_tenth"});
  int regular = 0, still = 0, small = 0, twice = 0;
  for (const Scene& scene : scenes) {
    const double end = repeats * scene.time;
    // The step that keeps the tolerance over a hundred periods; shorter where a step on the way cannot be
    // solved.
    const avi::SolutionReport found = choose(scene, 10.0 * scene.time, 1e-3, 8);
    Chosen choice{found.choice, monitor_of(scene, found.choice)};
    Series series;
    for (int attempt = 0; found.ok() && attempt <= 6; ++attempt) {
      if (attempt > 0) choice.h *= 0.7;
      series = follow(scene, choice, end);
      if (series.run.outcome == avi::Outcome::ok) break;
    }
    const bool arrived = found.ok() && series.run.outcome == avi::Outcome::ok;
    const avi::DriftFit fit =
        series.times.size() > 100 ? avi::fit_drift(series.times, series.errors, 20) : avi::DriftFit{};
    double worst = 0.0;
    for (const double error : series.errors)
      worst = std::max(worst, std::abs(error));
    const Parting parted = arrived ? parting(scene, choice) : Parting();
    DriftVerdict verdict;
    if (parted.regular()) {
      const double change = std::abs(fit.slope * end);
      ++regular;
      verdict = judge_drift(fit, end, series.rounding, [&] { return follow(scene, choice, 2.0 * end); });
      twice += verdict.twice;
      still += verdict.none;
      small += change < 0.02 * worst;
    }
    table.row(scene.name, scene.held_out, repeats, choice.name, avi::name(series.run.outcome), worst,
              fit.slope * end, avi::corrected_t(fit), series.rounding, series.worst_first, series.worst_last);
  }
  fmt::print(
      "{} of {} problems regular; no drift (slope within three of its standard errors, correlation "
      "counted, or of rounding; on {} in a second run of the same length) on {} of them, a change by less "
      "than a fiftieth of the error over {} horizons on {}\n",
      regular, scenes.size(), twice, still, repeats, small);
  frame.write(table, "drift");
}

}  // namespace experiment
