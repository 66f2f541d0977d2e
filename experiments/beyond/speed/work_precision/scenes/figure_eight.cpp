#include "beyond/speed/work_precision/families/collocation.hpp"
#include "beyond/speed/work_precision/families/explicit_methods.hpp"
#include "beyond/speed/work_precision/families/htvi.hpp"
#include "beyond/speed/work_precision/scenes/bodies.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"

#include <fmt/format.h>

namespace experiment::work_precision {

Scene figure_eight(int periods) {
  const double horizon = periods * avi::FigureEight::period;
  const Arena arena(UnitBodies<3>(), horizon, avi::FigureEight::start());
  Scene scene{"figure_eight", not_an_orbit, horizon, fmt::format("{} periods", periods)};
  set_extended_reference(scene, arena, false, 0.05L);
  add_fixed(scene, arena, 0.05);
  add_logarithmic(scene, arena, 0.1);
  add_collocation(scene, arena, "g=1", 0.6, avi::Unit{});
  add_htvi(scene, arena, "g=1", 0.5, avi::Unit{});
  add_peers(scene, arena.equations());
  return scene;
}

}  // namespace experiment::work_precision
