#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "beyond/speed/work_precision/peers/peers.hpp"
#include "beyond/speed/work_precision/scenes/arena.hpp"
#include "beyond/speed/work_precision/scenes/bodies.hpp"
#include "common/problems/perturbed_kepler.hpp"

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>

namespace experiment::work_precision {
namespace {

namespace odeint = boost::numeric::odeint;

/// Runs an odeint stepper. `controlled(tolerance)` returns the stepper, `f_of(equations)` the right-hand
/// side.
template <class State, class F, class Controlled>
Family family(const Equations& equations, F f_of, const char* method, int order, Controlled controlled) {
  return peer(equations, method, order, [f_of, controlled](Task& task) {
    State state{};
    if constexpr (requires { state.resize(1); }) state.resize(task.y.size());
    std::copy(task.y.begin(), task.y.end(), state.begin());
    const auto field = f_of(task.equations);
    task.steps = -1;  // the observer is also called at the start
    bool ok = true;
    try {
      odeint::integrate_adaptive(
          controlled(task.tolerance),
          [&](const State& x, State& dxdt, double t) { field(t, x.data(), dxdt.data(), &task.f); }, state,
          0.0, task.equations.horizon, 1e-3,
          [&](const State& x, double) {
            if (!task.stepped(x.data())) throw std::runtime_error("step cap");
          });
    } catch (const std::exception&) {
      ok = false;  // odeint also throws when its step size underflows
    }
    std::copy(state.begin(), state.end(), task.y.begin());
    return ok;
  });
}

template <class State, class F>
void add(Scene& scene, const Equations& equations, F f_of) {
  const auto add = [&](const char* method, int order, auto controlled) {
    scene.families.push_back(family<State>(equations, f_of, method, order, controlled));
  };
  add("odeint_dopri5", 5, [](double tolerance) {
    return odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<State>());
  });
  add("odeint_fehlberg78", 8, [](double tolerance) {
    return odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<State>());
  });
  add("odeint_bulirsch_stoer", 0,
      [](double tolerance) { return odeint::bulirsch_stoer<State>(tolerance, tolerance); });
}

/// Adds the families if the equations are those of P. The right-hand side and the dimension of P are then
/// known at compile time and inlined; otherwise Bulirsch-Stoer takes up to 1.8 times as long. @return whether
/// they were added
template <class P>
bool added_in_line(Scene& scene, const Equations& equations) {
  if (equations.field != &Arena<P>::field) return false;
  add<std::array<double, 2 * P::dimension>>(scene, equations, [](const Equations&) {
    return [](double t, const double* y, double* f, void* self) { Arena<P>::field(t, y, f, self); };
  });
  return true;
}

}  // namespace

void add_odeint(Scene& scene, const Equations& equations) {
  const auto called = [](const Equations& its) { return its.field; };
  if (added_in_line<avi::Kepler>(scene, equations) || added_in_line<PerturbedKepler>(scene, equations) ||
      added_in_line<avi::HenonHeiles>(scene, equations) || added_in_line<UnitBodies<3>>(scene, equations) ||
      added_in_line<UnitBodies<7>>(scene, equations) || added_in_line<avi::NBody<6, 3>>(scene, equations))
    return;
  if (equations.start.front().size() == 4)
    add<std::array<double, 4>>(scene, equations, called);
  else
    add<std::vector<double>>(scene, equations, called);
}

}  // namespace experiment::work_precision
