#include "common/methods/methods.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/splitting.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/poincare.hpp"
#include "common/methods/adaptive_verlet.hpp"
#include "common/methods/hairer_soderlind.hpp"
#include "common/methods/runge_kutta_4.hpp"

#include <stdexcept>

namespace experiment {
namespace {

using avi::HenonHeiles, avi::Kepler;
namespace c = avi::compositions;

/// Kepler's problem with a monitor for the energy of the start.
auto kepler(const State2& start, PositionMonitor monitor) {
  monitor.energy = Kepler{}(start.q, start.p);
  return avi::poincare<2>(Kepler{}, start, monitor);
}
auto kepler(const State2& start, MomentumMonitor monitor) {
  monitor.energy_momentum = -Kepler{}(start.q, start.p);
  return avi::poincare<2>(Kepler{}, start, monitor);
}

/// What `make` makes of the problem that each start gives.
Method2 on_kepler(auto monitor, auto make) {
  return Method2(Kepler{}, [=](const State2& start) { return make(kepler(start, monitor)); });
}
Method2 on_henon_heiles(auto make) {
  return Method2(HenonHeiles{},
                 [=](const State2& start) { return make(avi::poincare<2>(HenonHeiles{}, start)); });
}

auto htvi(int order) {
  return [=](const auto& problem) {
    return avi::htvi_of_order<avi::Generating::type2>(order / 2 - 1, problem, avi::gauss(order / 2));
  };
}
auto gauss(int order) {
  return [=](const auto& problem) { return avi::collocation(problem, order); };
}

template <class Problem>
Method2 fixed_step(const std::string& name) {
  const Problem problem;
  const auto composed = [&](const auto& coefficients) {
    return Method2(problem, [=](const State2&) {
      return avi::splitting(avi::Separable<Problem>(problem), coefficients);
    });
  };
  if (name == "stormer_verlet") return composed(c::strang);
  if (name == "yoshida4") return composed(c::yoshida4);
  if (name == "kahan_li8") return composed(c::kahan_li8);
  if (name == "runge_kutta_4")
    return Method2(problem, [=](const State2&) { return RungeKutta4<2, Problem>(problem); });
  throw std::invalid_argument("Method '" + name + "' is none of those that methods.hpp names.");
}

}  // namespace

Method2 stationary(int order, PositionMonitor monitor) { return on_kepler(monitor, htvi(order)); }
Method2 stationary(int order, MomentumMonitor monitor) { return on_kepler(monitor, htvi(order)); }
Method2 stationary_henon_heiles(int order) { return on_henon_heiles(htvi(order)); }

Method2 collocation(int order, PositionMonitor monitor) { return on_kepler(monitor, gauss(order)); }
Method2 collocation_henon_heiles(int order) { return on_henon_heiles(gauss(order)); }

Method2 explicit_on_kepler(const std::string& name) {
  const Kepler problem;
  const PowerOfRadius monitor{1.5};
  const auto logarithmic = [&](const auto& coefficients) {
    return Method2(problem, [=](const State2& start) {
      return avi::splitting(avi::LogHamiltonian<Kepler>(problem, start), coefficients);
    });
  };
  if (name == "log_hamiltonian") return logarithmic(c::strang);
  if (name == "log_hamiltonian_yoshida4") return logarithmic(c::yoshida4);
  if (name == "adaptive_verlet")
    return Method2(problem, [=](const State2&) { return AdaptiveVerlet(problem, monitor); });
  if (name == "hairer_soderlind")
    return Method2(problem, [=](const State2&) {
      return HairerSoderlind(avi::splitting(avi::Separable<Kepler>(problem), c::strang), monitor);
    });
  return fixed_step<Kepler>(name);
}
Method2 explicit_on_henon_heiles(const std::string& name) { return fixed_step<HenonHeiles>(name); }

}  // namespace experiment
