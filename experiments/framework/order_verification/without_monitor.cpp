#include "framework/order_verification/cells.hpp"

#include "avi/problems/henon_heiles.hpp"

namespace {

/// H = sqrt(1 + p^2) - cos q: separable, T not quadratic.
struct Relativistic {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::cos, std::sqrt;
    return sqrt(1.0 + p[0] * p[0]) - cos(q[0]);
  }
};

/// H = p^2 (1 + q^2 / 2) / 2 + q^2 / 2: a bead whose inertia varies, not separable.
struct Bead {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const auto square = q[0] * q[0];
    return 0.5 * (p[0] * p[0]) * (1.0 + 0.5 * square) + 0.5 * square;
  }
};

}  // namespace

namespace experiment {

std::vector<OrderCell> order_cells_without_monitor(bool quick, const std::function<void(double)>& done) {
  std::vector<OrderCell> cells;
  const avi::State<2> star{.q = {0.1, -0.3}, .p = {0.4, 0.2}};
  add_problem(cells, "henon_heiles", avi::poincare<2>(avi::HenonHeiles{}, star), star, 2.5, quick);
  done(0.4);
  const avi::State<1> swing{.q = avi::Vector<double, 1>(0.7), .p = avi::Vector<double, 1>(0.9)};
  add_problem(cells, "relativistic", avi::poincare<1>(Relativistic{}, swing), swing, 2.0, quick);
  done(0.7);
  add_problem(cells, "non_separable", avi::poincare<1>(Bead{}, swing), swing, 2.0, quick);
  done(1.0);
  return cells;
}

}  // namespace experiment
