#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "beyond/speed/work_precision/scenes/families.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"
#include "common/extrapolation.hpp"
#include "common/problems/double_pendulum.hpp"
#include "common/problems/perturbed_kepler.hpp"
#include "common/reference.hpp"

#include <fmt/format.h>

namespace experiment::work_precision {
namespace {

/// The methods for an eccentric orbit, with or without perturbation.
template <class P>
void add_kepler_methods(Scene& scene, const Arena<P>& arena) {
  add_fixed(scene, arena, 0.02);
  add_logarithmic(scene, arena, 0.15);
  add_collocation(scene, arena, "g=r^1.5", 1.7, ThreeHalves{}, arena.horizon < 100.0);
  add_htvi(scene, arena, "g=r^1.5", 1.0, avi::Gamma{0.75});
  add_peers(scene, arena.equations());
}

/// The double pendulum with a hand-written gradient.
struct Pendulums : DoublePendulum {
  template <class S>
  avi::Vector<S, 2> d_dq(const avi::Vector<S, 2>& q, const avi::Vector<S, 2>& p) const {
    using std::cos, std::sin;
    const S s = sin(q[0] - q[1]), c = cos(q[0] - q[1]), rest = 1.0 / (1.0 + s * s);
    const S square = p[0] * p[0] + 2.0 * (p[1] * p[1]) - 2.0 * (p[0] * p[1]) * c;
    const S torque = rest * s * (p[0] * p[1] - rest * c * square);
    return {torque + 2.0 * sin(q[0]), -torque + sin(q[1])};
  }
  template <class S>
  avi::Vector<S, 2> d_dp(const avi::Vector<S, 2>& q, const avi::Vector<S, 2>& p) const {
    using std::cos, std::sin;
    const S s = sin(q[0] - q[1]), c = cos(q[0] - q[1]), rest = 1.0 / (1.0 + s * s);
    return {rest * (p[0] - c * p[1]), rest * (2.0 * p[1] - c * p[0])};
  }
};

}  // namespace

Scene kepler(double eccentricity, double horizon, const std::string& horizon_name) {
  const Arena<avi::Kepler> arena({}, horizon, avi::Kepler::pericentre(eccentricity));
  Scene scene{"kepler", eccentricity, horizon, horizon_name};
  scene.position_error = [arena](int k, double t, const Eigen::VectorXd& q) {
    return (exact_kepler(arena.at(k), t) - q).norm();
  };
  add_kepler_methods(scene, arena);
  return scene;
}

Scene perturbed_kepler() {
  const Arena arena(PerturbedKepler(1e-3), 10.0, avi::Kepler::pericentre(0.9));
  Scene scene{"perturbed_kepler", 0.9, 10.0, "10"};
  set_extended_reference(scene, arena, true, 0.1L);
  add_kepler_methods(scene, arena);
  return scene;
}

Scene henon_heiles(double horizon) {
  const Arena arena(avi::HenonHeiles{}, horizon, avi::HenonHeiles::on_section(1.0 / 12.0, 0.1, 0.0));
  Scene scene{"henon_heiles", unknown, horizon, fmt::format("{:g}", horizon)};
  set_extended_reference(scene, arena, false, 0.15L);
  add_fixed(scene, arena, 0.25);
  add_collocation(scene, arena, "g=1", 4.0, avi::Unit{}, true);
  add_htvi(scene, arena, "g=1", 2.0, avi::Unit{});
  add_peers(scene, arena.equations());
  return scene;
}

Scene double_pendulum() {
  const Arena arena(Pendulums{}, 100.0, DoublePendulum::released(1.2, 0.8));
  Scene scene{"double_pendulum", unknown, 100.0, "100"};
  scene.longest_run = 0.5;
  set_reference(scene, arena, [](const avi::State<2>& start, long double fraction) {
    return Extrapolation<Pendulums>({}, start, 0.25L * fraction);
  });
  add_collocation(scene, arena, "g=1", 1.0, avi::Unit{}, true);
  add_htvi(scene, arena, "g=1", 0.5, avi::Unit{});
  add_peers(scene, arena.equations());
  return scene;
}

}  // namespace experiment::work_precision
