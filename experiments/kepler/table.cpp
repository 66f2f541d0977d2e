#include "kepler/table.hpp"

#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/kepler.hpp"
#include "common/timing.hpp"

#include <cmath>

namespace experiment {

// The arclength row of Table 1 prints the step bounds a h, b h where the other rows print a, b; only a =
// 0.03, b = 3 gives its steps.
KeplerTable table1() {
  return {.eccentricity = 0.9,
          .htvi = {{"gamma", 0.1, 0.01, 8.0},
                   {"energy", 0.1, 1e-4, 2.0},
                   {"arclength", 0.1, 0.03, 3.0},
                   {"none", 0.0025, unknown, unknown}},
          .verlet_h = 5e-5,
          .rounds = 15};
}

// The arclength row of Table 2 prints h = 0.1; only h = 0.05 gives its steps.
KeplerTable table2() {
  return {.eccentricity = 0.99,
          .htvi = {{"gamma", 0.1, 5e-4, 8.0},
                   {"energy", 0.03, 1e-6, 5.0},
                   {"arclength", 0.05, 8e-4, 10.0},
                   {"none", 5e-4, unknown, unknown}},
          .verlet_h = 5e-7,
          .rounds = 5};
}

namespace {

KeplerRun verlet_run(const KeplerTable& table) {
  const Method2 verlet(avi::Kepler{}, [](const State2&) {
    return avi::stormer_verlet<2>(
        [](const avi::Vector<double, 2>& q) { return avi::Kepler::potential_gradient(q); });
  });
  const KeplerRow row{.monitor = "none", .h = table.verlet_h, .a = unknown, .b = unknown};
  // A fixed step is counted, not summed: the sum of 2e7 rounded steps need not end where N h does.
  const avi::Until until{.steps = std::lround(table.horizon / table.verlet_h)};
  return {{"stormer_verlet"}, row, verlet, table.eccentricity, until};
}

}  // namespace

void kepler_table(Frame& frame, const KeplerTable& table) {
  std::vector<KeplerRun> runs;
  for (const char* construction : {"authors", "printed"})
    for (auto& run : htvi4_runs(construction, table))
      runs.push_back(std::move(run));
  for (auto& run : stationary_runs(table))
    runs.push_back(std::move(run));
  runs.push_back(verlet_run(table));

  std::vector<KeplerResult> results;
  for (const auto& run : runs) {
    frame.progress(run.name.construction + " " + run.row.monitor, results.size(), runs.size() + 1.0);
    results.push_back(run.measure());
  }
  frame.progress("timing", 0.95);
  std::vector<std::function<void()>> works;
  for (const auto& run : runs)
    works.push_back([&run] { run.run(); });
  const auto times = interleaved_least_seconds(works, frame.quick ? 1 : table.rounds);

  Table& out =
      frame.table({"method", "construction", "r", "rule", "monitor", "h", "g_min", "g_max", "min_step",
                   "max_step", "energy_error", "global_error", "global_error_shifted", "steps", "seconds"});
  out.note("eccentricity", table.eccentricity);
  out.note("horizon", table.horizon);
  out.note("rounds", table.rounds);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const KeplerRow& row = runs[i].row;
    const KeplerResult& r = results[i];
    const HtviName& name = runs[i].name;
    out.row(name.method, name.construction, name.r, name.rule, row.monitor, row.h, row.a, row.b, r.min_step,
            r.max_step, r.energy_error, r.global_error,
            name.method == "stormer_verlet" ? r.global_error_shifted : unknown, r.steps, rounded(times[i]));
  }
}

}  // namespace experiment
