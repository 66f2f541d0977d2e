#include "work_precision/scenes.hpp"

#include "avi/adaptive/monitors.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/htvi/value_first.hpp"

// Compiled once for each Taylor order r = AVI_TAYLOR_ORDER: order r + 1 with the Gauss rule of that order.

namespace experiment::work_precision {
namespace {

constexpr int r = AVI_TAYLOR_ORDER;

template <class P, class G>
void add(Scene& scene, const Arena<P>& arena, const std::string& knob, double coarse, G monitor) {
  scene.families.push_back(ours(arena, "htvi", r + 1, Origin::htvi, knob, geometric(coarse, 0.8, 40),
                                [=](const P& problem, const auto& start) {
                                  return avi::type2<r>(avi::poincare<P::dimension>(problem, start, monitor),
                                                       avi::gauss((r + 1) / 2));
                                }));
}

/// The same, leaving out what rounding would drop.
template <class P, class G>
void add_value_first(Scene& scene, const Arena<P>& arena, const std::string& knob, double coarse, G monitor) {
  scene.families.push_back(ours(arena, "htvi_value_first", r + 1, Origin::htvi, knob,
                                geometric(coarse, 0.85, 20), [=](const P& problem, const auto& start) {
                                  return avi::ValueFirst(
                                      avi::type2<r>(avi::poincare<P::dimension>(problem, start, monitor),
                                                    avi::gauss((r + 1) / 2)));
                                }));
}

}  // namespace

template <>
void add_htvi<r>(Scene& scene, const KeplerArena& arena) {
  add(scene, arena, "g=r^1.5 h", 1.0, avi::Gamma{0.75});
  if constexpr (r == 15) add_value_first(scene, arena, "g=r^1.5 h", 0.4, avi::Gamma{0.75});
}
template <>
void add_htvi<r>(Scene& scene, const PerturbedArena& arena) {
  if constexpr (r == 11) add(scene, arena, "g=r^1.5 h", 1.0, avi::Gamma{0.75});
}
template <>
void add_htvi<r>(Scene& scene, const HenonArena& arena) {
  if constexpr (r == 11) add(scene, arena, "g=1 h", 2.0, avi::Unit{});
}
/// Not instantiated: with 12 differentiated lanes the step takes minutes to compile.
template <>
void add_htvi<r>(Scene&, const EightArena&) {}

}  // namespace experiment::work_precision
