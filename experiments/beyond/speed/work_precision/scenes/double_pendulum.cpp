#include "beyond/speed/work_precision/families/collocation.hpp"
#include "beyond/speed/work_precision/families/htvi.hpp"
#include "beyond/speed/work_precision/scenes/extrapolation.hpp"
#include "beyond/speed/work_precision/scenes/scenes.hpp"

#include "avi/problems/double_pendulum.hpp"

#include <fmt/format.h>

namespace experiment::work_precision {
namespace {

/// The double pendulum with its gradient by hand.
struct Pendulums : avi::DoublePendulum {
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

Scene double_pendulum(double horizon) {
  const Arena arena(Pendulums{}, horizon, avi::DoublePendulum::released(1.2, 0.8));
  Scene scene{"double_pendulum", not_an_orbit, horizon, fmt::format("{:g}", horizon)};
  set_reference(scene, arena, [](const avi::State<2>& start, long double fraction) {
    return Extrapolation<Pendulums>({}, start, 0.25L * fraction);
  });
  add_collocation(scene, arena, "g=1", 1.0, avi::Unit{}, true);
  add_htvi(scene, arena, "g=1", 0.5, avi::Unit{});
  add_peers(scene, arena.equations());
  return scene;
}

}  // namespace experiment::work_precision
