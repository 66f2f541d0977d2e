#include "optional/parts.hpp"

namespace experiment {

std::vector<Part> parts_of_construction(int order) {
  using avi::Field, avi::NodePosition;
  const auto problem = avi::poincare<2>(avi::Kepler{}, part_start(), part_monitor());
  constexpr avi::Construction full{Field::full, NodePosition::r};
  return {
      part("bare", "bare", order, part_method<lean>(order, problem), part_start()),
      part("position raised at the end node", "bare", order, part_method<avi::authors>(order, problem),
           part_start()),
      part("position raised at every node", "bare", order, part_method<avi::superconvergent>(order, problem),
           part_start()),
      part("p^t as an unknown, full field", "bare", order, part_method<full>(order, problem), part_start()),
      part("Type III", "bare", order, part_method<lean, avi::Generating::type3>(order, problem),
           part_start())};
}

}  // namespace experiment
