#pragma once
#include "avi/core/state.hpp"

#include <cmath>
#include <functional>
#include <string>

// Symplectic Euler-B along a Kepler orbit with any monitor of the paper, chosen by name.

namespace experiment {

/// A run's setting. The truncation monitors take both numbers: tol is the accuracy asked for, h the fictive
/// step that their formula contains; the others have no tol (NaN).
struct EulerBSetting {
  std::string monitor;  ///< none, truncation, truncation_root, arclength or norm_squared
  double h;
  double tol = std::nan("");
};

/// The setting whose steps are proportional to `size`: h itself, or for the truncation monitors tol at h = 1,
/// where |q|^2 grad V has norm 1 and so g = 2 tol |q|^2 and (2 tol |q|^2)^(1/4).
EulerBSetting euler_b_setting(const std::string& monitor, double size);

/// Largest errors of a run and what it cost.
struct EulerBResult {
  double energy_error = 0.0;
  double angular_momentum_error = 0.0;
  long steps = 0;
  double seconds = 0.0;  ///< with the two errors watched at every step
};

/// Sees every step: state, energy error, angular momentum error.
using EulerBObserver = std::function<void(const avi::State<2>&, double, double)>;

/// Runs to `horizon`. @throws std::invalid_argument for an unknown monitor, std::runtime_error when the run
/// does not reach its end.
EulerBResult run_euler_b(const EulerBSetting& setting, double e, double horizon,
                         const EulerBObserver& observe = {});

/// The setting of `monitor` whose largest energy error is `target`, found on a short horizon.
EulerBSetting calibrated_euler_b(const std::string& monitor, double e, double target, double horizon);

}  // namespace experiment
