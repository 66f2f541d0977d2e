#include "kepler/euler_b_runs.hpp"

// Steps and time that plain and adaptive symplectic Euler-B need for a given energy error over T = 1000 at e
// = 0.9 (Section 3.3 of the paper, whose text compares them without numbers).
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

        avi::Table out = frame.table({"method", "monitor", "h", "tol", "horizon", "target", "energy_error",
                                      "angular_momentum_error", "steps", "seconds"});
        out.note("eccentricity", eccentricity);
        out.note("seconds", "with both errors watched at every step");
        for (std::size_t i = 0; i < cells.size(); ++i) {
          const auto& [monitor, target] = cells[i];
          frame.progress(monitor + " at " + avi::rounded(target), static_cast<double>(i) / cells.size());
          const auto setting = calibrated_euler_b(monitor, eccentricity, target, std::min(horizon, 20.0));
          const auto r = run_euler_b(setting, eccentricity, horizon);
          out.row("symplectic_euler_b", monitor, setting.h, setting.tol, horizon, target, r.energy_error,
                  r.angular_momentum_error, r.steps, avi::rounded(r.seconds));
        }
        frame.progress("done", 1.0);
        frame.write(out);
      });
}
