#pragma once
#include "beyond/speed/work_precision/measure.hpp"

#include "common/frame.hpp"

#include <vector>

/// @file
/// For this problem, horizon and accuracy: which method to use and what it costs.

namespace experiment::work_precision {

/// The table that advise() fills.
Table advice_table(const Frame& frame);

/// One row per target 1e-3, 1e-5, 1e-7, 1e-9, 1e-11: the cheapest measured setting that reaches it among all
/// our methods, among HTVI, collocation and the peers, costs in units of `unit` seconds; and for Kepler's
/// problem the cheapest of libraries that are not packaged (heyoka, REBOUND), measured once with the same
/// problem, starts and unit on another machine.
void advise(Table& table, const Scene& scene, const std::vector<Point>& points, double unit);

}  // namespace experiment::work_precision
