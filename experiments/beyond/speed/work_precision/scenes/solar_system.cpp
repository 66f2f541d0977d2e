#include "beyond/speed/work_precision/families/collocation.hpp"
#include "beyond/speed/work_precision/families/explicit_methods.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"

#include "avi/problems/outer_solar_system.hpp"

#include <fmt/format.h>

namespace experiment::work_precision {

Scene solar_system(double horizon) {
  const Arena arena(avi::OuterSolarSystem::problem(), horizon, avi::OuterSolarSystem::start());
  Scene scene{"solar_system", not_an_orbit, horizon, fmt::format("{:.0f} days", horizon)};
  set_extended_reference(scene, arena, false, 60.0L);
  add_fixed(scene, arena, 100.0);
  add_collocation(scene, arena, "g=1", 1500.0, avi::Unit{});
  add_peers(scene, arena.equations());
  return scene;
}

}  // namespace experiment::work_precision
