#pragma once
#include "common/frame.hpp"
#include "common/methods/runner.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

/// @file
/// Tables 1 and 2 of the paper: one Kepler orbit, HTVI4 with and without monitors against Stormer-Verlet.

namespace experiment {

/// A row of the published table: the monitor of an HTVI4 run with its bounds g_min = a, g_max = b.
struct KeplerRow {
  std::string monitor;  ///< gamma, energy, arclength or none
  double h;
  double a, b;
};

/// One table.
struct KeplerTable {
  double eccentricity;
  std::vector<KeplerRow> htvi;
  double verlet_h = unknown;
  int rounds = 1;  ///< of the interleaved timing
};

/// What one run of a method gives. The errors are infinite where it does not reach its end.
struct KeplerResult {
  double min_step = HUGE_VAL, max_step = 0.0;
  double energy_error = 0.0;          ///< max over the steps of |H - H_0|
  double global_error = 0.0;          ///< |q - exact q| at the end, both at the method's own time
  double global_error_shifted = 0.0;  ///< state before the last step against the exact one at the end
  long steps = 0, evaluations = 0;
};

/// A row ready to run.
struct KeplerRun {
  std::string method, construction;
  KeplerRow row;
  Runner runner;
  double eccentricity;  ///< It starts at the pericentre.
  avi::Until until;

  [[nodiscard]] KeplerResult measure() const;
  /// Shows every state.
  [[nodiscard]] avi::Run observe(const std::function<void(const State2&)>& observer) const;
  /// What is timed. @throws std::runtime_error when the run does not reach its end.
  void run() const;
};

/// The settings of Table 1 (e = 0.9) and Table 2 (e = 0.99). Where they differ from the printed ones,
/// kepler/table.cpp says why.
KeplerTable table1();
KeplerTable table2();

/// The HTVI4 runs of a table by the construction `authors`, `printed` or `stationary`.
/// @throws std::invalid_argument for another one.
std::vector<KeplerRun> htvi4_runs(const std::string& construction, const KeplerTable& table, double horizon);

/// main() of kepler_e090 and kepler_e099.
int kepler_table(int argc, char** argv, const std::string& shows, const KeplerTable& table);

}  // namespace experiment
