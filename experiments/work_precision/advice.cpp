#include "work_precision/advice.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace experiment::work_precision {
namespace {

constexpr std::array targets{1e-3, 1e-5, 1e-7, 1e-9, 1e-11};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Best of GSL, Boost.odeint, SUNDIALS, REBOUND (IAS15, Bulirsch-Stoer) and heyoka, each at its best setting,
/// in units of the Stormer-Verlet run; measured once beforehand.
struct Elsewhere {
  double eccentricity;
  bool long_horizon;
  std::array<double, 5> cost;
  std::array<const char*, 5> method;
};
const std::array<Elsewhere, 6> elsewhere{{
    {0.9,
     false,
     {0.0026, 0.0033, 0.0042, 0.0050, 0.0059},
     {"odeint_fehlberg78", "odeint_fehlberg78", "heyoka", "heyoka", "heyoka"}},
    {0.99,
     false,
     {0.0039, 0.0057, 0.0076, 0.0080, 0.0106},
     {"odeint_fehlberg78", "heyoka", "heyoka", "heyoka", "heyoka"}},
    {0.999,
     false,
     {0.0073, 0.0092, 0.0104, 0.0130, 0.0155},
     {"heyoka", "heyoka", "heyoka", "heyoka", "heyoka"}},
    {0.9, true, {3.2, 4.3, 4.5, 69.0, nan}, {"heyoka", "heyoka", "heyoka", "rebound_ias15", "none"}},
    {0.99, true, {6.1, 7.3, 9.9, nan, nan}, {"heyoka", "heyoka", "heyoka", "none", "none"}},
    {0.999, true, {10.0, 11.7, nan, nan, nan}, {"heyoka", "heyoka", "none", "none", "none"}},
}};

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
  if (p->family->method == "htvi") return "htvi" + std::to_string(p->family->order);
  if (p->family->method == "htvi_value_first")
    return "htvi" + std::to_string(p->family->order) + "_value_first";
  return p->family->method;
}
std::string setting(const Point* p) { return p ? p->label() : "none"; }

}  // namespace

std::vector<std::string> advice_columns() {
  return {"problem",        "eccentricity", "horizon",      "target",     "method",
          "setting",        "cost",         "energy_error", "htvi",       "htvi_setting",
          "htvi_cost",      "peer",         "peer_setting", "peer_cost",  "elsewhere",
          "elsewhere_cost", "ratio",        "verdict",      "htvi_ratio", "htvi_polynomial"};
}

void advise(avi::Table& table, const Scene& scene, const std::vector<Point>& points, double unit) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Point* ours = cheapest(points, Origin::ours_explicit, targets[i]);
    const Point* htvi = cheapest(points, Origin::htvi, targets[i]);
    const Point* peer = cheapest(points, Origin::peer, targets[i]);
    const Point* best = !ours || (htvi && htvi->seconds < ours->seconds) ? htvi : ours;
    std::string other = "none";
    double other_cost = nan;
    const bool is_long = scene.horizon_name == "1000 periods";
    if (scene.problem == "kepler" && (is_long || scene.horizon_name == "10"))
      for (const Elsewhere& row : elsewhere)
        if (row.eccentricity == scene.eccentricity && row.long_horizon == is_long) {
          other = row.method[i];
          other_cost = row.cost[i];
        }
    const double rival = std::fmin(cost(peer, unit), other_cost);
    const double ratio = cost(best, unit) / rival;
    const char* verdict = !best               ? (std::isnan(rival) ? "none" : "behind")
                          : std::isnan(rival) ? "alone"
                          : ratio <= 1.0      ? "ahead"
                                              : "behind";
    table.row(scene.problem, scene.eccentricity, scene.horizon_name, targets[i], method(best), setting(best),
              avi::rounded(cost(best, unit), 3), avi::rounded(best ? best->energy_error : nan, 3),
              method(htvi), setting(htvi), avi::rounded(cost(htvi, unit), 3), method(peer), setting(peer),
              avi::rounded(cost(peer, unit), 3), other, avi::rounded(other_cost, 3), avi::rounded(ratio, 3),
              verdict, avi::rounded(cost(htvi, unit) / rival, 3),
              avi::rounded(htvi ? htvi->polynomial : nan, 3));
  }
}

}  // namespace experiment::work_precision
