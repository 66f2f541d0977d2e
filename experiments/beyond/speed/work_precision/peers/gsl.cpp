#include "beyond/speed/work_precision/peers/peer.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <memory>

namespace experiment::work_precision {
namespace {

struct Free {
  void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
};

Family gsl(const Equations& equations, const char* method, int order, const gsl_odeiv2_step_type* type) {
  return peer(equations, method, order, [type](Task& task) {
    gsl_odeiv2_system system{task.equations.field, nullptr, task.y.size(), &task.f};
    const std::unique_ptr<gsl_odeiv2_driver, Free> driver(
        gsl_odeiv2_driver_alloc_y_new(&system, type, 1e-3, task.tolerance, task.tolerance));
    double t = 0.0;
    while (t < task.equations.horizon)
      if (gsl_odeiv2_evolve_apply(driver->e, driver->c, driver->s, &system, &t, task.equations.horizon,
                                  &driver->h, task.y.data()) != GSL_SUCCESS ||
          !task.stepped(task.y.data()))
        return false;
    return true;
  });
}

}  // namespace

void add_gsl(Scene& scene, const Equations& equations) {
  gsl_set_error_handler_off();
  scene.families.push_back(gsl(equations, "gsl_rk8pd", 8, gsl_odeiv2_step_rk8pd));
  scene.families.push_back(gsl(equations, "gsl_rkf45", 5, gsl_odeiv2_step_rkf45));
}

}  // namespace experiment::work_precision
