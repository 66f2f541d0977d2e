#include "common/frame.hpp"
#include "euler_b/euler_b_runs.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

// Steps and time that plain and adaptive symplectic Euler-B need for a given energy error over T = 1000 at e
// = 0.9 (Section 3.3 of the paper, whose text compares them without numbers).
namespace {

/// Runs of single monitors differ by what else the machine does; the least of several that take turns does
/// not.
std::map<std::string, double> nanoseconds_per_step(double eccentricity) {
  using namespace experiment;
  std::map<std::string, double> best;
  std::vector<decltype(calibrated_euler_b("none", eccentricity, 1e-3, 20.0))> settings;
  const std::vector<std::string> monitors{"none", "truncation", "arclength", "norm_squared"};
  for (const auto& monitor : monitors)
    settings.push_back(calibrated_euler_b(monitor, eccentricity, 1e-3, 20.0));
  for (int round = 0; round < 9; ++round)
    for (std::size_t m = 0; m < monitors.size(); ++m) {
      const auto r = run_euler_b(settings[m], eccentricity, 20.0);
      const double each = 1e9 * r.seconds / static_cast<double>(r.steps);
      const auto [known, first] = best.try_emplace(monitors[m], each);
      if (!first) known->second = std::min(known->second, each);
    }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace experiment;
  double eccentricity = 0.9, horizon = 1000.0;
  bool full = false;
  return run(
      argc, argv, "euler_b_cost", "Cost of symplectic Euler-B with each monitor at matched energy error",
      [&](CLI::App& app) {
        add_number(app, "--eccentricity", eccentricity, {.low = 0.0, .high = 1.0, .high_open = true},
                   "Eccentricity e of the orbit");
        add_number(app, "--horizon", horizon, {.low = 0.0, .high = 1e5, .low_open = true},
                   "Physical time T to reach");
        add_flag(app, "--long", full, "Also the fourth-root monitor at 1e-4 and 1e-5 (some 2e9 steps)");
      },
      [&](Frame& frame) {
        if (frame.quick) horizon = 50.0;
        std::vector<std::pair<std::string, double>> cells;
        for (double target : {1e-2, 1e-3, 1e-4})
          for (const char* monitor : {"none", "truncation", "truncation_root", "arclength", "norm_squared"})
            if (full || target > 5e-4 || std::string(monitor) != "truncation_root")
              cells.emplace_back(monitor, target);
        for (const char* monitor : {"truncation", "arclength", "norm_squared"})
          cells.emplace_back(monitor, 1e-5);
        if (full) cells.emplace_back("truncation_root", 1e-5);
        if (frame.quick) cells.resize(10);

        experiment::Table out = frame.table({"method", "monitor", "h", "tol", "horizon", "target",
                                             "energy_error", "angular_momentum_error", "steps", "seconds"});
        out.note("eccentricity", eccentricity);
        out.note("seconds", "with both errors watched at every step");
        for (std::size_t i = 0; i < cells.size(); ++i) {
          const auto& [monitor, target] = cells[i];
          frame.progress(monitor + " at " + experiment::rounded(target),
                         static_cast<double>(i) / cells.size());
          const auto setting = calibrated_euler_b(monitor, eccentricity, target, std::min(horizon, 20.0));
          const auto r = run_euler_b(setting, eccentricity, horizon);
          out.row("symplectic_euler_b", monitor, setting.h, setting.tol, horizon, target, r.energy_error,
                  r.angular_momentum_error, r.steps, experiment::rounded(r.seconds));
        }
        experiment::Table steps = frame.table({"method", "monitor", "nanoseconds"});
        steps.note("nanoseconds", "of one step: least of nine runs in turn, both errors watched");
        for (const auto& [monitor, best] : nanoseconds_per_step(eccentricity))
          steps.row("symplectic_euler_b", monitor, experiment::rounded(best, 4));
        frame.write(steps, "step");
        frame.progress("done", 1.0);
        frame.write(out);
      });
}
