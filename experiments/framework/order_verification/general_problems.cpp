#include "framework/order_verification/cells.hpp"

#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/time_dependent.hpp"

namespace {

/// A pendulum whose weight varies, H = p^2 / 2 - (1 + cos(t) / 2) cos q.
struct Driven {
  template <class Q, class S, class P>
  auto operator()(const Q& q, const S& t, const P& p) const {
    using std::cos;
    return 0.5 * (p[0] * p[0]) - (1.0 + 0.5 * cos(t)) * cos(q[0]);
  }
};

/// g = 1 / (1 + p^2 / 2).
struct SlowWhenFast {
  template <class Q, class P>
  auto operator()(const Q&, const P& p) const {
    return 1.0 / (1.0 + 0.5 * (p[0] * p[0]));
  }
};

}  // namespace

namespace experiment {

std::vector<OrderCell> order_cells_of_general_problems(bool quick, const std::function<void(double)>& done) {
  std::vector<OrderCell> cells;
  const auto orbit = avi::Kepler::pericentre(0.3);
  const avi::Kepler kepler;
  const double energy = kepler(orbit.q, orbit.p);
  add_problem(cells, "kepler_energy",
              avi::poincare<2>(kepler, orbit, avi::bounded(avi::Energy{kepler, -energy}, 0.1, 3.0)), orbit,
              1.5, quick);
  done(0.5);
  const avi::State<1> swing{.q = avi::Vector<double, 1>(0.7), .p = avi::Vector<double, 1>(0.9)};
  const auto driven = avi::time_dependent(Driven{}, swing, SlowWhenFast{});
  add_problem(cells, "driven_pendulum", driven, avi::extended(driven, swing), 2.0, quick);
  done(1.0);
  return cells;
}

}  // namespace experiment
