#pragma once
#include <chrono>
#include <ctime>

/// @file
/// Wall time of a block that is repeated when the operating system took the core away from it.

namespace experiment::work_precision {

/// Seconds of one call of `work`, from a block of `repeats` calls. A block whose wall time exceeds the time
/// the process had on the core by more than 2 % (and 20 microseconds) was descheduled: it is run again, at
/// most twice.
template <class Work>
double block_seconds(const Work& work, int repeats) {
  using Clock = std::chrono::steady_clock;
  double best = 0.0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const std::clock_t cpu = std::clock();
    const auto wall = Clock::now();
    for (int i = 0; i < repeats; ++i)
      work();
    const double elapsed = std::chrono::duration<double>(Clock::now() - wall).count();
    const double busy = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    best = attempt == 0 || elapsed < best ? elapsed : best;
    if (elapsed <= 1.02 * busy + 2e-5) break;
  }
  return best / repeats;
}

}  // namespace experiment::work_precision
