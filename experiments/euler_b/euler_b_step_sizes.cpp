#include "common/frame.hpp"
#include "euler_b/euler_b_runs.hpp"

// Physical steps of adaptive symplectic Euler-B in time for the three monitors of the paper, and for the
// fourth root from which the first was simplified, all at the same energy error.
int main(int argc, char** argv) {
  using namespace experiment;
  double eccentricity = 0.9, horizon = 13.0, target = 1e-3;
  const auto options = [&](CLI::App& app) {
    add_number(app, "--eccentricity", eccentricity, {.low = 0.0, .high = 1.0, .high_open = true},
               "Eccentricity e of the orbit");
    add_number(app, "--horizon", horizon, {.low = 0.0, .high = 1e3, .low_open = true},
               "Physical time T to reach");
    add_number(app, "--error", target, {.low = 1e-6, .high = 0.1},
               "Energy error at which the monitors are compared");
  };
  return run(argc, argv, AVI_SHOWS, options, [&](Frame& frame) {
    if (frame.quick) target = std::max(target, 1e-3);
    experiment::Table out = frame.table({"method", "monitor", "h", "tol", "horizon", "min_step", "max_step",
                                         "energy_error", "steps", "seconds"});
    experiment::Table curve = frame.table({"monitor", "t", "step"});
    out.note("eccentricity", eccentricity);
    for (const char* monitor : {"truncation", "arclength", "norm_squared", "truncation_root"}) {
      const auto setting = calibrated_euler_b(monitor, eccentricity, target, horizon);
      std::vector<double> t{0.0};
      const auto r = run_euler_b(setting, eccentricity, horizon,
                                 [&](const auto& z, double, double) { t.push_back(z.t); });
      double smallest = t.back(), largest = 0.0;
      const std::size_t stride = 1 + t.size() / 2000;
      for (std::size_t k = 1; k < t.size(); ++k) {
        const double step = t[k] - t[k - 1];
        smallest = std::min(smallest, step);
        largest = std::max(largest, step);
        if (k % stride == 0) curve.row(monitor, t[k], step);
      }
      out.row("symplectic_euler_b", monitor, setting.h, setting.tol, horizon, smallest, largest,
              r.energy_error, r.steps, experiment::rounded(r.seconds));
    }
    frame.write(curve, "curve");
    frame.write(out);
  });
}
