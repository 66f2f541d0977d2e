#include "extremes/methods.hpp"

#include "avi/core/require.hpp"
#include "avi/integrators/adaptive_verlet.hpp"
#include "avi/integrators/compositions.hpp"
#include "avi/integrators/hairer_soderlind.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/runge_kutta.hpp"
#include "avi/integrators/splitting.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/integrators/tableaus.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"

namespace experiment {
namespace {

namespace c = avi::compositions;

/// The classical Runge-Kutta method: the control that is not symplectic.
template <class Problem>
class RungeKutta4 {
 public:
  avi::StepReport step(State2& z, double h) {
    point_ << z.q, z.p;
    field(point_, stages_.k[0]);
    stages_.advance(field, point_, h);
    z.q = stages_.end.template head<2>();
    z.p = stages_.end.template tail<2>();
    z.t += h;
    return {.evaluations = 4};
  }

 private:
  static void field(const avi::VectorX& z, avi::VectorX& dz) {
    dz.head<2>() = z.tail<2>();
    dz.tail<2>() = -Problem::potential_gradient(avi::Vector<double, 2>(z.head<2>()));
  }
  avi::VectorX point_ = avi::VectorX::Zero(4);
  avi::RungeKuttaStages<avi::ClassicalRungeKutta> stages_{4};
};

template <class Problem>
Runner fixed_step(const std::string& name) {
  const Problem problem;
  const auto composed = [&](const auto& coefficients) {
    return runner(problem, [=](const State2&) {
      return avi::splitting(avi::Separable<Problem>(problem), coefficients);
    });
  };
  if (name == "stormer_verlet") return composed(c::strang);
  if (name == "yoshida4") return composed(c::yoshida4);
  if (name == "kahan_li8") return composed(c::kahan_li8);
  if (name == "runge_kutta_4") return runner(problem, [](const State2&) { return RungeKutta4<Problem>(); });
  avi::require(false, "Method", name, "one of those that methods.hpp names");
  return {};
}

}  // namespace

Runner explicit_on_kepler(const std::string& name) {
  const avi::Kepler kepler;
  const avi::PowerOfRadius monitor{1.5};
  const auto logarithmic = [&](const auto& coefficients) {
    return runner(kepler, [=](const State2& start) {
      return avi::splitting(avi::LogHamiltonian<avi::Kepler>(kepler, start), coefficients);
    });
  };
  if (name == "log_hamiltonian") return logarithmic(c::strang);
  if (name == "log_hamiltonian_yoshida4") return logarithmic(c::yoshida4);
  if (name == "adaptive_verlet")
    return runner(kepler, [=](const State2&) { return avi::AdaptiveVerlet(kepler, monitor); });
  if (name == "hairer_soderlind")
    return runner(kepler, [=](const State2&) {
      return avi::HairerSoderlind(avi::splitting(avi::Separable<avi::Kepler>(kepler), c::strang), monitor);
    });
  return fixed_step<avi::Kepler>(name);
}

Runner with_phase(Runner run, double bound) {
  return [run = std::move(run), bound](const State2& start, double h, const Limits& limits) {
    Attempt attempt = run(start, h, limits);
    attempt.late = !(std::abs(phase_error(start, attempt.end)) <= bound);
    return attempt;
  };
}

Runner explicit_on_henon_heiles(const std::string& name) { return fixed_step<avi::HenonHeiles>(name); }

}  // namespace experiment
