#pragma once
#include "avi/core/require.hpp"
#include "avi/integrators/runge_kutta.hpp"

#include <algorithm>
#include <cmath>

/// @file
/// Step-size control for embedded Runge-Kutta pairs (Hairer, Norsett and Wanner 1993, Section II.4).

namespace avi {

/// Tolerances of a step, and limits on the ratio of successive steps.
struct StepControl {
  double rtol = 1e-3;    ///< Relative tolerance, positive.
  double atol = 1e-6;    ///< Absolute tolerance, positive.
  double safety = 0.9;   ///< In (0, 1).
  double shrink = 0.2;   ///< Least factor from step to step, in (0, 1).
  double grow = 5.0;     ///< Largest factor, above 1.
  int rejections = 100;  ///< Cap on rejected trials of one step, at least 1.

  /// Checks the ranges. @throws std::invalid_argument for a value out of range.
  void validate() const {
    require_positive("Relative tolerance", rtol);
    require_positive("Absolute tolerance", atol);
    require(safety > 0.0 && safety < 1.0, "Safety factor", safety, "in (0, 1)");
    require(shrink > 0.0 && shrink < 1.0, "Least step factor", shrink, "in (0, 1)");
    require(std::isfinite(grow) && grow > 1.0, "Largest step factor", grow, "finite and above 1");
    require(rejections >= 1, "Cap on rejected steps", rejections, "at least 1");
  }
};

/// Root mean square over the components of (step of T - step of the embedded method) / (atol + rtol |z|),
/// |z| the larger of the magnitudes at both ends; at most 1 for a step that is accepted.
template <EmbeddedTableau T>
double scaled_error(const RungeKuttaStages<T>& stages, const VectorX& z, double h,
                    const StepControl& control) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    double error = 0.0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(T::stages); ++j)
      error += (T::b[j] - T::embedded[j]) * stages.k[j][i];
    const double scale = control.atol + control.rtol * std::max(std::abs(z[i]), std::abs(stages.end[i]));
    sum += (h * error / scale) * (h * error / scale);
  }
  return std::sqrt(sum / static_cast<double>(z.size()));
}

/// Factor for the next step after a scaled error; the smaller order + 1 is the exponent.
template <EmbeddedTableau T>
double step_factor(double error, const StepControl& control) {
  const double exponent = 1.0 / (1.0 + std::min(T::order, T::embedded_order));
  if (!(error > 0.0)) return std::isnan(error) ? control.shrink : control.grow;
  return std::clamp(control.safety * std::pow(error, -exponent), control.shrink, control.grow);
}

/// Takes one accepted step from z, where stages.k[0] = F(z), beginning with a trial of size h, and leaves in
/// h the size to try next. stages.end is the new point. Returns the size of the step taken, or 0 when the cap
/// on rejections was met.
template <EmbeddedTableau T, class Field>
double controlled_step(RungeKuttaStages<T>& stages, Field&& field, const VectorX& z, double& h,
                       const StepControl& control) {
  for (int trial = 0; trial <= control.rejections; ++trial) {
    stages.advance(field, z, h);
    const double error = scaled_error(stages, z, h, control);
    const double factor = step_factor<T>(error, control);
    if (error <= 1.0) {
      // No growth right after a rejection: the estimate there is at its least reliable.
      const double taken = h;
      h *= trial > 0 ? std::min(factor, 1.0) : factor;
      return taken;
    }
    h *= std::min(factor, 0.9);
  }
  return 0.0;
}

}  // namespace avi
