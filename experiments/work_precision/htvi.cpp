#include "work_precision/scenes.hpp"

#include "avi/adaptive/monitors.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/htvi/value_first.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

// Compiled once for each Taylor order r = AVI_TAYLOR_ORDER: order r + 1 with the Gauss rule of that order.

namespace experiment::work_precision {
namespace {

constexpr int r = AVI_TAYLOR_ORDER;

/// A problem that knows dV/dq tells it: faster than derivatives taken automatically.
template <class P>
struct Supplied : P {
  template <class S>
  avi::Vector<S, 2> d_dq(const avi::Vector<S, 2>& q, const avi::Vector<S, 2>&) const {
    return this->potential_gradient(q);
  }
  template <class S>
  avi::Vector<S, 2> d_dp(const avi::Vector<S, 2>&, const avi::Vector<S, 2>& p) const {
    return p;
  }
};

template <class P, class G>
void add(Scene& scene, const Arena<P>& arena, const std::string& knob, double coarse, G monitor) {
  scene.families.push_back(ours(arena, "htvi", r + 1, Origin::htvi, knob, geometric(coarse, 0.8, 40),
                                [=](const P& problem, const auto& start) {
                                  return avi::type2<r>(
                                      avi::poincare<P::dimension>(Supplied<P>{problem}, start, monitor),
                                      avi::gauss((r + 1) / 2));
                                }));
}

/// The same, taking the Taylor polynomial alone where its remainder is below the tolerance.
template <class P, class G>
void add_value_first(Scene& scene, const Arena<P>& arena, const std::string& knob, double tolerance,
                     G monitor) {
  scene.families.push_back(ours(
      arena, "htvi_value_first", r + 1, Origin::htvi, fmt::format("{} tolerance={:.0e} h", knob, tolerance),
      geometric(tolerance > 1e-15 ? 0.4 : 0.18, 0.95, 45), [=](const P& problem, const auto& start) {
        return avi::ValueFirst(
            avi::type2<r>(avi::poincare<P::dimension>(Supplied<P>{problem}, start, monitor),
                          avi::gauss((r + 1) / 2)),
            tolerance);
      }));
}

/// Tolerances that suit the order; at half an ulp nothing but rounding is left out.
std::vector<double> tolerances() {
  if (r == 7) return {1e-5};
  if (r == 11) return {1e-8};
  if (r == 15) return {1e-10, 1.2e-16};
  return {};
}

/// A method of run-time dimension for states of compile-time dimension.
template <int n, class M>
struct RunTime {
  M method;
  avi::State<avi::dynamic> inner;
  avi::StepReport step(avi::State<n>& z, double h) {
    inner.q = z.q;
    inner.p = z.p;
    inner.t = z.t;
    const avi::StepReport report = method.step(inner, h);
    z = {.q = inner.q, .p = inner.p, .t = inner.t};
    return report;
  }
};

// Templates, so that an order compiles what it adds and no more.
template <int order>
void add_to(Scene& scene, const KeplerArena& arena) {
  add(scene, arena, "g=r^1.5 h", order < 3 ? 0.3 : 1.0, avi::Gamma{0.75});
  if constexpr (order == 7 || order == 11 || order == 15)
    for (double tolerance : tolerances())
      add_value_first(scene, arena, "g=r^1.5", tolerance, avi::Gamma{0.75});
}
template <int order>
void add_to(Scene& scene, const PerturbedArena& arena) {
  if constexpr (order == 11) {
    add(scene, arena, "g=r^1.5 h", 1.0, avi::Gamma{0.75});
    for (double tolerance : {1e-8, 1e-12})
      add_value_first(scene, arena, "g=r^1.5", tolerance, avi::Gamma{0.75});
  }
}
template <int order>
void add_to(Scene& scene, const HenonArena& arena) {
  if constexpr (order == 11) {
    add(scene, arena, "g=1 h", 2.0, avi::Unit{});
    for (double tolerance : {1e-8, 1e-12})
      add_value_first(scene, arena, "g=1", tolerance, avi::Unit{});
  }
}
/// At run-time dimension: with 12 differentiated lanes the other takes minutes to compile.
template <int order>
void add_to(Scene& scene, const EightArena& arena) {
  if constexpr (order == 7)
    scene.families.push_back(
        ours(arena, "htvi", order + 1, Origin::htvi, "g=1 h", geometric(0.5, 0.8, 20),
             [](const auto& problem, const auto& start) {
               const avi::State<avi::dynamic> same{.q = start.q, .p = start.p, .t = start.t};
               const avi::NBody<avi::dynamic> bodies(problem.masses());
               auto method =
                   avi::type2<order>(avi::poincare<avi::dynamic>(bodies, same), avi::gauss((order + 1) / 2));
               return RunTime<6, decltype(method)>{std::move(method), same};
             }));
}

}  // namespace

template <>
void add_htvi<r>(Scene& scene, const KeplerArena& arena) {
  add_to<r>(scene, arena);
}
template <>
void add_htvi<r>(Scene& scene, const PerturbedArena& arena) {
  add_to<r>(scene, arena);
}
template <>
void add_htvi<r>(Scene& scene, const HenonArena& arena) {
  add_to<r>(scene, arena);
}
template <>
void add_htvi<r>(Scene& scene, const EightArena& arena) {
  add_to<r>(scene, arena);
}

}  // namespace experiment::work_precision
