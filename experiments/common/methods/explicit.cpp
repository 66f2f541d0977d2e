#include "common/methods/methods.hpp"
#include "common/methods/runge_kutta_4.hpp"

#include "avi/integrators/adaptive_verlet.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/hairer_soderlind.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/splitting.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"

#include <stdexcept>

namespace experiment {
namespace {

namespace c = avi::compositions;

template <class Problem>
Runner fixed_step(const std::string& name) {
  const Problem problem;
  const auto composed = [&](const auto& coefficients) {
    return Runner(problem, [=](const State2&) {
      return avi::splitting(avi::Separable<Problem>(problem), coefficients);
    });
  };
  if (name == "stormer_verlet") return composed(c::strang);
  if (name == "yoshida4") return composed(c::yoshida4);
  if (name == "kahan_li8") return composed(c::kahan_li8);
  if (name == "runge_kutta_4")
    return Runner(problem, [=](const State2&) { return RungeKutta4<2, Problem>(problem); });
  throw std::invalid_argument("Method '" + name + "' is none of those that methods.hpp names.");
}

}  // namespace

Runner explicit_on_kepler(const std::string& name) {
  const avi::Kepler kepler;
  const avi::PowerOfRadius monitor{1.5};
  const auto logarithmic = [&](const auto& coefficients) {
    return Runner(kepler, [=](const State2& start) {
      return avi::splitting(avi::LogHamiltonian<avi::Kepler>(kepler, start), coefficients);
    });
  };
  if (name == "log_hamiltonian") return logarithmic(c::strang);
  if (name == "log_hamiltonian_yoshida4") return logarithmic(c::yoshida4);
  if (name == "adaptive_verlet")
    return Runner(kepler, [=](const State2&) { return avi::AdaptiveVerlet(kepler, monitor); });
  if (name == "hairer_soderlind")
    return Runner(kepler, [=](const State2&) {
      return avi::HairerSoderlind(avi::splitting(avi::Separable<avi::Kepler>(kepler), c::strang), monitor);
    });
  return fixed_step<avi::Kepler>(name);
}

Runner explicit_on_henon_heiles(const std::string& name) { return fixed_step<avi::HenonHeiles>(name); }

}  // namespace experiment
