#pragma once
#include "beyond/speed/work_precision/family.hpp"

#include <functional>
#include <string>
#include <vector>

// The problems of the comparison, each with the methods that take part.

namespace experiment::work_precision {

Scene kepler(double eccentricity, double horizon, const std::string& horizon_name);
Scene perturbed_kepler();
Scene henon_heiles(double horizon);
Scene double_pendulum();
Scene figure_eight();
/// Seven unit masses, with encounters down to a hundredth of the size of the cluster.
Scene star_cluster();
/// The Sun and five planets.
Scene solar_system();
/// 64 masses on a line.
Scene chain();

/// The extent of the comparison.
enum class Grid {
  quick,    ///< One short scene, for tests.
  reduced,  ///< The part that `make figures` runs.
  full
};

/// A scene that is made only when needed, because its reference takes time.
struct Listed {
  std::string label;
  std::function<Scene()> make;
};

std::vector<Listed> scenes(Grid grid);

}  // namespace experiment::work_precision
