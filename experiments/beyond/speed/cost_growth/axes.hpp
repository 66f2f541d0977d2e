#pragma once
#include "common/table.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

// The axes along which the cost of a run grows.

namespace experiment {

/// One piece of work to be timed, and its result. (MethodOf is a method; the piece may also be an expansion,
/// a sweep or a gradient.)
struct Measurement {
  std::string subject{};  ///< Method, and monitor where it has one.
  double value = 0.0;     ///< Position on the axis.
  long steps = 0;
  double energy_error = unknown;  ///< Largest |H - H_0| / |H_0| during the run, if it was observed.
  std::function<void()> run;      ///< The run itself, without observation.
  double units = 1.0;             ///< Divisor of the seconds.
};

/// Expected exponent of the value towards its limit; NaN if there is no expectation.
struct Expected {
  std::string subject;
  double steps;     ///< Exponent of the value in the limit.
  double from, to;  ///< Range of the value for the fit.
  /// Expected steps, up to a factor, at a value that has not reached its limit.
  std::function<double(double)> steps_at = [power = steps](double value) { return std::pow(value, power); };
};

/// An axis: its runs, and the expectations.
struct Axis {
  std::string name;  ///< closeness (1 - e), periods, order (r) or dimension (n).
  std::vector<Measurement> runs{};
  std::vector<Expected> expected{};
};

/// Steps that keep the energy to 1e-6 over one Kepler orbit, with g = r^(2 gamma) and without a monitor.
Axis along_eccentricity(bool quick);
/// Steps of fixed size, fictive where there is a monitor, over an increasing number of periods at e = 0.9.
Axis along_horizon(bool quick);
/// One Taylor expansion of order r, with its partials and the Gauss rule of the method.
Axis along_order();
/// Chains of n masses: H, its automatic gradient, and a sweep of collocation, each at eight stages at once.
Axis along_dimension(bool quick);

}  // namespace experiment
