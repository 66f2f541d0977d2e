#pragma once
#include <span>

/// @file
/// The linear drift of a quantity that should be conserved.

namespace avi {

/// A straight line fitted to a time series, with the uncertainty of its slope.
struct DriftFit {
  double slope = 0.0;           ///< Change per unit of time.
  double standard_error = 0.0;  ///< Standard error of the slope.
  double t_statistic = 0.0;     ///< slope / standard_error; for |t| < 2 the series shows no drift.
  double correlation = 0.0;     ///< Correlation of neighbouring residuals, in [-1, 1].
  int points = 0;               ///< Number of points fitted (of blocks, if there are any).
};

/// slope / standard_error, corrected for the correlation of neighbouring residuals: n correlated residuals
/// count as \f$n (1 - r)/(1 + r)\f$ independent ones, where r is the correlation if it is positive, otherwise
/// 0 (von Storch and Zwiers 1999, Section 6.6).
double corrected_t(const DriftFit& fit);

/// Least-squares line value = intercept + slope t, with the standard error of its slope.
///
/// The error formula assumes independent residuals, whereas an energy error oscillates along the orbit. With
/// `blocks` > 0 the series is therefore first averaged over this number of equal blocks, each of which should
/// span many oscillations. If the block averages are still correlated, as on an orbit that returns to the
/// same phases of its steps only after many blocks, corrected_t() takes this into account.
/// @throws std::invalid_argument if the lengths differ, fewer than 3 points (or blocks) are left, a time is
/// not finite, or all times are equal.
DriftFit fit_drift(std::span<const double> times, std::span<const double> values, int blocks = 0);

}  // namespace avi
