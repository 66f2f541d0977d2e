#include "beyond/speed/work_precision/families/collocation.hpp"
#include "beyond/speed/work_precision/families/explicit_methods.hpp"
#include "beyond/speed/work_precision/families/htvi.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"

#include "avi/problems/henon_heiles.hpp"

#include <fmt/format.h>

namespace experiment::work_precision {

Scene henon_heiles(double horizon) {
  const Arena arena(avi::HenonHeiles{}, horizon, avi::HenonHeiles::on_section(1.0 / 12.0, 0.1, 0.0));
  Scene scene{"henon_heiles", not_an_orbit, horizon, fmt::format("{:g}", horizon)};
  set_extended_reference(scene, arena, false, 0.15L);
  add_fixed(scene, arena, 0.25);
  add_collocation(scene, arena, "g=1", 4.0, avi::Unit{}, true);
  add_htvi(scene, arena, "g=1", 2.0, avi::Unit{});
  add_peers(scene, arena.equations());
  return scene;
}

}  // namespace experiment::work_precision
