#pragma once
#include <limits>
#include <span>

/// @file
/// Measured order of convergence.

namespace avi {

/// Which points of a convergence study count.
struct OrderOptions {
  double floor = 0.0;  ///< Errors at or below it are round-off and are dropped.
  int at_least = 3;    ///< With fewer points left there is no order: the fit says NaN.
  int at_most = 1000;  ///< Only that many of the smallest step sizes left are fitted; at least 1.
};

/// A measured order and what it rests on.
struct OrderFit {
  double order = std::numeric_limits<double>::quiet_NaN();  ///< Slope of log(error) over log(h).
  int points = 0;                                           ///< Points left by the filter and fitted.
};

/// Least-squares slope of log(error) over log(|h|), error ~ C |h|^order.
///
/// The plateau filter walks from the largest step to the smallest and ends at the first point that is at or
/// below options.floor, is not finite, or lies on a local slope of less than half the steepest one so far:
/// there round-off has taken over. Errors at larger h that are not finite (the method broke down) are
/// skipped.
/// @throws std::invalid_argument when h and error differ in length, a step size is zero or not finite, two
/// have the same |h|, or for at_least below 2 or at_most below 1.
OrderFit fit_order(std::span<const double> h, std::span<const double> error, OrderOptions options = {});

}  // namespace avi
