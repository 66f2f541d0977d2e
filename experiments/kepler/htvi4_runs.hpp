#pragma once
#include "kepler/measure.hpp"

#include "avi/adaptive/monitors.hpp"
#include "avi/htvi/htvi.hpp"

/// @file
/// HTVI4 - Type II, r = 3, Simpson's rule - for every row of a table. Included by one source file per
/// construction, so that they compile side by side.

namespace experiment {

template <avi::Construction construction>
std::vector<KeplerRun> htvi4_runs(const std::string& construction_name, const KeplerTable& table,
                                  double horizon) {
  const auto start = avi::Kepler::pericentre(table.eccentricity);
  const avi::Kepler kepler;
  const double energy = kepler(start.q, start.p);
  std::vector<KeplerRun> runs;
  const auto add = [&](const KeplerRow& row, auto monitor) {
    const auto problem = avi::poincare<2>(kepler, start, monitor);
    runs.push_back(kepler_run("htvi4", construction_name, row,
                              avi::type2<3, construction>(problem, avi::simpson()), table.eccentricity,
                              {.time = horizon}));
  };
  for (const KeplerRow& row : table.htvi) {
    if (row.monitor == "gamma")
      add(row, avi::bounded(avi::NormSquared{}, row.a, row.b));
    else if (row.monitor == "energy")
      add(row, avi::bounded(avi::Energy{kepler, -energy}, row.a, row.b));
    else if (row.monitor == "arclength")
      add(row, avi::bounded(avi::Arclength{kepler, energy}, row.a, row.b));
    else
      add(row, avi::Unit{});
  }
  return runs;
}

}  // namespace experiment
