#pragma once
#include <functional>
#include <string>
#include <vector>

/// @file
/// Measured order of HTVI for every Taylor order, rule, type, construction and class of problem.

namespace experiment {

/// One cell of the grid.
struct OrderCell {
  std::string problem, type, construction;
  int r;
  std::string quadrature;
  int expected;     ///< At least: stationary min(2r + 2, max(r + 1, s)), others min(r + 1, s).
  double measured;  ///< NaN when too few points lie between breakdown and round-off
  double limit;     ///< Slope extrapolated to h = 0, NaN with fewer than eight points
  int points;
};

/// Cells of the problems without monitor: T quadratic, relativistic, not separable, Kepler.
std::vector<OrderCell> order_cells_without_monitor(bool quick, const std::function<void(double)>& done);
/// Kepler's problem with monitors of the position.
std::vector<OrderCell> order_cells_of_monitors(bool quick, const std::function<void(double)>& done);
/// A monitor of position and momentum, and a Hamiltonian that depends on time.
std::vector<OrderCell> order_cells_of_general_problems(bool quick, const std::function<void(double)>& done);

}  // namespace experiment
