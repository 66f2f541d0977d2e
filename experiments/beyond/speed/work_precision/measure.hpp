#pragma once
#include "beyond/speed/work_precision/family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

// From families of methods to points in the plane of cost and error.

namespace experiment::work_precision {

/// One method at one setting, with medians over the starts.
struct Point {
  const Family* family = nullptr;
  double setting = 0.0;
  long steps = 0;
  long evaluations = 0;
  double seconds = 0.0;
  double least_seconds = 0.0, most_seconds = 0.0;  ///< Extremes over the starts.
  double position_error = 0.0;
  double energy_error = 0.0;  ///< Largest error over all steps, from start 0.

  /// The setting as text, such as `g=r^1.5 h=0.2`.
  [[nodiscard]] std::string label() const { return fmt::format("{}={:.4g}", family->knob, setting); }
};

/// The budget, in evaluations of the force, so that the speed of the machine does not affect which settings
/// are measured. A Taylor expansion counts as several evaluations, see Family::weight.
struct Budget {
  double longest_run = 47'000;  ///< A family ends with the first setting that takes more.
  double family = 3e7;          ///< Limit for all runs of a family together; beyond it the family ends.
  /// A shorter run counts as this many, because it is repeated in the timed block.
  double least_run = 6'000;
  double least_block = 0.0001;  ///< Seconds of the timed block.
  std::size_t stride = 3;       ///< Only every stride-th setting of a family is tried.
};

struct Trial {
  const Family* family;
  double setting;
  double seconds;
  long step_cap;
};

/// The work of a run, in evaluations of the force.
inline double work(const Family& family, const Result& result) {
  return family.weight * static_cast<double>(result.evaluations);
}

/// The number of steps that takes this much work, estimated from the first few hundred steps. (An orbit that
/// a coarse setting ejects may take any number of them.)
inline long steps_within(double most, const Family& family, double setting) {
  const Result result = family.run({.setting = setting, .step_cap = 300});
  const double step = work(family, result) / static_cast<double>(std::max(result.steps, 1L));
  return static_cast<long>(most / std::max(step, 1.0));
}

/// The settings of a family that are worth measuring.
inline std::vector<Trial> scout(const Scene& scene, const Family& family, const Budget& budget) {
  const double far_too_long = 2.0 * budget.longest_run;
  std::vector<Trial> kept;
  double best = HUGE_VAL;
  std::size_t stale = 0;
  double spent = 0.0;
  for (std::size_t i = 0; i < family.settings.size(); i += budget.stride) {
    const double setting = family.settings[i];
    const long step_cap = steps_within(far_too_long, family, setting);
    const Result result = family.run({.setting = setting, .step_cap = step_cap});
    const double error = result.ok ? scene.position_error(0, result.t, result.q) : std::nan("");
    const double taken = work(family, result);
    spent += (starts + 1) * std::max(taken, budget.least_run);
    if ((i > 0 && taken > far_too_long) || spent > budget.family) break;
    if (error < 0.1 && taken <= far_too_long)
      kept.push_back({&family, setting, result.seconds, 2 * step_cap});
    if (error < 0.7 * best) {
      best = error;
      stale = 0;
    } else if (best < 1e-2) {
      ++stale;
    }
    if (stale * budget.stride >= 6 || error < 2e-14) break;
    if (taken > budget.longest_run) break;
  }
  return kept;
}

/// Measures every family of a scene. First, the settings of a family are tried once, from coarse to fine, to
/// find those worth measuring: with an error below 0.1 but not yet at the floor, and work below the cap. Then
/// round k = 0 ... 4 runs all of these from start k, one after the other, so that a change of the machine's
/// speed affects all of them. `progress` receives the fraction that is done.
inline std::vector<Point> measure(const Scene& scene, const Budget& budget,
                                  const std::function<void(double)>& progress) {
  std::vector<Trial> trials;
  for (const Family& family : scene.families) {
    const auto kept = scout(scene, family, budget);
    trials.insert(trials.end(), kept.begin(), kept.end());
  }
  std::vector<std::vector<double>> seconds(trials.size()), errors(trials.size());
  std::vector<Point> points(trials.size());
  for (int k = 0; k < starts; ++k) {
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const Trial& trial = trials[i];
      const int repeats = static_cast<int>(std::clamp(budget.least_block / trial.seconds, 1.0, 1e5));
      const Result result = trial.family->run(
          {.setting = trial.setting, .start = k, .repeats = repeats, .step_cap = trial.step_cap});
      seconds[i].push_back(result.seconds);
      errors[i].push_back(result.ok ? scene.position_error(k, result.t, result.q) : HUGE_VAL);
      if (k == 0) {
        const Result watched =
            trial.family->run({.setting = trial.setting, .watch_energy = true, .step_cap = trial.step_cap});
        points[i] = {.family = trial.family,
                     .setting = trial.setting,
                     .steps = result.steps,
                     .evaluations = result.evaluations,
                     .energy_error = watched.energy_error};
      }
    }
    progress((k + 1.0) / starts);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].seconds = median(seconds[i]);
    points[i].least_seconds = std::ranges::min(seconds[i]);
    points[i].most_seconds = std::ranges::max(seconds[i]);
    points[i].position_error = median(errors[i]);
  }
  std::erase_if(points, [](const Point& p) { return !std::isfinite(p.position_error); });
  return points;
}

}  // namespace experiment::work_precision
