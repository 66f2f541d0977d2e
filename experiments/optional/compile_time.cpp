#include "optional/parts.hpp"

#include "avi/htvi/value_first.hpp"

namespace experiment {

namespace {

template <int order>
std::vector<Part> parts() {
  const auto method = avi::type2<order - 1, lean>(
      avi::poincare<2>(avi::Kepler{}, part_start(), part_monitor()), avi::gauss(order / 2));
  const avi::ValueFirst first(method);
  const auto start = part_start();
  // The Taylor expansion of a step this short has converged to round-off.
  constexpr double tiny = order == 4 ? 1e-5 : 2e-3;
  return {part("order known to the compiler", "bare", order, method, start),
          part("ValueFirst, never converged", "order known to the compiler", order, first, start),
          part("tiny steps", "tiny steps", order, method, start, tiny),
          part("ValueFirst, always converged", "tiny steps", order, first, start, tiny)};
}

}  // namespace

std::vector<Part> parts_at_compile_time(int order) { return order == 4 ? parts<4>() : parts<8>(); }

}  // namespace experiment
