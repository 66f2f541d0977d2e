#include "beyond/speed/work_precision/scenes.hpp"

#include "avi/integrators/adaptive_verlet.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/composition.hpp"
#include "avi/integrators/hairer_soderlind.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/splitting.hpp"
#include "avi/integrators/stormer_verlet.hpp"

namespace experiment::work_precision {
namespace {

namespace c = avi::compositions;
constexpr auto sum = avi::Summation::compensated;

/// Fixed steps; `stage` is the coarsest step size per force evaluation.
template <class P>
void add_fixed(Scene& scene, const Arena<P>& arena, double stage) {
  const auto add = [&](const char* name, const auto& coefficients, double ratio) {
    scene.families.push_back(ours(arena, name, coefficients.order, Origin::ours_explicit, "h",
                                  geometric(stage * coefficients.stages, ratio, 40),
                                  [=](const P& problem, const auto&) {
                                    return avi::splitting<sum>(avi::Separable<P>(problem), coefficients);
                                  }));
  };
  scene.families.push_back(ours(arena, "stormer_verlet", 2, Origin::ours_explicit, "h",
                                geometric(stage, 0.5, 24), [](const P& problem, const auto&) {
                                  return avi::stormer_verlet<P::dimension>(
                                      [problem](const avi::Vector<double, P::dimension>& q) {
                                        return problem.potential_gradient(q);
                                      });
                                }));
  add("verlet_suzuki4", c::suzuki4, 0.6);
  add("blanes_moan4", avi::splittings::blanes_moan4, 0.6);
  add("verlet_kahan_li6", c::kahan_li6, 0.7);
  add("blanes_moan6_nystrom", avi::splittings::blanes_moan6_nystrom, 0.7);
  add("verlet_kahan_li8", c::kahan_li8, 0.75);
  add("verlet_sofroniou_spaletta10", c::sofroniou_spaletta10, 0.8);
}

/// The logarithmic Hamiltonian; `stage` is the coarsest fictive step per force evaluation.
template <class P>
void add_logarithmic(Scene& scene, const Arena<P>& arena, double stage) {
  const auto add = [&](const char* name, const auto& coefficients, double ratio) {
    scene.families.push_back(
        ours(arena, name, coefficients.order, Origin::ours_explicit, "h",
             geometric(stage * coefficients.stages, ratio, 40), [=](const P& problem, const auto& start) {
               return avi::splitting<sum>(avi::LogHamiltonian<P>(problem, start), coefficients);
             }));
  };
  add("log_hamiltonian", c::strang, 0.6);
  add("log_hamiltonian_suzuki4", c::suzuki4, 0.7);
  add("log_hamiltonian_kahan_li6", c::kahan_li6, 0.8);
  add("log_hamiltonian_kahan_li8", c::kahan_li8, 0.85);
  add("log_hamiltonian_sofroniou_spaletta10", c::sofroniou_spaletta10, 0.87);
  scene.families.push_back(ours(arena, "log_hamiltonian_kahan_li8_plain", 8, Origin::ours_explicit, "h",
                                geometric(stage * 17, 0.85, 40), [](const P& problem, const auto& start) {
                                  return avi::splitting(avi::LogHamiltonian<P>(problem, start), c::kahan_li8);
                                }));
}

/// The reversible, not symplectic rivals with g = |q|^(3/2).
template <class P>
void add_reversible(Scene& scene, const Arena<P>& arena) {
  const avi::PowerOfRadius monitor{1.5};
  const std::string knob = "g=r^1.5 h";
  scene.families.push_back(
      ours(arena, "adaptive_verlet", 2, Origin::ours_explicit, knob, geometric(0.1, 0.6, 30),
           [=](const P& problem, const auto&) { return avi::AdaptiveVerlet(problem, monitor); }));
  scene.families.push_back(ours(arena, "adaptive_verlet_kahan_li8", 8, Origin::ours_explicit, knob,
                                geometric(1.0, 0.8, 30), [=](const P& problem, const auto&) {
                                  return avi::Composition(avi::AdaptiveVerlet(problem, monitor),
                                                          c::kahan_li8);
                                }));
  scene.families.push_back(ours(arena, "hairer_soderlind", 2, Origin::ours_explicit, knob,
                                geometric(0.1, 0.6, 30), [=](const P& problem, const auto&) {
                                  return avi::HairerSoderlind(
                                      avi::splitting<sum>(avi::Separable<P>(problem), c::strang), monitor);
                                }));
  scene.families.push_back(ours(arena, "hairer_soderlind_kahan_li8", 8, Origin::ours_explicit, knob,
                                geometric(1.0, 0.8, 30), [=](const P& problem, const auto&) {
                                  return avi::HairerSoderlind(
                                      avi::splitting<sum>(avi::Separable<P>(problem), c::kahan_li8), monitor);
                                }));
}

}  // namespace

void add_explicit(Scene& scene, const KeplerArena& arena) {
  add_fixed(scene, arena, 0.02);
  add_logarithmic(scene, arena, 0.15);
  add_reversible(scene, arena);
}
void add_explicit(Scene& scene, const PerturbedArena& arena) {
  add_fixed(scene, arena, 0.02);
  add_logarithmic(scene, arena, 0.15);
  add_reversible(scene, arena);
}
void add_explicit(Scene& scene, const HenonArena& arena) { add_fixed(scene, arena, 0.25); }
void add_explicit(Scene& scene, const ClusterArena& arena) {
  add_fixed(scene, arena, 0.01);
  add_logarithmic(scene, arena, 0.1);
}
void add_explicit(Scene& scene, const ChainArena& arena) { add_fixed(scene, arena, 0.25); }
void add_explicit(Scene& scene, const EightArena& arena) {
  add_fixed(scene, arena, 0.05);
  add_logarithmic(scene, arena, 0.1);
}

}  // namespace experiment::work_precision
