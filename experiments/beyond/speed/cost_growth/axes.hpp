#pragma once
#include "common/table.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

// Along what the cost of a run grows.

namespace experiment {

/// One piece of work to be timed and how it went. (MethodOf is a method; here the piece may be
/// an expansion, a sweep or a gradient as well.)
struct Measurement {
  std::string subject{};  ///< Method, and monitor where it has one.
  double value = 0.0;     ///< Along the axis.
  long steps = 0;
  double energy_error = unknown;  ///< Largest |H - H_0| / |H_0| during the run, where it was observed.
  std::function<void()> run;      ///< The run alone, not observed.
  double units = 1.0;             ///< Seconds are divided by it.
};

/// Expected power of the value as it goes to its limit; NaN where there is nothing to expect.
struct Expected {
  std::string subject;
  double steps;     ///< Power of the value in the limit.
  double from, to;  ///< Range of the value that is fitted.
  /// Steps at a value that is not at its limit yet, but for a factor.
  std::function<double(double)> steps_at = [power = steps](double value) { return std::pow(value, power); };
};

/// An axis: its runs and what is expected of them.
struct Axis {
  std::string name;  ///< closeness (1 - e), periods, order (r) or dimension (n).
  std::vector<Measurement> runs{};
  std::vector<Expected> expected{};
};

/// Steps that keep the energy to 1e-6 over one Kepler orbit, with g = r^(2 gamma) and with none.
Axis along_eccentricity(bool quick);
/// Fixed steps over more and more periods at e = 0.9.
Axis along_horizon(bool quick);
/// One Taylor expansion of order r, with partials and the Gauss rule of the method.
Axis along_order();
/// Chains of n masses: H, its automatic gradient, and a sweep of collocation, each at eight stages side by
/// side.
Axis along_dimension(bool quick);

}  // namespace experiment
