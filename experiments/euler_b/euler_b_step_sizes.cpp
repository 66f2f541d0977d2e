#include "common/frame.hpp"
#include "euler_b/euler_b_runs.hpp"

// Physical steps of adaptive symplectic Euler-B in time for the three monitors of the paper, and for the
// fourth root from which the first was simplified, all at the same energy error.
void experiment::conduct(Frame& frame) {
  constexpr double eccentricity = 0.9, horizon = 13.0, target = 1e-3;
  Table& out = frame.table({"method", "monitor", "h", "tol", "horizon", "min_step", "max_step",
                            "energy_error", "steps", "seconds"});
  Table& curve = frame.table("curve", {"monitor", "t", "step"});
  out.note("eccentricity", eccentricity);
  for (const char* monitor : {"truncation", "arclength", "norm_squared", "truncation_root"}) {
    const auto setting = calibrated_euler_b(monitor, eccentricity, target, horizon);
    std::vector<double> t{0.0};
    const auto r =
        run_euler_b(setting, eccentricity, horizon, [&](const auto& z, double, double) { t.push_back(z.t); });
    double smallest = t.back(), largest = 0.0;
    const std::size_t stride = 1 + t.size() / 2000;
    for (std::size_t k = 1; k < t.size(); ++k) {
      const double step = t[k] - t[k - 1];
      smallest = std::min(smallest, step);
      largest = std::max(largest, step);
      if (k % stride == 0) curve.row(monitor, t[k], step);
    }
    out.row("symplectic_euler_b", monitor, setting.h, setting.tol, horizon, smallest, largest, r.energy_error,
            r.steps, rounded(r.seconds));
  }
}
