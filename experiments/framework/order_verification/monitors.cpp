#include "framework/order_verification/cells.hpp"

#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"

namespace experiment {

std::vector<OrderCell> order_cells_of_monitors(bool quick, const std::function<void(double)>& done) {
  std::vector<OrderCell> cells;
  const auto orbit = avi::Kepler::pericentre(0.3);
  add_problem<true>(cells, "kepler", avi::poincare<2>(avi::Kepler{}, orbit), orbit, 5.0, quick);
  done(0.3);
  add_problem<true>(cells, "kepler_gamma", avi::poincare<2>(avi::Kepler{}, orbit, avi::NormSquared{}), orbit,
                    5.0, quick);
  done(0.6);
  add_problem(cells, "kepler_gamma_075", avi::poincare<2>(avi::Kepler{}, orbit, avi::Gamma{0.75}), orbit, 5.0,
              quick);
  done(1.0);
  return cells;
}

}  // namespace experiment
