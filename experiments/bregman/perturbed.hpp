#pragma once
#include "bregman/setting.hpp"

#include <algorithm>
#include <random>

/// @file
/// How far an iteration count moves with the last bit of the start.

namespace experiment {

/// Counts of runs whose starts differ from the paper's by up to some size in every entry.
struct PerturbedCounts {
  std::vector<long> counts;  ///< Of the runs that converged, in ascending order.
  long failed = 0;           ///< Runs that did not converge.

  [[nodiscard]] long least() const { return counts.empty() ? 0 : counts.front(); }
  [[nodiscard]] long median() const { return counts.empty() ? 0 : counts[(counts.size() - 1) / 2]; }
  [[nodiscard]] long most() const { return counts.empty() ? 0 : counts.back(); }
  /// Runs whose count is n.
  [[nodiscard]] long equal_to(long n) const { return std::ranges::count(counts, n); }
};

/// The same starts for every setting.
inline PerturbedCounts perturbed_counts(const Setting& setting, long starts, double size,
                                        const avi::Stopping& stopping) {
  const avi::CorrelatedQuartic f;
  PerturbedCounts result;
  for (long i = 0; i < starts; ++i) {
    std::mt19937_64 random(static_cast<std::uint64_t>(i) + 1);
    avi::VectorX x0 = f.start();
    for (double& x : x0)  // 53 bits of the generator, mapped to [-1, 1): the same on every platform
      x += size * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0);
    const auto run = run_setting(setting, f, x0, stopping);
    if (run.converged())
      result.counts.push_back(run.iterations);
    else
      ++result.failed;
  }
  std::ranges::sort(result.counts);
  return result;
}

}  // namespace experiment
