#pragma once
#include "beyond/speed/work_precision/measure.hpp"
#include "common/frame.hpp"

// Which method to use for a given problem, horizon and accuracy, and what it costs.

namespace experiment::work_precision {

inline const Point* cheapest(const std::vector<Point>& points, Origin origin, double target) {
  const Point* best = nullptr;
  for (const Point& p : points)
    if (p.family->origin == origin && p.position_error <= target && (!best || p.seconds < best->seconds))
      best = &p;
  return best;
}

/// True if the equations of the steps are solved to rounding, as a symplectic run requires.
inline bool solved(const Point& p) { return p.family->knob.find("tolerance=") == std::string::npos; }

inline std::string method(const Point* p) {
  if (!p) return "none";
  if (p->family->method == "htvi" || p->family->method == "collocation")
    return p->family->method + std::to_string(p->family->order);
  return p->family->method;
}

/// Costs of one library measured in two places differ by up to this factor. A ratio to a cost measured
/// elsewhere that is nearer to 1 is inconclusive.
inline constexpr double spread_elsewhere = 1.43;

/// The table filled by advise().
inline Table& advice_table(Frame& frame) {
  Table& table = frame.table("advice", {"problem", "eccentricity", "horizon", "target", "method", "setting",
                                        "cost", "energy_error"});
  table.columns.insert(table.columns.end(),
                       {"htvi", "peer", "peer_cost", "elsewhere", "elsewhere_cost", "ratio", "verdict",
                        "htvi_ratio", "collocation", "collocation_setting", "collocation_cost",
                        "collocation_ratio", "collocation_solved", "solved", "solved_setting", "solved_cost",
                        "solved_ratio", "unsure", "drift"});
  return table;
}

/// One row per target 1e-3, 1e-5, 1e-7, 1e-9, 1e-11: the cheapest measured setting that reaches it among all
/// our methods, among HTVI, collocation and the peers, costs in units of `unit` seconds; and for Kepler's
/// problem the cheapest of libraries that are not packaged (heyoka, REBOUND), measured once with the same
/// problem, starts and unit on another machine.
/// `collocation` is the cheapest setting whatever ends its sweeps, `solved` the cheapest whose sweeps end at
/// rounding; `collocation_solved` says whether the former's do. `unsure` is 1 where the ratio of `solved` to
/// a library that was measured elsewhere is within the spread between machines. `drift` is by how much of
/// itself the unit moved while the scene was measured.
inline void advise(Table& table, const Scene& scene, const std::vector<Point>& points, double unit,
                   double drift) {
  static const Table elsewhere = Table::read(AVI_ELSEWHERE);  // costs measured elsewhere
  for (const double target : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    const Point* ours = cheapest(points, Origin::ours_explicit, target);
    const Point* htvi = cheapest(points, Origin::htvi, target);
    const Point* peer = cheapest(points, Origin::peer, target);
    const Point* curve = cheapest(points, Origin::collocation, target);
    std::vector<Point> to_rounding;
    for (const Point& p : points)
      if (p.family->origin == Origin::collocation && solved(p)) to_rounding.push_back(p);
    const Point* exact = cheapest(to_rounding, Origin::collocation, target);
    const Point* best = nullptr;
    for (const Point* p : {ours, curve, htvi})
      if (p && (!best || p->seconds < best->seconds)) best = p;
    std::string other = "none";
    double other_cost = unknown;
    for (std::size_t row = 0; row < elsewhere.rows.size(); ++row)
      if (elsewhere.text(row, "problem") == scene.problem &&
          elsewhere.number(row, "eccentricity") == scene.eccentricity &&
          elsewhere.text(row, "horizon") == scene.horizon_name && elsewhere.number(row, "target") == target) {
        other = elsewhere.text(row, "method");
        other_cost = elsewhere.number(row, "cost");
      }
    const auto cost = [&](const Point* p) { return p ? p->seconds / unit : unknown; };
    const auto setting = [](const Point* p) { return p ? p->label() : "none"; };
    const double rival = std::fmin(cost(peer), other_cost), solved_ratio = cost(exact) / rival;
    const bool unsure = rival == other_cost && std::max(solved_ratio, 1.0 / solved_ratio) < spread_elsewhere;
    const double ratio = cost(best) / rival;
    const char* verdict = !best               ? (std::isnan(rival) ? "none" : "behind")
                          : std::isnan(rival) ? "alone"
                          : ratio <= 1.0      ? "ahead"
                                              : "behind";
    table.row(scene.problem, scene.eccentricity, scene.horizon_name, target, method(best), setting(best),
              rounded(cost(best), 3), rounded(best ? best->energy_error : unknown, 3), method(htvi),
              method(peer), rounded(cost(peer), 3), other, rounded(other_cost, 3), rounded(ratio, 3), verdict,
              rounded(cost(htvi) / rival, 3), method(curve), setting(curve), rounded(cost(curve), 3),
              rounded(cost(curve) / rival, 3), curve && solved(*curve), method(exact), setting(exact),
              rounded(cost(exact), 3), rounded(solved_ratio, 3), unsure, rounded(drift, 3));
  }
}

}  // namespace experiment::work_precision
