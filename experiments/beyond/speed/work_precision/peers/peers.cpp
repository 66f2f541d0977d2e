#include "beyond/speed/work_precision/peers/peers.hpp"

#include "beyond/speed/work_precision/clock.hpp"
#include "beyond/speed/work_precision/peers/peer.hpp"

#include <gsl/gsl_version.h>

#include <algorithm>
#include <cmath>
#include <utility>
#ifdef AVI_WITH_ODEINT
#include <boost/version.hpp>
#endif
#ifdef AVI_WITH_SUNDIALS
#include <sundials/sundials_config.h>
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

void add_peers(Scene& scene, const Equations& equations) {
  add_gsl(scene, equations);
#ifdef AVI_WITH_ODEINT
  add_odeint(scene, equations);
#endif
#ifdef AVI_WITH_SUNDIALS
  add_sundials(scene, equations);
#endif
}

std::string peers_present() {
  std::string text = "GSL " GSL_VERSION ", Boost.odeint ";
#ifdef AVI_WITH_ODEINT
  text += BOOST_LIB_VERSION;
#else
  text += "absent";
#endif
  text += ", SUNDIALS ";
#ifdef AVI_WITH_SUNDIALS
  text += SUNDIALS_VERSION;
#else
  text += "absent";
#endif
  return text;
}

}  // namespace experiment::work_precision
