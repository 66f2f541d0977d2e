#pragma once
#include <functional>
#include <string>
#include <vector>

/// @file
/// Measured order of HTVI for every Taylor order, rule, type and problem.

namespace experiment {

/// One cell of the grid.
struct OrderCell {
  std::string problem, type, construction;
  int r;
  std::string quadrature;
  int expected;     ///< min(r + 1, s)
  double measured;  ///< NaN when too few points lie between breakdown and round-off
  int points;
};

/// All cells of one construction; `done(fraction)` reports progress.
std::vector<OrderCell> order_cells_printed(bool quick, const std::function<void(double)>& done);
std::vector<OrderCell> order_cells_superconvergent(bool quick, const std::function<void(double)>& done);

}  // namespace experiment
