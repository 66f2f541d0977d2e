#include "beyond/speed/work_precision/scenes.hpp"

#include "common/reference.hpp"

#include <gsl/gsl_version.h>

#include <limits>
#include <map>
#include <memory>
#include <utility>
#ifdef AVI_WITH_ODEINT
#include <boost/version.hpp>
#endif
#ifdef AVI_WITH_SUNDIALS
#include <sundials/sundials_config.h>
#endif

namespace experiment::work_precision {
namespace {

template <class A>
void add_methods(Scene& scene, const A& arena) {
  add_explicit(scene, arena);
  add_collocation(scene, arena);
  if constexpr (A::n <= 6) add_htvi(scene, arena);
  add_gsl(scene, arena);
#ifdef AVI_WITH_ODEINT
  add_odeint(scene, arena);
#endif
#ifdef AVI_WITH_SUNDIALS
  add_sundials(scene, arena);
#endif
}

/// Reference by extended precision runs, one per start and made when first asked for. Its own error is the
/// difference at the horizon from a run with two thirds of the step.
template <class P>
void set_extended_reference(Scene& scene, const Arena<P>& arena, bool log_form, long double h) {
  using Run = ExtendedRun<P>;
  const auto run = [=](int k, long double step) {
    auto made = std::make_shared<Run>(arena.problem, arena.at(k), log_form, step);
    made->run_to(arena.horizon);
    return made;
  };
  auto runs = std::make_shared<std::map<int, std::shared_ptr<Run>>>();
  scene.position_error = [=](int k, double t, const Eigen::VectorXd& q) {
    auto& made = (*runs)[k];
    if (!made) made = run(k, h);
    return (made->position(t) - q).norm();
  };
  scene.reference_error = scene.position_error(0, arena.horizon, run(0, h / 1.5L)->position(arena.horizon));
}

Scene kepler(double e, double horizon, const std::string& horizon_name) {
  const KeplerArena arena({}, horizon, avi::Kepler::pericentre(e));
  Scene scene{"kepler", e, horizon, horizon_name, {}, 0.0, {}};
  scene.position_error = [arena](int k, double t, const Eigen::VectorXd& q) {
    return (exact_kepler(arena.at(k), t) - q).norm();
  };
  add_methods(scene, arena);
  return scene;
}

Scene perturbed_kepler(double e, double horizon, const std::string& horizon_name) {
  const PerturbedArena arena(avi::PerturbedKepler(1e-3), horizon, avi::PerturbedKepler::pericentre(e));
  Scene scene{"perturbed_kepler", e, horizon, horizon_name, {}, 0.0, {}};
  set_extended_reference(scene, arena, true, 0.15L);
  add_methods(scene, arena);
  return scene;
}

Scene henon_heiles(double horizon, const std::string& horizon_name) {
  const HenonArena arena({}, horizon, avi::HenonHeiles::on_section(1.0 / 12.0, 0.1, 0.0));
  Scene scene{"henon_heiles", std::numeric_limits<double>::quiet_NaN(), horizon, horizon_name, {}, 0.0, {}};
  set_extended_reference(scene, arena, false, 0.4L);
  add_methods(scene, arena);
  return scene;
}

Scene figure_eight(double horizon, const std::string& horizon_name) {
  const EightArena arena(avi::FigureEight::problem(), horizon, avi::FigureEight::start());
  Scene scene{"figure_eight", std::numeric_limits<double>::quiet_NaN(), horizon, horizon_name, {}, 0.0, {}};
  set_extended_reference(scene, arena, false, 0.05L);
  add_methods(scene, arena);
  return scene;
}

/// Seven unit masses, with encounters down to a hundredth of the cluster's size.
Scene cluster() {
  avi::State<14> z;
  z.q << 1.0, 0.1, -0.9, 0.4, 0.2, -0.8, -0.3, 0.9, 0.5, 0.6, -0.6, -0.5, 0.1, 0.15;
  z.p << -0.3, 0.9, 0.2, -0.8, 0.9, 0.1, -0.7, -0.4, -0.5, 0.6, 0.5, -0.7, -0.1, 0.3;
  const ClusterArena arena(avi::NBody<7>(avi::NBody<7>::Masses::Ones()), 1.0, z);
  Scene scene{"star_cluster", std::numeric_limits<double>::quiet_NaN(), 1.0, "1", {}, 0.0, {}};
  set_extended_reference(scene, arena, true, 0.02L);
  add_methods(scene, arena);
  return scene;
}

Scene chain() {
  const avi::State<avi::dynamic> plucked = avi::Chain::plucked(64);
  const ChainArena arena({}, 100.0, {.q = plucked.q, .p = plucked.p});
  Scene scene{"chain64", std::numeric_limits<double>::quiet_NaN(), 100.0, "100", {}, 0.0, {}};
  set_extended_reference(scene, arena, false, 0.25L);
  add_methods(scene, arena);
  return scene;
}

/// Over many periods only the methods that stand a chance are run; the short horizon shows why.
Scene thinned(Scene scene) {
  std::erase_if(scene.families, [](const Family& f) {
    const bool fixed = f.method.starts_with("verlet_") || f.method.starts_with("stormer_");
    return (f.order < 6 && f.origin != Origin::peer) || (fixed && f.method != "verlet_kahan_li8") ||
           f.method == "odeint_dopri5" || f.method == "gsl_rkf45";
  });
  return scene;
}

}  // namespace

std::vector<Scene> scenes(Grid grid) {
  const double period = 2.0 * M_PI;
  if (grid == Grid::quick) {
    std::vector<Scene> one;
    one.push_back(kepler(0.9, 10.0, "10"));
    return one;
  }
  std::vector<Scene> list;
  for (double e : {0.9, 0.99, 0.999})
    list.push_back(kepler(e, 10.0, "10"));
  if (grid == Grid::full)
    for (double e : {0.9, 0.99, 0.999})
      list.push_back(thinned(kepler(e, 1000 * period, "1000 periods")));
  else
    list.push_back(thinned(kepler(0.9, 100 * period, "100 periods")));
  list.push_back(perturbed_kepler(0.9, 10.0, "10"));
  if (grid == Grid::full) list.push_back(thinned(perturbed_kepler(0.9, 1000 * period, "1000 periods")));
  list.push_back(henon_heiles(grid == Grid::full ? 1000.0 : 100.0, grid == Grid::full ? "1000" : "100"));
  for (int periods : grid == Grid::full ? std::vector{10, 100} : std::vector{10})
    list.push_back(figure_eight(periods * avi::FigureEight::period, std::to_string(periods) + " periods"));
  list.push_back(cluster());
  list.push_back(chain());
  return list;
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
