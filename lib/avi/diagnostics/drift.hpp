#pragma once
#include <span>

/// @file
/// Drift of a quantity that should be conserved.

namespace avi {

/// Straight line through a time series and how sure its slope is.
struct DriftFit {
  double slope = 0.0;           ///< Change per unit of time.
  double standard_error = 0.0;  ///< Standard error of the slope.
  double t_statistic = 0.0;     ///< slope / standard_error; |t| < 2 is no drift that this series can show.
  double correlation = 0.0;     ///< Correlation of each residual with the next one, in [-1, 1].
  int points = 0;               ///< Points fitted (blocks, when blocks were asked for).
};

/// slope / standard_error where neighbouring residuals are correlated: n of them say as much as
/// \f$n (1 - r)/(1 + r)\f$ independent ones, r the correlation where it is positive (von Storch and Zwiers
/// 1999, Section 6.6).
double corrected_t(const DriftFit& fit);

/// Least-squares line value = intercept + slope t, with the standard error of its slope.
///
/// The error formula supposes independent residuals, while an energy error oscillates with the orbit: with
/// `blocks` > 0 the series is first averaged over that many equal blocks, each of which should span many
/// oscillations. Where blocks still hang together (an orbit that comes back to the same phases of its steps
/// after many blocks), corrected_t() takes it into account.
/// @throws std::invalid_argument when lengths differ, fewer than 3 points (or blocks) are left, a time is not
/// finite, or all times are the same.
DriftFit fit_drift(std::span<const double> times, std::span<const double> values, int blocks = 0);

}  // namespace avi
