#include "order/cells.hpp"

std::vector<experiment::OrderCell> experiment::order_cells_printed(bool quick,
                                                                   const std::function<void(double)>& done) {
  return order_cells<avi::printed>("printed", quick, done);
}
