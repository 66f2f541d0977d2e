#include "beyond/speed/work_precision/advice.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace experiment::work_precision {
namespace {

constexpr std::array targets{1e-3, 1e-5, 1e-7, 1e-9, 1e-11};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Costs that were measured elsewhere (paper/elsewhere.tsv says how).
const experiment::Table& elsewhere() {
  static const auto table = experiment::Table::read(AVI_ELSEWHERE);
  return table;
}

const Point* cheapest(const std::vector<Point>& points, Origin origin, double target) {
  const Point* best = nullptr;
  for (const Point& p : points)
    if (p.family->origin == origin && p.position_error <= target && (!best || p.seconds < best->seconds))
      best = &p;
  return best;
}

double cost(const Point* p, double unit) { return p ? p->seconds / unit : nan; }
std::string method(const Point* p) {
  if (!p) return "none";
  if (p->family->method == "htvi" || p->family->method == "collocation")
    return p->family->method + std::to_string(p->family->order);
  return p->family->method;
}
std::string setting(const Point* p) { return p ? p->label() : "none"; }

}  // namespace

std::vector<std::string> advice_columns() {
  return {"problem",
          "eccentricity",
          "horizon",
          "target",
          "method",
          "setting",
          "cost",
          "energy_error",
          "htvi",
          "htvi_setting",
          "htvi_cost",
          "peer",
          "peer_setting",
          "peer_cost",
          "elsewhere",
          "elsewhere_cost",
          "ratio",
          "verdict",
          "htvi_ratio",
          "collocation",
          "collocation_setting",
          "collocation_cost",
          "collocation_ratio"};
}

void advise(experiment::Table& table, const Scene& scene, const std::vector<Point>& points, double unit) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Point* ours = cheapest(points, Origin::ours_explicit, targets[i]);
    const Point* htvi = cheapest(points, Origin::htvi, targets[i]);
    const Point* peer = cheapest(points, Origin::peer, targets[i]);
    const Point* curve = cheapest(points, Origin::collocation, targets[i]);
    const Point* best = nullptr;
    for (const Point* p : {ours, curve, htvi})
      if (p && (!best || p->seconds < best->seconds)) best = p;
    std::string other = "none";
    double other_cost = nan;
    for (std::size_t row = 0; row < elsewhere().rows.size(); ++row)
      if (elsewhere().text(row, "problem") == scene.problem &&
          elsewhere().number(row, "eccentricity") == scene.eccentricity &&
          elsewhere().text(row, "horizon") == scene.horizon_name &&
          elsewhere().number(row, "target") == targets[i]) {
        other = elsewhere().text(row, "method");
        other_cost = elsewhere().number(row, "cost");
      }
    const double rival = std::fmin(cost(peer, unit), other_cost);
    const double ratio = cost(best, unit) / rival;
    const char* verdict = !best               ? (std::isnan(rival) ? "none" : "behind")
                          : std::isnan(rival) ? "alone"
                          : ratio <= 1.0      ? "ahead"
                                              : "behind";
    table.row(scene.problem, scene.eccentricity, scene.horizon_name, targets[i], method(best), setting(best),
              experiment::rounded(cost(best, unit), 3),
              experiment::rounded(best ? best->energy_error : nan, 3), method(htvi), setting(htvi),
              experiment::rounded(cost(htvi, unit), 3), method(peer), setting(peer),
              experiment::rounded(cost(peer, unit), 3), other, experiment::rounded(other_cost, 3),
              experiment::rounded(ratio, 3), verdict, experiment::rounded(cost(htvi, unit) / rival, 3),
              method(curve), setting(curve), experiment::rounded(cost(curve, unit), 3),
              experiment::rounded(cost(curve, unit) / rival, 3));
  }
}

}  // namespace experiment::work_precision
