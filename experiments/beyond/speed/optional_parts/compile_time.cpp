#include "beyond/speed/optional_parts/parts.hpp"

namespace experiment {

namespace {

template <int order>
std::vector<Part> parts() {
  const auto problem = avi::poincare<2>(avi::Kepler{}, part_start(), part_monitor());
  return {part("order known to the compiler", "bare", order, avi::htvi<order>(problem), part_start())};
}

}  // namespace

std::vector<Part> parts_at_compile_time(int order) { return order == 4 ? parts<4>() : parts<8>(); }

}  // namespace experiment
