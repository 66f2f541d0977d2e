#include "beyond/speed/automatic_monitors/promises.hpp"

#include "avi/automatic/solution.hpp"
#include "avi/diagnostics/drift.hpp"

#include <fmt/format.h>

namespace experiment {

void measure_tolerances(const Frame& frame, const std::vector<Scene>& scenes) {
  Table table = frame.table({"problem", "held_out", "tolerance", "energy_error", "outcome", "order",
                             "monitor", "steps", "sweeps", "pilot_sweeps"});
  int all = 0, near = 0, below = 0, far = 0;
  for (const Scene& scene : scenes)
    for (int k = 4; k <= 11; ++k) {
      const double tolerance = std::pow(10.0, -k);
      const auto solution = integrate(scene.energy, scene.start, scene.time, tolerance);
      const double ratio = solution.energy_error / tolerance;
      ++all;
      near += ratio <= 3.0 && ratio >= 1.0 / 3.0;
      below += ratio < 1.0 / 3.0;
      far += ratio > 10.0;
      table.row(scene.name, scene.held_out ? 1 : 0, tolerance, solution.energy_error,
                std::string(avi::name(solution.run.outcome)), solution.choice.order, solution.choice.name,
                solution.run.steps, solution.run.evaluations, solution.choice.sweeps);
    }
  fmt::print("energy error within 3 of the tolerance in {} of {} runs, smaller than a third in {}, more than "
             "ten times "
             "in {}\n",
             near, all, below, far);
  frame.write(table, "tolerance");
}

void measure_drift(const Frame& frame, const std::vector<Scene>& scenes, int repeats) {
  Table table = frame.table({"problem", "held_out", "horizons", "monitor", "outcome", "energy_error",
                             "slope_times_horizon", "t_statistic", "correlation", "corrected_t"});
  int still = 0;
  for (const Scene& scene : scenes) {
    const avi::MonitorChoice choice =
        choose_monitor(scene.energy, scene.start, {.energy_error = 1e-6, .order = 8});
    auto method = avi::collocation(poincare(scene.energy, scene.start, choice.monitor), 8);
    avi::State<avi::dynamic> z = scene.start;
    std::vector<double> times, errors;
    const double h0 = scene.energy(z.q, z.p), end = repeats * scene.time;
    double worst = 0.0;
    avi::Run run;
    run.outcome = avi::Outcome::not_converged;
    if (choice.reached)
      run = integrate(method, z, choice.h, avi::Until{.time = end, .steps = 100'000'000},
                      [&](const avi::State<avi::dynamic>& at, long) {
                        const double error = (scene.energy(at.q, at.p) - h0) / choice.energy_scale;
                        worst = std::max(worst, std::abs(error));
                        times.push_back(at.t);
                        errors.push_back(error);
                      });
    const avi::DriftFit fit = times.size() > 100 ? avi::fit_drift(times, errors, 20) : avi::DriftFit{};
    still += run.outcome == avi::Outcome::ok && std::abs(avi::corrected_t(fit)) < 3.0;
    table.row(scene.name, scene.held_out ? 1 : 0, repeats, choice.name, std::string(avi::name(run.outcome)),
              worst, fit.slope * end, fit.t_statistic, fit.correlation, avi::corrected_t(fit));
  }
  fmt::print(
      "no drift (slope within three of its standard errors, correlation counted) on {} of {} problems\n",
      still, scenes.size());
  frame.write(table, "drift");
}

}  // namespace experiment
