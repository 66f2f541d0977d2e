#include "common/frame.hpp"
#include "euler_b/euler_b_runs.hpp"

#include <map>
#include <string>
#include <vector>

// Steps and time that plain and adaptive symplectic Euler-B need for a given energy error over T = 100 at e
// = 0.9 (Section 3.3 of the paper, whose text compares them without numbers).
namespace {

using namespace experiment;

/// Nanoseconds per step of every monitor in each of 21 rounds. In a round all monitors run once, each round
/// from another one on, so that neither a drift of the machine nor the place in the round favours one of
/// them.
std::map<std::string, std::vector<double>> nanoseconds_per_step(double eccentricity) {
  std::map<std::string, std::vector<double>> samples;
  std::vector<EulerBSetting> settings;
  for (const char* monitor : {"none", "truncation", "arclength", "norm_squared"})
    settings.push_back(calibrated_euler_b(monitor, eccentricity, 1e-3, 20.0));
  for (std::size_t round = 0; round < 21; ++round)
    for (std::size_t m = 0; m < settings.size(); ++m) {
      const auto& setting = settings[(round + m) % settings.size()];
      const auto r = run_euler_b(setting, eccentricity, 20.0);
      samples[setting.monitor].push_back(1e9 * r.seconds / r.steps);
    }
  return samples;
}

}  // namespace

void experiment::conduct(Frame& frame) {
  constexpr double eccentricity = 0.9;
  const double horizon = frame.quick ? 50.0 : 100.0;
  std::vector<std::pair<std::string, double>> cells;
  for (double target : {1e-2, 1e-3, 1e-4})
    for (const char* monitor : {"none", "truncation", "truncation_root", "arclength", "norm_squared"})
      if (frame.longer || target > 5e-4 || std::string(monitor) != "truncation_root")
        cells.emplace_back(monitor, target);
  for (const char* monitor : {"truncation", "arclength", "norm_squared"})
    cells.emplace_back(monitor, 1e-5);
  if (frame.longer) cells.emplace_back("truncation_root", 1e-5);
  if (frame.quick) cells.resize(10);

  Table& out = frame.table({"method", "monitor", "h", "tol", "horizon", "target", "energy_error",
                            "angular_momentum_error", "steps", "seconds"});
  out.note("eccentricity", eccentricity);
  out.note("seconds", "with both errors watched at every step");
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto& [monitor, target] = cells[i];
    frame.progress(monitor + " at " + rounded(target), i, cells.size());
    const auto setting = calibrated_euler_b(monitor, eccentricity, target, 20.0);
    const auto r = run_euler_b(setting, eccentricity, horizon);
    out.row("symplectic_euler_b", monitor, setting.h, setting.tol, horizon, target, r.energy_error,
            r.angular_momentum_error, r.steps, rounded(r.seconds));
  }
  Table& each = frame.table("rounds", {"method", "monitor", "round", "nanoseconds"});
  each.note("nanoseconds", "of one step, both errors watched; in a round every monitor runs once");
  for (const auto& [monitor, samples] : nanoseconds_per_step(eccentricity))
    for (std::size_t i = 0; i < samples.size(); ++i)
      each.row("symplectic_euler_b", monitor, i + 1, rounded(samples[i], 4));
}
