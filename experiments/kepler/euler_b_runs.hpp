#pragma once
#include "frame/timing.hpp"
#include "kepler/measure.hpp"

#include "avi/adaptive/euler_b.hpp"
#include "avi/adaptive/monitors.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

/// @file
/// Symplectic Euler-B along a Kepler orbit with any monitor of the paper, chosen by name.

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
inline EulerBSetting euler_b_setting(const std::string& monitor, double size) {
  if (monitor == "truncation") return {monitor, 1.0, 0.5 * size};
  if (monitor == "truncation_root") return {monitor, 1.0, 0.5 * std::pow(size, 4)};
  return {monitor, size};
}

/// Calls use(method) with the Euler-B method of a setting.
template <class Use>
auto with_euler_b(const EulerBSetting& setting, double e, Use use) {
  const avi::Kepler kepler;
  const auto start = avi::Kepler::pericentre(e);
  const double energy = kepler(start.q, start.p);
  const std::string& monitor = setting.monitor;
  if (monitor == "none") return use(avi::euler_b<2>(kepler, start));
  if (monitor == "truncation")
    return use(avi::euler_b<2>(kepler, start, avi::Truncation{kepler, setting.tol, setting.h}));
  if (monitor == "truncation_root")
    return use(avi::euler_b<2>(kepler, start, avi::TruncationRoot{kepler, setting.tol, setting.h}));
  if (monitor == "arclength") return use(avi::euler_b<2>(kepler, start, avi::Arclength{kepler, energy}));
  if (monitor == "norm_squared") return use(avi::euler_b<2>(kepler, start, avi::NormSquared{}));
  throw std::invalid_argument("Monitor '" + monitor + "' is unknown.");
}

/// Largest errors of a run and what it cost.
struct EulerBResult {
  double energy_error = 0.0;
  double angular_momentum_error = 0.0;
  long steps = 0;
  double seconds = 0.0;  ///< with the two errors watched at every step
};

/// Runs to `horizon`; observe(state, energy error, angular momentum error) sees every step.
template <class Observe>
EulerBResult run_euler_b(const EulerBSetting& setting, double e, double horizon, Observe observe) {
  return with_euler_b(setting, e, [&](auto method) {
    const avi::Kepler kepler;
    avi::State<2> z = avi::Kepler::pericentre(e);
    const double energy = kepler(z.q, z.p), momentum = avi::Kepler::angular_momentum(z);
    EulerBResult result;
    result.seconds = seconds([&] {
      const auto run =
          avi::integrate(method, z, setting.h, {.time = horizon}, [&](const avi::State<2>& s, long) {
            const double energy_error = std::abs(kepler(s.q, s.p) - energy);
            const double momentum_error = std::abs(avi::Kepler::angular_momentum(s) - momentum);
            result.energy_error = std::max(result.energy_error, energy_error);
            result.angular_momentum_error = std::max(result.angular_momentum_error, momentum_error);
            observe(s, energy_error, momentum_error);
          });
      require_ok(run);
      result.steps = run.steps;
    });
    return result;
  });
}

inline EulerBResult run_euler_b(const EulerBSetting& setting, double e, double horizon) {
  return run_euler_b(setting, e, horizon, [](const auto&, double, double) {});
}

/// The setting of `monitor` whose largest energy error is `target`, found on a short horizon: the error is
/// nearly proportional to the step, so a few corrections of the size suffice.
inline EulerBSetting calibrated_euler_b(const std::string& monitor, double e, double target, double horizon) {
  double size = 0.1 * target;  // small enough to be stable for every monitor
  for (int k = 0; k < 6; ++k) {
    const double ratio = target / run_euler_b(euler_b_setting(monitor, size), e, horizon).energy_error;
    size *= ratio;
    if (std::abs(ratio - 1.0) < 1e-3) break;
  }
  return euler_b_setting(monitor, size);
}

}  // namespace experiment
