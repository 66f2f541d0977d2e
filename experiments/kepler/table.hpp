#pragma once
#include "common/frame.hpp"
#include "common/methods/method_of_orbit.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

// Tables 1 and 2 of the paper: one Kepler orbit, HTVI with and without monitors against Stormer-Verlet.

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
  int rounds = 1;         ///< of the interleaved timing
  double horizon = 10.0;  ///< Physical time T to reach.
};

/// The result of one run of a method. Its errors are infinite where it does not reach its end.
struct KeplerResult {
  double min_step = HUGE_VAL, max_step = 0.0;
  double energy_error = 0.0;          ///< max over the steps of |H - H_0|
  double global_error = 0.0;          ///< |q - exact q| at the end, both at the method's own time
  double global_error_shifted = 0.0;  ///< state before the last step against the exact one at the end
  long steps = 0, evaluations = 0;
};

/// The key of an integrator of the tables.
struct HtviName {
  std::string method;                ///< htvi4, the source's; htvi, ours; or stormer_verlet
  std::string construction = "nan";  ///< authors, printed or stationary
  double r = unknown;                ///< Taylor order
  std::string rule = "nan";          ///< simpson or gauss with the number of its nodes
};

/// A row ready to run.
struct KeplerRun {
  HtviName name;
  KeplerRow row;
  Method2 runner;
  double eccentricity;  ///< It starts at the pericentre.
  avi::Until until;

  [[nodiscard]] KeplerResult measure() const;
  /// Shows every state.
  [[nodiscard]] avi::Run observe(const std::function<void(const State2&)>& observer) const;
  /// The run that is timed. @throws std::runtime_error when the run does not reach its end.
  void run() const;
};

/// The settings of Table 1 (e = 0.9) and Table 2 (e = 0.99). Where they differ from the printed ones,
/// kepler/table.cpp says why.
KeplerTable table1();
KeplerTable table2();

/// The runs of the source's HTVI4, r = 3 with Simpson's rule, by the construction `authors` or `printed`;
/// with the rule `gauss4`, four Gauss nodes, the control that tells the rule from the velocity.
/// @throws std::invalid_argument for another construction.
std::vector<KeplerRun> htvi4_runs(const std::string& construction, const KeplerTable& table,
                                  const std::string& rule = "simpson");

/// The stationary construction at the same settings: r = 3 with four Gauss nodes, which is the default and
/// has order 8; with Simpson's rule, order 4; and r = 1 with two Gauss nodes, order 4.
std::vector<KeplerRun> stationary_runs(const KeplerTable& table);

/// The experiments kepler_e090 and kepler_e099.
void kepler_table(Frame& frame, const KeplerTable& table);

}  // namespace experiment
