#include "framework/order_verification/cells.hpp"

#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"

namespace {

/// |q|^2, or |q|^(3/2), which is no polynomial of q.
struct Radius {
  bool square;
  template <class Q>
  auto operator()(const Q& q) const {
    using S = std::decay_t<decltype(q[0] * q[0])>;
    return square ? S(avi::NormSquared{}(q)) : S(avi::Gamma{0.75}(q));
  }
};

}  // namespace

namespace experiment {

std::vector<OrderCell> order_cells_of_monitors(bool quick, const std::function<void(double)>& done) {
  std::vector<OrderCell> cells;
  const auto orbit = avi::Kepler::pericentre(0.3);
  for (const bool square : {true, false}) {
    add_problem<true>(cells, square ? "kepler_gamma" : "kepler_gamma_075",
                      avi::poincare<2>(avi::Kepler{}, orbit, Radius{square}), orbit, 5.0, quick, square);
    done(square ? 0.5 : 1.0);
  }
  return cells;
}

}  // namespace experiment
