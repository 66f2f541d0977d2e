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
/// `collocation` is the cheapest setting whatever ends its sweeps, `solved` the cheapest whose sweeps end at
/// rounding; `collocation_solved` says whether the former's do. `unsure` is 1 where the ratio of `solved` to
/// a library that was measured elsewhere is within the spread between machines. `drift` is by how much of
/// itself the unit moved while the scene was measured.
void advise(Table& table, const Scene& scene, const std::vector<Point>& points, double unit, double drift);

}  // namespace experiment::work_precision
