#include "beyond/speed/work_precision/families/collocation.hpp"
#include "beyond/speed/work_precision/families/explicit_methods.hpp"
#include "beyond/speed/work_precision/scenes/bodies.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"

namespace experiment::work_precision {
namespace {

/// 1/g = sum of |q_i - q_j|^(-3/2) over the pairs: the rate of the fastest of them.
struct PairRates {
  template <class Q>
  auto operator()(const Q& q) const {
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

}  // namespace

Scene star_cluster() {
  avi::State<14> z;
  z.q << 1.0, 0.1, -0.9, 0.4, 0.2, -0.8, -0.3, 0.9, 0.5, 0.6, -0.6, -0.5, 0.1, 0.15;
  z.p << -0.3, 0.9, 0.2, -0.8, 0.9, 0.1, -0.7, -0.4, -0.5, 0.6, 0.5, -0.7, -0.1, 0.3;
  const Arena arena(UnitBodies<7>(), 1.0, z);
  Scene scene{"star_cluster", not_an_orbit, 1.0, "1"};
  scene.longest_run = 6.0;  // every step is dear
  set_extended_reference(scene, arena, true, 0.005L);
  add_fixed(scene, arena, 0.01);
  add_logarithmic(scene, arena, 0.1);
  add_collocation(scene, arena, "g=pairs", 2.0, PairRates{}, true);
  add_peers(scene, arena.equations());
  return scene;
}

}  // namespace experiment::work_precision
