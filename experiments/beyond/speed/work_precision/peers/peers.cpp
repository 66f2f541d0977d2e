#include "beyond/speed/work_precision/peers/peers.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_version.h>

#include <algorithm>
#include <cmath>
#include <utility>
#ifdef AVI_WITH_ODEINT
#include <boost/version.hpp>
#else
#define BOOST_LIB_VERSION "absent"
#endif
#ifdef AVI_WITH_SUNDIALS
#include <sundials/sundials_config.h>
#else
#define SUNDIALS_VERSION "absent"
#endif

namespace experiment::work_precision {

Family peer(const Equations& equations, std::string method, int order, std::function<bool(Task&)> solve) {
  const auto run = [equations, solve = std::move(solve)](const Request& request) {
    const auto& start = equations.start[static_cast<std::size_t>(request.start)];
    Task task{equations, request.setting, request.step_cap, start, nullptr};
    Result result;
    const auto once = [&] {
      task.y = start;
      task.steps = task.f.evaluations = 0;
      result.ok = solve(task);
    };
    if (request.watch_energy) {
      task.watch = [&, energy = equations.energy(start.data())](const double* y) {
        result.energy_error = std::max(result.energy_error, std::abs(equations.energy(y) - energy));
      };
      once();
    } else {
      result.seconds = block_seconds(once, request.repeats);
    }
    result.q = Eigen::Map<const Eigen::VectorXd>(task.y.data(), static_cast<Eigen::Index>(start.size() / 2));
    result.t = equations.horizon;
    result.steps = task.steps;
    result.evaluations = task.f.evaluations;
    return result;
  };
  return {std::move(method), order, Origin::peer, "tolerance", geometric(1e-2, std::sqrt(0.1), 29), run};
}

namespace {

Family gsl(const Equations& equations, const char* method, int order, const gsl_odeiv2_step_type* type) {
  return peer(equations, method, order, [type](Task& task) {
    gsl_odeiv2_system system{task.equations.field, nullptr, task.y.size(), &task.f};
    const std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver(
        gsl_odeiv2_driver_alloc_y_new(&system, type, 1e-3, task.tolerance, task.tolerance),
        gsl_odeiv2_driver_free);
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

void add_peers(Scene& scene, const Equations& equations) {
  gsl_set_error_handler_off();
  scene.families.push_back(gsl(equations, "gsl_rk8pd", 8, gsl_odeiv2_step_rk8pd));
  scene.families.push_back(gsl(equations, "gsl_rkf45", 5, gsl_odeiv2_step_rkf45));
#ifdef AVI_WITH_ODEINT
  add_odeint(scene, equations);
#endif
#ifdef AVI_WITH_SUNDIALS
  add_sundials(scene, equations);
#endif
}

std::string peers_present() {
  std::string boost = BOOST_LIB_VERSION;
  std::ranges::replace(boost, '_', '.');
  return "GSL " GSL_VERSION ", Boost.odeint " + boost + ", SUNDIALS " SUNDIALS_VERSION;
}

}  // namespace experiment::work_precision
