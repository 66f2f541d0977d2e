#pragma once
#include "avi/optim/objective.hpp"

#include <cstdint>
#include <sstream>

/// @file
/// Whether a gradient is that of the function: its slope along a line against differences of values.

namespace avi {

/// A slope by differences, and how far it may be off.
struct SlopeByValues {
  double slope;        ///< d . grad f.
  double uncertainty;  ///< By truncation and rounding.

  /// True where `by_gradient`, which may be off by `allowed`, cannot be told from it.
  [[nodiscard]] bool agrees_with(double by_gradient, double allowed) const {
    // A slope that is NaN says nothing about the gradient; the run itself will report it.
    return !(std::abs(slope - by_gradient) > allowed + uncertainty);
  }
  /// One clause with both numbers.
  [[nodiscard]] std::string against(double by_gradient) const {
    std::ostringstream clause;
    clause << "along a line f has the slope " << slope << " by its values and " << by_gradient
           << " by its gradient";
    return clause.str();
  }
};

/// Slope of phi at 0 by central differences at distance h and h / 8: four values. Their difference is the
/// uncertainty, with what rounding of the values adds.
template <class Phi>
SlopeByValues slope_by_values(Phi&& phi, double h) {
  double slopes[2], rounding = 0.0;
  for (double& slope : slopes) {
    const double ahead = phi(h), behind = phi(-h);
    slope = (ahead - behind) / (2.0 * h);
    rounding = 1e-15 * std::max(std::abs(ahead), std::abs(behind)) / h;
    h /= 8.0;
  }
  return {slopes[1], std::abs(slopes[1] - slopes[0]) + rounding};
}

/// A direction in which every entry takes part, by its size and with a weight of either sign between 1/2 and
/// 3/2.
inline void mixed_direction(const VectorX& x, VectorX& d) {
  const double largest = largest_entry(x);
  std::uint64_t bits = 1;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;  // Knuth's generator: signs need no better one
    const double weight = 0.5 + static_cast<double>((bits << 1) >> 33) * 0x1p-31;
    const double size = largest > 0.0 ? std::max(std::abs(x[i]), 0.01 * largest) : 1.0;
    d[i] = (bits >> 63) != 0 ? -weight * size : weight * size;
  }
}

}  // namespace avi
