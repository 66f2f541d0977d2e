#include "common/frame.hpp"
#include "euler_b/euler_b_runs.hpp"

// Energy and angular-momentum error of symplectic Euler-B with fixed and with adaptive steps (monitor:
// truncation error) over T = 100 at e = 0.9, with equally many steps. The paper's figure does not state its
// step sizes.
void experiment::conduct(Frame& frame) {
  constexpr double eccentricity = 0.9, h = 1e-3;
  const double horizon = frame.quick ? 10.0 : 100.0;
  // Equally many steps: the count is inversely proportional to the size.
  const double fixed_steps = std::ceil(horizon / h);
  double size = h;
  for (int k = 0; k < 3; ++k)
    size *= run_euler_b(euler_b_setting("truncation", size), eccentricity, horizon).steps / fixed_steps;

  Table& out = frame.table({"method", "monitor", "h", "tol", "horizon", "energy_error",
                            "angular_momentum_error", "steps", "seconds"});
  Table& curve = frame.table("curve", {"monitor", "t", "energy_error", "angular_momentum_error"});
  out.note("eccentricity", eccentricity);
  curve.note("rows", "largest error in each of 1000 equal intervals of time");
  for (const EulerBSetting& setting : {EulerBSetting{"none", h}, euler_b_setting("truncation", size)}) {
    constexpr int intervals = 1000;
    std::vector<double> energy(intervals, 0.0), momentum(intervals, 0.0);
    const auto r = run_euler_b(setting, eccentricity, horizon, [&](const auto& z, double e, double l) {
      const auto i = static_cast<std::size_t>(std::min(z.t / horizon, 1.0 - 1e-12) * intervals);
      energy[i] = std::max(energy[i], e);
      momentum[i] = std::max(momentum[i], l);
    });
    out.row("symplectic_euler_b", setting.monitor, setting.h, setting.tol, horizon, r.energy_error,
            r.angular_momentum_error, r.steps, rounded(r.seconds));
    for (int i = 0; i < intervals; ++i)
      curve.row(setting.monitor, (i + 0.5) * horizon / intervals, energy[i], momentum[i]);
  }
}
