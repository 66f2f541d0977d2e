#include "framework/order_verification/cells.hpp"

#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"

namespace {

using std::cos, std::sqrt;

/// On the line, separable with T not quadratic, H = sqrt(1 + p^2) - cos q; or a bead whose inertia varies,
/// not separable, H = p^2 (1 + q^2 / 2) / 2 + q^2 / 2.
struct Line {
  bool separable;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using S = std::decay_t<decltype(q[0] * p[0])>;
    if (separable) return S(sqrt(1.0 + p[0] * p[0]) - cos(q[0]));
    const auto square = q[0] * q[0];
    return S(0.5 * (p[0] * p[0]) * (1.0 + 0.5 * square) + 0.5 * square);
  }
};

/// In the plane, T quadratic: Kepler, which supplies its gradients, or Henon-Heiles, which does not.
struct Plane {
  bool kepler;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
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

}  // namespace

namespace experiment {

std::vector<OrderCell> order_cells_without_monitor(bool quick, const std::function<void(double)>& done) {
  std::vector<OrderCell> cells;
  const avi::State<2> star{.q = {0.1, -0.3}, .p = {0.4, 0.2}}, orbit = avi::Kepler::pericentre(0.3);
  const avi::State<1> swing{.q = avi::Vector<double, 1>(0.7), .p = avi::Vector<double, 1>(0.9)};
  add_problem<true>(cells, "henon_heiles", avi::poincare<2>(Plane{false}, star), star, 2.5, quick, false);
  done(0.3);
  add_problem(cells, "relativistic", avi::poincare<1>(Line{true}, swing), swing, 2.0, quick);
  done(0.5);
  add_problem(cells, "non_separable", avi::poincare<1>(Line{false}, swing), swing, 2.0, quick);
  done(0.7);
  add_problem<true>(cells, "kepler", avi::poincare<2>(Plane{true}, orbit), orbit, 5.0, quick);
  done(1.0);
  return cells;
}

}  // namespace experiment
