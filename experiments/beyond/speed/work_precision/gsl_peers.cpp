#include "beyond/speed/work_precision/peer.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <memory>

namespace experiment::work_precision {
namespace {

struct Free {
  void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
};

template <class P>
int field(double, const double y[], double f[], void* self) {
  auto& system = *static_cast<FirstOrder<P>*>(self);
  system(y, f);
  return GSL_SUCCESS;
}

template <class P>
Family gsl(const Arena<P>& arena, const char* method, int order, const gsl_odeiv2_step_type* type) {
  return peer(arena, method, order, [type](const P& problem, double tolerance, long step_cap) {
    return [system = std::make_shared<FirstOrder<P>>(problem), type, tolerance,
            step_cap](std::span<double> y, double t, double horizon, auto&& watch) {
      gsl_odeiv2_system equations{&field<P>, nullptr, y.size(), system.get()};
      const std::unique_ptr<gsl_odeiv2_driver, Free> driver(
          gsl_odeiv2_driver_alloc_y_new(&equations, type, 1e-3, tolerance, tolerance));
      system->evaluations = 0;
      PeerEnd end;
      while (t < horizon) {
        const int status = gsl_odeiv2_evolve_apply(driver->e, driver->c, driver->s, &equations, &t, horizon,
                                                   &driver->h, y.data());
        if (status != GSL_SUCCESS || ++end.steps > step_cap) return end;
        watch(y);
      }
      end.ok = true;
      end.evaluations = system->evaluations;
      return end;
    };
  });
}

}  // namespace

template <class A>
void add_gsl(Scene& scene, const A& arena) {
  gsl_set_error_handler_off();
  scene.families.push_back(gsl(arena, "gsl_rk8pd", 8, gsl_odeiv2_step_rk8pd));
  scene.families.push_back(gsl(arena, "gsl_rkf45", 5, gsl_odeiv2_step_rkf45));
}

template void add_gsl(Scene&, const KeplerArena&);
template void add_gsl(Scene&, const PerturbedArena&);
template void add_gsl(Scene&, const HenonArena&);
template void add_gsl(Scene&, const EightArena&);
template void add_gsl(Scene&, const ClusterArena&);
template void add_gsl(Scene&, const ChainArena&);

}  // namespace experiment::work_precision
