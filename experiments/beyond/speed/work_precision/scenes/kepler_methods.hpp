#pragma once
#include "beyond/speed/work_precision/families/collocation.hpp"
#include "beyond/speed/work_precision/families/explicit_methods.hpp"
#include "beyond/speed/work_precision/families/htvi.hpp"

/// @file
/// What runs on an eccentric orbit, disturbed or not.

namespace experiment::work_precision {

template <class P>
void add_kepler_methods(Scene& scene, const Arena<P>& arena) {
  add_fixed(scene, arena, 0.02);
  add_logarithmic(scene, arena, 0.15);
  add_reversible(scene, arena);
  add_collocation(scene, arena, "g=r^1.5", 1.7, ThreeHalves{}, arena.horizon < 100.0);
  add_htvi(scene, arena, "g=r^1.5", 1.0, avi::Gamma{0.75});
  add_peers(scene, arena.equations());
}

}  // namespace experiment::work_precision
