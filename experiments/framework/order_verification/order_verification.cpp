#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/time_dependent.hpp"
#include "common/frame.hpp"
#include "framework/order_verification/cells.hpp"

// The order of the map as an experiment: min(2r + 2, s) for the stationary construction and Taylor order r,
// quadrature order s; min(r + 1, s) at least for the paper's (Section 2.2). Type II and III.

namespace {

using namespace experiment;
using std::cos, std::sqrt;

/// On the line, separable with T not quadratic, H = sqrt(1 + p^2) - cos q; or a bead whose inertia varies,
/// not separable, H = p^2 (1 + q^2 / 2) / 2 + q^2 / 2.
struct Line {
  bool separable;
  auto operator()(const auto& q, const auto& p) const {
    using S = std::decay_t<decltype(q[0] * p[0])>;
    if (separable) return S(sqrt(1.0 + p[0] * p[0]) - cos(q[0]));
    const auto square = q[0] * q[0];
    return S(0.5 * (p[0] * p[0]) * (1.0 + 0.5 * square) + 0.5 * square);
  }
};

/// In the plane, T quadratic: Kepler, which supplies its gradients, or Henon-Heiles, which does not.
struct Plane {
  bool kepler;
  auto operator()(const auto& q, const auto& p) const {
    using S = std::decay_t<decltype(q[0] * p[0])>;
    return kepler ? S(avi::Kepler{}(q, p)) : S(avi::HenonHeiles{}(q, p));
  }
  template <class S>
  avi::Vector<S, 2> d_dq(const avi::Vector<S, 2>& q, const avi::Vector<S, 2>& p) const {
    return kepler ? avi::d_dq(avi::Kepler{}, q, p) : avi::d_dq(avi::HenonHeiles{}, q, p);
  }
  template <class S>
  avi::Vector<S, 2> d_dp(const avi::Vector<S, 2>& q, const avi::Vector<S, 2>& p) const {
    return kepler ? avi::d_dp(avi::Kepler{}, q, p) : avi::d_dp(avi::HenonHeiles{}, q, p);
  }
};

/// |q|^2, or |q|^(3/2), which is no polynomial of q.
struct Radius {
  bool square;
  auto operator()(const auto& q) const {
    using S = std::decay_t<decltype(q[0] * q[0])>;
    return square ? S(avi::NormSquared{}(q)) : S(avi::Gamma{0.75}(q));
  }
};

/// A pendulum whose weight varies, H = p^2 / 2 - (1 + cos(t) / 2) cos q.
struct Driven {
  auto operator()(const auto& q, const auto& t, const auto& p) const {
    return 0.5 * (p[0] * p[0]) - (1.0 + 0.5 * cos(t)) * cos(q[0]);
  }
};

/// g = 1 / (1 + p^2 / 2).
struct SlowWhenFast {
  auto operator()(const auto&, const auto& p) const { return 1.0 / (1.0 + 0.5 * (p[0] * p[0])); }
};

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& out = frame.table({"problem", "type", "r", "quadrature", "expected_order", "measured_order",
                            "construction", "points", "limit_order"});
  out.note("measured_order",
           "slope of the final error in (q, p, t) over the step, nan with fewer than 3 usable points");
  out.note("limit_order",
           "slope at h = 0, extrapolated from measured_order and the slope of the four steps before");
  double done = 0.0;
  const auto add = [&](const char* name, const auto& problem, const auto& start, double horizon) {
    add_problem(out, name, problem, start, horizon, frame.quick);
    frame.progress(name, ++done, 8.0);
  };
  const avi::State<2> star{.q = {0.1, -0.3}, .p = {0.4, 0.2}}, orbit = avi::Kepler::pericentre(0.3);
  const avi::State<1> swing{.q = avi::Vector<double, 1>(0.7), .p = avi::Vector<double, 1>(0.9)};
  // Without a monitor: T quadratic, relativistic, not separable, Kepler.
  add("henon_heiles", avi::poincare<2>(Plane{false}, star), star, 2.5);
  add("relativistic", avi::poincare<1>(Line{true}, swing), swing, 2.0);
  add("non_separable", avi::poincare<1>(Line{false}, swing), swing, 2.0);
  add("kepler", avi::poincare<2>(Plane{true}, orbit), orbit, 5.0);
  // Monitors of the position, and one of position and momentum.
  const avi::Kepler kepler;
  add("kepler_gamma", avi::poincare<2>(kepler, orbit, Radius{true}), orbit, 5.0);
  add("kepler_gamma_075", avi::poincare<2>(kepler, orbit, Radius{false}), orbit, 5.0);
  const avi::Energy monitor{kepler, -kepler(orbit.q, orbit.p)};
  add("kepler_energy", avi::poincare<2>(kepler, orbit, avi::bounded(monitor, 0.1, 3.0)), orbit, 1.5);
  // A Hamiltonian that depends on time.
  const auto driven = avi::time_dependent(Driven{}, swing, SlowWhenFast{});
  add("driven_pendulum", driven, avi::extended(driven, swing), 2.0);
}
