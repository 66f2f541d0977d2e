#include "beyond/speed/work_precision/scenes/kepler_methods.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"
#include "common/reference.hpp"

#include "avi/problems/perturbed_kepler.hpp"

namespace experiment::work_precision {

Scene perturbed_kepler(double eccentricity, double horizon, const std::string& horizon_name) {
  const Arena arena(avi::PerturbedKepler(1e-3), horizon, avi::PerturbedKepler::pericentre(eccentricity));
  Scene scene{"perturbed_kepler", eccentricity, horizon, horizon_name};
  set_extended_reference(scene, arena, true, 0.1L);
  add_kepler_methods(scene, arena);
  return scene;
}

}  // namespace experiment::work_precision
