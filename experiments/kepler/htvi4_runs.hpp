#pragma once
#include "kepler/table.hpp"

#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"

/// @file
/// HTVI4 - Type II, r = 3, Simpson's rule; stationary, r = 1 and two Gauss nodes - for every row of a table.
/// Included by one source file per construction, so that they compile side by side.

namespace experiment {

template <avi::Construction construction>
std::vector<KeplerRun> htvi4_runs(const std::string& construction_name, const KeplerTable& table,
                                  double horizon) {
  const auto start = avi::Kepler::pericentre(table.eccentricity);
  const avi::Kepler kepler;
  const double energy = kepler(start.q, start.p);
  std::vector<KeplerRun> runs;
  const auto add = [&](const KeplerRow& row, auto monitor) {
    const auto make = [=](const State2& from) {
      const auto problem = avi::poincare<2>(kepler, from, monitor);
      if constexpr (construction == avi::stationary)
        return avi::htvi<4>(problem);
      else
        return avi::type2<3, construction>(problem, avi::simpson());
    };
    runs.push_back({"htvi4", construction_name, row, Runner(kepler, make), table.eccentricity, start,
                    avi::Until{.time = horizon}});
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
