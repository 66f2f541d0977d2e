#include "beyond/speed/work_precision/scenes.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/transform/poincare.hpp"

#include <cmath>
#include <string>

// Gauss collocation of the orders 4 to 16, each a family, with the monitor that the scene asks for.

namespace experiment::work_precision {
namespace {

/// g = |q|^(3/2).
struct ThreeHalves {
  template <class Q>
  auto operator()(const Q& q) const {
    using std::pow;
    return pow(q[0] * q[0] + q[1] * q[1], 0.75);
  }
};

/// 1/g = sum of |q_i - q_j|^(-3/2) over the pairs: the rate of the fastest of them.
struct PairRates {
  template <class Q>
  auto operator()(const Q& q) const {
    using std::pow;
    const auto rate = [&](Eigen::Index i, Eigen::Index j) {
      const auto x = q[2 * i] - q[2 * j], y = q[2 * i + 1] - q[2 * j + 1];
      return pow(x * x + y * y, -0.75);
    };
    auto sum = rate(0, 1);
    for (Eigen::Index j = 2; 2 * j < q.size(); ++j)
      for (Eigen::Index i = 0; i < j; ++i)
        sum += rate(i, j);
    return 1.0 / sum;
  }
};

template <class P, class G>
void add(Scene& scene, const Arena<P>& arena, const std::string& knob, int order, double coarse, G monitor,
         avi::SweepSettings sweeps = {}) {
  scene.families.push_back(ours(arena, "collocation", order, Origin::collocation, knob,
                                geometric(coarse, order < 8 ? 0.8 : 0.9, order < 8 ? 30 : 24),
                                [=](const P& problem, const auto& start) {
                                  return avi::collocation(avi::poincare(problem, start, monitor), order,
                                                          sweeps);
                                }));
}

/// Orders 4 to 16; `largest` is the coarsest step of order 16.
template <class P, class G>
void add_orders(Scene& scene, const Arena<P>& arena, const std::string& knob, double largest, G monitor) {
  add(scene, arena, knob, 4, 0.3 * largest, monitor);
  add(scene, arena, knob, 8, 0.6 * largest, monitor);
  add(scene, arena, knob, 12, 0.9 * largest, monitor);
  add(scene, arena, knob, 16, largest, monitor);
}

/// Sweeps that end early: enough for errors above the tolerance in a short run.
template <class P, class G>
void add_loose(Scene& scene, const Arena<P>& arena, const std::string& g, double largest, G monitor) {
  add(scene, arena, g + " tolerance=1e-06 h", 16, largest, monitor, {.tolerance = 1e-6});
  add(scene, arena, g + " tolerance=1e-10 h", 16, largest, monitor, {.tolerance = 1e-10});
}

}  // namespace

void add_collocation(Scene& scene, const KeplerArena& arena) {
  add_orders(scene, arena, "g=r^1.5 h", 1.7, ThreeHalves{});
  if (arena.horizon < 100.0) add_loose(scene, arena, "g=r^1.5", 1.7, ThreeHalves{});
}
void add_collocation(Scene& scene, const PerturbedArena& arena) {
  add_orders(scene, arena, "g=r^1.5 h", 1.7, ThreeHalves{});
  if (arena.horizon < 100.0) add_loose(scene, arena, "g=r^1.5", 1.7, ThreeHalves{});
}
void add_collocation(Scene& scene, const HenonArena& arena) {
  add_orders(scene, arena, "g=1 h", 4.0, avi::Unit{});
}
void add_collocation(Scene& scene, const EightArena& arena) {
  add_orders(scene, arena, "g=1 h", 0.6, avi::Unit{});
}
void add_collocation(Scene& scene, const ClusterArena& arena) {
  add_orders(scene, arena, "g=pairs h", 2.0, PairRates{});
}
void add_collocation(Scene& scene, const ChainArena& arena) {
  add_orders(scene, arena, "g=1 h", 3.0, avi::Unit{});
}

}  // namespace experiment::work_precision
