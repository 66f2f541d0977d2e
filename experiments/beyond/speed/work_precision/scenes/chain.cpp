#include "beyond/speed/work_precision/families/collocation.hpp"
#include "beyond/speed/work_precision/families/explicit_methods.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"

#include "avi/problems/chain.hpp"

namespace experiment::work_precision {
namespace {

/// The chain as T(p) + V(q).
struct LongChain : avi::Chain {
  static constexpr int dimension = 64;
  template <class S>
  avi::Vector<S, 64> potential_gradient(const avi::Vector<S, 64>& q) const {
    return d_dq(q, q);
  }
};

}  // namespace

Scene chain() {
  const avi::State<avi::dynamic> plucked = avi::Chain::plucked(64);
  const Arena arena(LongChain{}, 100.0, {.q = plucked.q, .p = plucked.p});
  Scene scene{"chain64", not_an_orbit, 100.0, "100"};
  set_extended_reference(scene, arena, false, 0.25L);
  add_fixed(scene, arena, 0.25);
  add_collocation(scene, arena, "g=1", 3.0, avi::Unit{}, true);
  add_peers(scene, arena.equations());
  return scene;
}

}  // namespace experiment::work_precision
