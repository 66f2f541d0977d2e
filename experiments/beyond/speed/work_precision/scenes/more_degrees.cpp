#include "beyond/speed/work_precision/scenes/bodies.hpp"
#include "beyond/speed/work_precision/scenes/families.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"
#include "common/problems/chain.hpp"
#include "common/problems/outer_solar_system.hpp"

namespace experiment::work_precision {
namespace {

/// The monitor with 1/g = sum over pairs of |q_i - q_j|^(-3/2), dominated by the fastest pair.
struct PairRates {
  auto operator()(const auto& q) const {
    using std::pow;
    const auto rate = [&](Eigen::Index i, Eigen::Index j) {
      return pow(avi::NBody<7>::distance_squared(q, i, j), -0.75);
    };
    auto sum = rate(0, 1);
    for (Eigen::Index j = 2; 2 * j < q.size(); ++j)
      for (Eigen::Index i = 0; i < j; ++i)
        sum += rate(i, j);
    return 1.0 / sum;
  }
};

/// The chain in the form T(p) + V(q).
struct LongChain : Chain {
  static constexpr int dimension = 64;
  template <class S>
  avi::Vector<S, 64> potential_gradient(const avi::Vector<S, 64>& q) const {
    return d_dq(q, q);
  }
};

}  // namespace

Scene figure_eight() {
  constexpr double horizon = 10.0 * avi::FigureEight::period;
  const Arena arena(UnitBodies<3>(), horizon, avi::FigureEight::start());
  Scene scene{"figure_eight", unknown, horizon, "10 periods"};
  scene.longest_run = 0.3;
  set_extended_reference(scene, arena, false, 0.05L);
  add_fixed(scene, arena, 0.05);
  add_logarithmic(scene, arena, 0.1);
  add_collocation(scene, arena, "g=1", 0.6, avi::Unit{});
  add_htvi(scene, arena, "g=1", 0.5, avi::Unit{});
  add_peers(scene, arena.equations());
  return scene;
}

Scene star_cluster() {
  const Arena arena(UnitBodies<7>(), 1.0, star_cluster_start());
  Scene scene{"star_cluster", unknown, 1.0, "1"};
  scene.longest_run = 0.4;
  set_extended_reference(scene, arena, true, 0.005L);
  add_fixed(scene, arena, 0.01);
  add_logarithmic(scene, arena, 0.1);
  add_collocation(scene, arena, "g=pairs", 2.0, PairRates{}, true);
  add_peers(scene, arena.equations());
  return scene;
}

Scene solar_system() {
  constexpr double horizon = 200'000.0;  // days
  const Arena arena(OuterSolarSystem::problem(), horizon, OuterSolarSystem::start());
  Scene scene{"solar_system", unknown, horizon, "200000 days"};
  scene.longest_run = 0.2;
  set_extended_reference(scene, arena, false, 60.0L);
  add_fixed(scene, arena, 100.0);
  add_collocation(scene, arena, "g=1", 1500.0, avi::Unit{});
  add_peers(scene, arena.equations());
  return scene;
}

Scene chain() {
  const avi::State<avi::dynamic> plucked = Chain::plucked(64);
  const Arena arena(LongChain{}, 100.0, {.q = plucked.q, .p = plucked.p});
  Scene scene{"chain64", unknown, 100.0, "100"};
  set_extended_reference(scene, arena, false, 0.25L);
  add_fixed(scene, arena, 0.25);
  add_collocation(scene, arena, "g=1", 3.0, avi::Unit{}, true);
  add_peers(scene, arena.equations());
  return scene;
}

}  // namespace experiment::work_precision
