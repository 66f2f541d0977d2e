#pragma once
#include "avi/core/outcome.hpp"
#include "common/timing.hpp"

#include <Eigen/Core>

#include <ctime>
#include <functional>
#include <string>
#include <vector>

// A method and a problem as the comparison sees them, from whatever library.

namespace experiment::work_precision {

/// Number of starts over which medians of errors and times are taken: the start itself and its neighbours,
/// moved by multiples of 1e-14. Near the round-off floor, the error of a single run is random.
inline constexpr int starts = 5;

/// The result of one run.
struct Result {
  bool ok = false;
  Eigen::VectorXd q;  ///< Position at the end.
  double t = 0.0;     ///< The time that the method reached, at or after the horizon.
  long steps = 0;
  long evaluations = 0;  ///< Evaluations of the force, or of the Taylor expansion.
  double energy_error = 0.0;
  double seconds = 0.0;  ///< Seconds of one integration; set-up counts only for other libraries and solve().
};

/// How a run is to be made.
struct Request {
  double setting = 0.0;  ///< Step size or tolerance.
  int start = 0;
  bool watch_energy = false;   ///< Check the energy after every step; the seconds are then meaningless.
  int repeats = 1;             ///< Integrations in the timed block.
  long step_cap = 10'000'000;  ///< A run that needs more steps counts as failed.
};

/// Seconds of one call of `work`, from a block of `repeats` calls. If the wall time of a block exceeds the
/// process's time on the core by more than 2 % (and 20 microseconds), the process was descheduled, and the
/// block is run again, at most twice.
double block_seconds(const auto& work, int repeats) {
  double best = 0.0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const std::clock_t cpu = std::clock();
    const Stopwatch wall;
    for (int i = 0; i < repeats; ++i)
      work();
    const double elapsed = wall();
    const double busy = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    best = attempt == 0 || elapsed < best ? elapsed : best;
    if (elapsed <= 1.02 * busy + 2e-5) break;
  }
  return best / repeats;
}

enum class Origin { ours_explicit, collocation, htvi, peer, front_door };

/// A method with its settings, from coarse to fine.
struct Family {
  std::string method;
  int order = 0;
  Origin origin = Origin::ours_explicit;
  std::string knob;              ///< Name of the setting, `h` or `tolerance`, including the monitor if any.
  std::vector<double> settings;  ///< Settings from coarse to fine.
  std::function<Result(const Request&)> run;
  double weight = 1.0;  ///< Evaluations of the force that one of its own costs about: caps count these.
};

/// A problem over a horizon, with the methods that are compared.
struct Scene {
  std::string problem;
  double eccentricity;  ///< NaN if there is none.
  double horizon;
  std::string horizon_name;  ///< As printed in tables: `10`, `1000 periods`.
  /// Position error |q - exact position at t| of a run from start k.
  std::function<double(int k, double t, const Eigen::VectorXd& q)> position_error{};
  double reference_error = 0.0;  ///< Estimated error of the reference solution itself.
  double longest_run =
      1.0;  ///< Factor for Budget::longest_run in this scene: below 1 where evaluations are expensive.
  std::vector<Family> families{};
};

/// The geometric sequence first, first ratio, ... with `count` entries.
inline std::vector<double> geometric(double first, double ratio, int count) {
  std::vector<double> list;
  for (int i = 0; i < count; ++i, first *= ratio)
    list.push_back(first);
  return list;
}

}  // namespace experiment::work_precision
