#pragma once
#include "beyond/speed/work_precision/family.hpp"

#include <functional>
#include <string>
#include <vector>

/// @file
/// From families of methods to points in the plane of cost and error.

namespace experiment::work_precision {

/// One method at one setting: medians over the starts.
struct Point {
  const Family* family = nullptr;
  double setting = 0.0;
  long steps = 0;
  long evaluations = 0;
  double seconds = 0.0;
  double least_seconds = 0.0, most_seconds = 0.0;  ///< Over the starts.
  double position_error = 0.0;
  double energy_error = 0.0;  ///< Largest over the steps, from start 0.

  [[nodiscard]] std::string label() const;  ///< `g=r^1.5 h=0.2`.
};

/// The budget in evaluations of the force: so the machine's speed does not decide what is measured. A
/// Taylor expansion counts as some, see Family::weight.
struct Budget {
  double longest_run = 47'000;  ///< A family ends with the first setting that takes more.
  double family = 3e7;          ///< All runs of a family together; it ends where they are spent.
  double least_run = 6'000;     ///< A shorter run counts as this many: it is repeated in the timed block.
  double least_block = 0.0001;  ///< Seconds of the timed block.
  std::size_t stride = 3;       ///< Every that many of a family's settings is tried.
};

/// Measures every family of a scene. First each is tried from coarse to fine, once, to find the settings
/// that are worth measuring: an error below 0.1 and not yet at the floor, work below the cap. Then round
/// k = 0 ... 4 runs all of them from start k, one after the other, so that a drift of the machine's speed
/// meets all alike. `progress` is told the fraction done.
std::vector<Point> measure(const Scene& scene, const Budget& budget,
                           const std::function<void(double)>& progress);

}  // namespace experiment::work_precision
