#include "beyond/speed/optional_parts/parts.hpp"

#include "avi/transform/time_dependent.hpp"

namespace experiment {

std::vector<Part> parts_of_construction(int order) {
  const auto start = part_start();
  const auto monitor = part_monitor();
  const auto problem = avi::poincare<2>(avi::Kepler{}, start, monitor);
  const auto in_time = avi::time_dependent(
      [](const auto& q, const auto&, const auto& p) { return avi::Kepler{}(q, p); }, start, monitor);
  const auto printed =
      avi::htvi_of_order<avi::Generating::type2, avi::printed>(order - 1, problem, avi::gauss(order / 2));
  const auto authors =
      avi::htvi_of_order<avi::Generating::type2, avi::authors>(order - 1, problem, avi::gauss(order / 2));
  return {part("bare", "bare", order, part_method(order, problem), start),
          part("as printed, of the same order", "bare", order, printed, start),
          part("on the energy shell, of the same order", "bare", order, authors, start),
          part("Type III", "bare", order, part_method<avi::Generating::type3>(order, problem), start),
          part("t and p^t as coordinates", "automatic gradient", order, part_method(order, in_time),
               avi::extended(in_time, start))};
}

}  // namespace experiment
