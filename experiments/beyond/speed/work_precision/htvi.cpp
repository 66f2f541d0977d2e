#include "beyond/speed/work_precision/scenes.hpp"

#include "avi/htvi/htvi.hpp"
#include "avi/transform/monitors.hpp"

#include <string>

// The stationary HTVI, each order with its natural rule.

namespace experiment::work_precision {
namespace {

/// A problem that knows dV/dq tells it: faster than derivatives taken automatically.
template <class P>
struct Supplied : P {
  template <class S>
  auto d_dq(const avi::Vector<S, P::dimension>& q, const avi::Vector<S, P::dimension>&) const {
    return this->potential_gradient(q);
  }
  template <class S>
  auto d_dp(const avi::Vector<S, P::dimension>&, const avi::Vector<S, P::dimension>& p) const {
    return p;
  }
};

template <class P>
auto supplied(const P& problem) {
  using Vec = avi::Vector<double, P::dimension>;
  if constexpr (avi::SuppliesGradient<P, double, P::dimension> ||
                !requires(Vec q) { problem.potential_gradient(q); })
    return problem;
  else
    return Supplied<P>{problem};
}

template <class P, class G>
void add(Scene& scene, const Arena<P>& arena, const std::string& knob, double coarse, const G& monitor) {
  for (const int order : {4, 8, 12, 16})
    scene.families.push_back(ours(arena, "htvi", order, Origin::htvi, knob, geometric(coarse, 0.8, 40),
                                  [=](const P& problem, const auto& start) {
                                    return avi::htvi_of_order<avi::Generating::type2>(
                                        order / 2 - 1,
                                        avi::poincare<P::dimension>(supplied(problem), start, monitor),
                                        avi::gauss(order / 2));
                                  }));
}

}  // namespace

void add_htvi(Scene& scene, const KeplerArena& arena) {
  add(scene, arena, "g=r^1.5 h", 1.0, avi::Gamma{0.75});
}
void add_htvi(Scene& scene, const PerturbedArena& arena) {
  add(scene, arena, "g=r^1.5 h", 1.0, avi::Gamma{0.75});
}
void add_htvi(Scene& scene, const HenonArena& arena) { add(scene, arena, "g=1 h", 2.0, avi::Unit{}); }
void add_htvi(Scene& scene, const EightArena& arena) { add(scene, arena, "g=1 h", 0.5, avi::Unit{}); }

}  // namespace experiment::work_precision
