#pragma once
#include <limits>
#include <span>

/// @file
/// The measured order of convergence of a method.

namespace avi {

/// Which points of a convergence study are fitted.
struct OrderOptions {
  double floor = 0.0;  ///< Errors at or below it are dropped as round-off.
  int at_least = 3;    ///< With fewer points left, the order is NaN.
  int at_most = 1000;  ///< Number of points, with the smallest steps, that are fitted at most; at least 1.
};

/// A measured order, and the number of points it is based on.
struct OrderFit {
  double order = std::numeric_limits<double>::quiet_NaN();  ///< Slope of log(error) over log(h).
  int points = 0;                                           ///< Number of points fitted.
};

/// Least-squares slope of log(error) over log(|h|), error ~ C |h|^order.
///
/// The filter against round-off goes from the largest step to the smallest. It ends at the first point whose
/// error is at or below options.floor or not finite, or at which the local slope is less than half the
/// steepest one so far: round-off has taken over there. Errors that are not finite at larger h, where the
/// method broke down, are skipped.
/// @throws std::invalid_argument if h and error differ in length, a step size is zero or not finite, two have
/// the same |h|, or for at_least below 2 or at_most below 1.
OrderFit fit_order(std::span<const double> h, std::span<const double> error, OrderOptions options = {});

}  // namespace avi
