#include "beyond/speed/work_precision/scenes/scenes.hpp"

#include <fmt/format.h>

#include <cmath>

namespace experiment::work_precision {
namespace {

/// Over many periods only promising methods are run; the short horizon shows which these are.
Scene thinned(Scene scene) {
  std::erase_if(scene.families, [](const Family& f) {
    const bool fixed = f.method.starts_with("verlet_") || f.method.starts_with("stormer_");
    return (f.order < 6 && f.origin != Origin::peer) || (fixed && f.method != "verlet_kahan_li8") ||
           f.method == "odeint_dopri5" || f.method == "gsl_rkf45";
  });
  return scene;
}

}  // namespace

std::vector<Listed> scenes(Grid grid) {
  const bool full = grid == Grid::full;
  const auto orbit = [](double e) {
    return Listed{fmt::format("kepler {} 10", e), [=] { return kepler(e, 10.0, "10"); }};
  };
  if (grid == Grid::quick) return {orbit(0.9)};
  const auto orbits = [&](double e, int number) {
    const std::string name = fmt::format("{} periods", number);
    return Listed{fmt::format("kepler {} {}", e, name),
                  [=] { return thinned(kepler(e, number * 2.0 * M_PI, name)); }};
  };
  std::vector<Listed> list{orbit(0.9), orbit(0.99), orbit(0.999), orbits(0.9, full ? 1000 : 100)};
  if (full) {
    list.push_back(orbits(0.99, 1000));
    list.push_back(orbits(0.999, 1000));
  }
  list.push_back({"perturbed_kepler", perturbed_kepler});
  list.push_back({"henon_heiles", [=] { return henon_heiles(full ? 1000.0 : 100.0); }});
  list.push_back({"double_pendulum", double_pendulum});
  list.push_back({"figure_eight", figure_eight});
  list.push_back({"star_cluster", star_cluster});
  list.push_back({"solar_system", solar_system});
  list.push_back({"chain", chain});
  return list;
}

}  // namespace experiment::work_precision
