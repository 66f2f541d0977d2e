#include "order/cells.hpp"

std::vector<experiment::OrderCell>
experiment::order_cells_superconvergent(bool quick, const std::function<void(double)>& done) {
  return order_cells<avi::superconvergent>("superconvergent", quick, done);
}
