#include "beyond/speed/work_precision/advice.hpp"
#include "beyond/speed/work_precision/peers/peers.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"

// Position error at the end and largest energy error against wall time, for every explicit method of the
// library, HTVI of many orders, and the integrators of other libraries. Costs are in units of SV, the time of
// the Stormer-Verlet run of Table 1 (e = 0.9, T = 10, h = 5e-5), which is measured before and after each
// scene.

namespace {

using namespace experiment;
using namespace experiment::work_precision;

/// The Stormer-Verlet family for Kepler's problem, with only the setting of the reference run.
Scene reference_scene() {
  Scene scene = scenes(Grid::quick).front().make();
  std::erase_if(scene.families, [](const Family& f) { return f.method != "stormer_verlet"; });
  scene.families.front().settings = {5e-5};
  return scene;
}

void add_rows(Table& table, const Scene& scene, const std::vector<Point>& points, double unit) {
  for (const Point& p : points)
    table.row(scene.problem, scene.eccentricity, scene.horizon_name, p.family->method, p.family->order,
              p.label(), p.steps, p.evaluations, rounded(p.seconds), p.position_error, p.energy_error,
              rounded(p.seconds / unit), rounded(p.least_seconds / unit), rounded(p.most_seconds / unit));
}

/// The measurements of a scene, and the unit before and after it.
struct Measured {
  std::vector<Point> unit_point, points;
  double unit;   ///< Mean of both, in seconds.
  double drift;  ///< |after / before - 1|
};

/// If the unit changes by more than this fraction while a scene is measured, the scene is measured again, at
/// most twice. If that does not help, the drift recorded in the data makes the report reject them.
constexpr double largest_drift = 0.05;

Measured measured_with_unit(const Scene& unit_scene, const Scene& scene, const Budget& budget,
                            const std::function<void(double)>& progress) {
  // The least time of several runs, because other work on the machine can only slow them down.
  const auto unit = [&] {
    std::vector<Point> least;
    for (int run = 0; run < 5; ++run)
      // in effect without a cap: where the machine is crowded, one slow trial must not leave no unit
      if (auto point =
              measure(unit_scene, {.longest_run = 1e12, .family = 1e12, .least_block = 0.0}, [](double) {});
          least.empty() || point.front().seconds < least.front().seconds)
        least = std::move(point);
    return least;
  };
  Measured made;
  made.unit_point = unit();
  made.points = measure(scene, budget, progress);
  const double before = made.unit_point.front().seconds, after = unit().front().seconds;
  made.unit = made.unit_point.front().seconds = 0.5 * (before + after);
  made.drift = std::abs(after / before - 1.0);
  return made;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  const Grid grid = frame.quick ? Grid::quick : frame.longer ? Grid::full : Grid::reduced;
  const Budget base =
      frame.quick    ? Budget{.longest_run = 3e4, .least_run = 3000, .least_block = 0.00005, .stride = 4}
      : frame.longer ? Budget{.longest_run = 1.2e6, .least_run = 3e4, .least_block = 0.0005, .stride = 1}
                     : Budget{};
  Table& table =
      frame.table({"problem", "eccentricity", "horizon", "method", "order", "setting", "steps", "evaluations",
                   "seconds", "position_error", "energy_error", "cost", "least_cost", "most_cost"});
  Table& advice = advice_table(frame);
  table.note("peers", peers_present());
  advice.note("peers", peers_present());
  const Scene unit_scene = reference_scene();
  const auto list = scenes(grid);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string& label = list[i].label;
    const Scene scene = list[i].make();
    if (scene.reference_error > 0.0)
      table.note("reference error of " + label, rounded(scene.reference_error, 2));
    Budget budget = base;
    budget.longest_run *= scene.longest_run * std::clamp(scene.horizon / 10.0, 1.0, 8.0);
    budget.family *= std::clamp(scene.horizon / 10.0, 1.0, 3.0);
    if (frame.longer && scene.horizon > 1000.0) budget.stride = 3;
    const auto progress = [&](double fraction) { frame.progress(label, i + fraction, list.size()); };
    Measured made = measured_with_unit(unit_scene, scene, budget, progress);
    for (int again = 0; again < 2 && made.drift > largest_drift && !frame.quick; ++again)
      if (Measured next = measured_with_unit(unit_scene, scene, budget, progress); next.drift < made.drift)
        made = std::move(next);
    if (made.drift > largest_drift)
      fmt::print(
          stderr,
          "The unit of time moved by {:.0f} % while '{}' was measured: its costs are not to be used.\n",
          100.0 * made.drift, label);
    auto& [unit_point, points, unit, drift] = made;
    if (i == 0) add_rows(table, unit_scene, unit_point, unit);
    add_rows(table, scene, points, unit);
    advise(advice, scene, points, unit, drift);
  }
}
