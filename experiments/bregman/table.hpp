#pragma once
#include "bregman/curve.hpp"
#include "bregman/setting.hpp"
#include "common/frame.hpp"

#include <functional>
#include <string>
#include <vector>

// The experiments direct_vs_adaptive, method_comparison and p_dependence: one table of the paper each; and
// the loop of those that look at all their settings again.

namespace experiment {

/// A label that gnuplot can select a curve by, such as "htvi adaptive 4 0.5".
std::string label_of(const Setting& s);

/// Such an experiment: every setting run to the stopping test, then from 16 starts moved by 1e-14,
/// whose range tells counts that mean something from those that the last bit decides.
void iteration_table(Frame& frame, const std::vector<Setting>& settings);

/// How far an iteration count moves with the last bit of the start.
struct PerturbedCounts {
  std::vector<long> counts;  ///< Counts of the runs that converged, in ascending order.
  long failed = 0;           ///< Runs that did not converge.

  [[nodiscard]] long least() const { return counts.empty() ? 0 : counts.front(); }
  [[nodiscard]] long most() const { return counts.empty() ? 0 : counts.back(); }
};

/// Counts of runs whose starts differ from the paper's by up to `size` in every entry; the same starts for
/// every setting.
PerturbedCounts perturbed_counts(const Setting& setting, long starts, double size,
                                 const avi::Stopping& stopping);

/// Calls visit(setting, slow) for each of the settings, with progress; `slow` are Direct ones of low order,
/// which are left out where `quick` is wanted.
void each_setting(const Frame& frame, const std::vector<Setting>& settings,
                  const std::function<void(const Setting&, bool slow)>& visit);

}  // namespace experiment
