#include "beyond/speed/work_precision/peer.hpp"

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <array>
#include <exception>
#include <stdexcept>

namespace experiment::work_precision {
namespace {

namespace odeint = boost::numeric::odeint;

/// `controlled(tolerance)` gives the stepper.
template <class P, class Controlled>
Family odeint_family(const Arena<P>& arena, const char* method, int order, Controlled controlled) {
  return peer(arena, method, order, [controlled](const P& problem, double tolerance, long step_cap) {
    return [=](std::span<double> y, double t, double horizon, auto&& watch) {
      std::array<double, 2 * P::dimension> state;
      std::copy(y.begin(), y.end(), state.begin());
      FirstOrder<P> system(problem);
      PeerEnd end;
      try {
        odeint::integrate_adaptive(
            controlled(tolerance), [&](const auto& x, auto& dxdt, double) { system(x.data(), dxdt.data()); },
            state, t, horizon, 1e-3,
            [&](const auto& x, double) {
              watch(std::span<const double>(x));
              if (++end.steps > step_cap) throw std::runtime_error("step cap");
            });
        --end.steps;  // the observer also sees the start
        end.ok = true;
      } catch (const std::exception&) {
        end.ok = false;  // odeint throws when its step size underflows, too
      }
      end.evaluations = system.evaluations;
      std::copy(state.begin(), state.end(), y.begin());
      return end;
    };
  });
}

}  // namespace

template <class A>
void add_odeint(Scene& scene, const A& arena) {
  using State = std::array<double, 2 * A::n>;
  scene.families.push_back(odeint_family(arena, "odeint_dopri5", 5, [](double tolerance) {
    return odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<State>());
  }));
  scene.families.push_back(odeint_family(arena, "odeint_fehlberg78", 8, [](double tolerance) {
    return odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<State>());
  }));
  scene.families.push_back(odeint_family(arena, "odeint_bulirsch_stoer", 0, [](double tolerance) {
    return odeint::bulirsch_stoer<State>(tolerance, tolerance);
  }));
}

template void add_odeint(Scene&, const KeplerArena&);
template void add_odeint(Scene&, const PerturbedArena&);
template void add_odeint(Scene&, const HenonArena&);
template void add_odeint(Scene&, const EightArena&);
template void add_odeint(Scene&, const ClusterArena&);
template void add_odeint(Scene&, const ChainArena&);

}  // namespace experiment::work_precision
