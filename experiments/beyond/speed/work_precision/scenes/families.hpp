#pragma once
#include "avi/collocation/collocation.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/splitting.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"
#include "beyond/speed/work_precision/scenes/arena.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

// The methods of this library as families: explicit ones for H = T(p) + V(q), Gauss collocation and HTVI.

namespace experiment::work_precision {

namespace c = avi::compositions;
constexpr auto sum = avi::Summation::compensated;

/// Explicit methods with fixed steps. @param stage the coarsest step size per force evaluation
template <class P>
void add_fixed(Scene& scene, const Arena<P>& arena, double stage) {
  const auto add = [&](const char* name, const avi::SplitCoefficients& list, double ratio) {
    const double coarse = stage * list.b.size();
    arena.add(
        scene, Origin::ours_explicit, name, list.order, "h", geometric(coarse, ratio, 40),
        [=](const P& problem, const auto&) { return avi::splitting<sum>(avi::Separable<P>(problem), list); });
  };
  arena.add(scene, Origin::ours_explicit, "stormer_verlet", 2, "h", geometric(stage, 0.5, 24),
            [](const P& problem, const auto&) {
              return avi::stormer_verlet<P::dimension>([problem](const avi::Vector<double, P::dimension>& q) {
                return problem.potential_gradient(q);
              });
            });
  add("verlet_suzuki4", split(c::suzuki4), 0.6);
  add("blanes_moan4", avi::splittings::blanes_moan4, 0.6);
  add("verlet_kahan_li6", split(c::kahan_li6), 0.7);
  add("blanes_moan6_nystrom", avi::splittings::blanes_moan6_nystrom, 0.7);
  add("verlet_kahan_li8", split(c::kahan_li8), 0.75);
  add("verlet_sofroniou_spaletta10", split(c::sofroniou_spaletta10), 0.8);
}

/// Methods with the logarithmic Hamiltonian. @param stage the coarsest fictive step per force evaluation
template <class P>
void add_logarithmic(Scene& scene, const Arena<P>& arena, double stage) {
  const auto add = [&](const char* name, const avi::CompositionCoefficients& composition, double ratio) {
    const auto list = split(composition);
    const double coarse = stage * list.b.size();
    arena.add(scene, Origin::ours_explicit, name, list.order, "h", geometric(coarse, ratio, 40),
              [=](const P& problem, const auto& start) {
                return avi::splitting<sum>(avi::LogHamiltonian<P>(problem, start), list);
              });
  };
  add("log_hamiltonian", c::strang, 0.6);
  add("log_hamiltonian_suzuki4", c::suzuki4, 0.7);
  add("log_hamiltonian_kahan_li6", c::kahan_li6, 0.8);
  add("log_hamiltonian_kahan_li8", c::kahan_li8, 0.85);
  add("log_hamiltonian_sofroniou_spaletta10", c::sofroniou_spaletta10, 0.87);
}

/// The monitor g = |q|^(3/2).
struct ThreeHalves {
  auto operator()(const auto& q) const {
    using std::pow;
    return pow(q[0] * q[0] + q[1] * q[1], 0.75);
  }
};

/// Gauss collocation of orders 4 to 16. With `loosely`, sweeps that end early are tried as well: in short
/// runs of many small steps they suffice for errors above their tolerance. @param largest the coarsest step
/// for order 16
template <class P, class G>
void add_collocation(Scene& scene, const Arena<P>& arena, const std::string& knob, double largest, G monitor,
                     bool loosely = false) {
  const auto add = [&](const std::string& its, int order, double coarse, avi::SweepSettings sweeps = {}) {
    arena.add(scene, Origin::collocation, "collocation", order, its + " h",
              geometric(coarse * largest, order < 8 ? 0.8 : 0.9, order < 8 ? 30 : 24),
              [=](const P& problem, const auto& start) {
                return avi::collocation(avi::poincare(problem, start, monitor), order, sweeps);
              });
  };
  add(knob, 4, 0.3);
  add(knob, 8, 0.6);
  add(knob, 12, 0.9);
  add(knob, 16, 1.0);
  if (!loosely) return;
  for (const double tolerance : {1e-4, 1e-6, 1e-10}) {
    const std::string its = fmt::format("{} tolerance={:.0e}", knob, tolerance);
    add(its, 8, 0.6, {.tolerance = tolerance});
    add(its, 16, 1.0, {.tolerance = tolerance});
  }
}

/// A problem that supplies its gradient dV/dq: this is faster than automatic differentiation.
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

/// The stationary HTVI of orders 4 to 16, each with its natural rule. @param coarse the coarsest step
template <class P, class G>
void add_htvi(Scene& scene, const Arena<P>& arena, const std::string& knob, double coarse, const G& monitor) {
  for (const int order : {4, 8, 12, 16}) {
    arena.add(scene, Origin::htvi, "htvi", order, knob + " h", geometric(coarse, 0.8, 40),
              [=](const P& problem, const auto& start) {
                return avi::htvi_of_order<avi::Generating::type2>(
                    order / 2 - 1, avi::poincare<P::dimension>(supplied(problem), start, monitor),
                    avi::gauss(order / 2));
              });
    scene.families.back().weight = 4.5 * order;  // measured on Kepler's problem
  }
}

}  // namespace experiment::work_precision
