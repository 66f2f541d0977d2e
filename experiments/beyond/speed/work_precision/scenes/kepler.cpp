#include "beyond/speed/work_precision/scenes/kepler_methods.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"
#include "common/reference.hpp"

#include "avi/problems/kepler.hpp"

namespace experiment::work_precision {

Scene kepler(double eccentricity, double horizon, const std::string& horizon_name) {
  const Arena<avi::Kepler> arena({}, horizon, avi::Kepler::pericentre(eccentricity));
  Scene scene{"kepler", eccentricity, horizon, horizon_name};
  scene.position_error = [arena](int k, double t, const Eigen::VectorXd& q) {
    return (exact_kepler(arena.at(k), t) - q).norm();
  };
  add_kepler_methods(scene, arena);
  return scene;
}

}  // namespace experiment::work_precision
