#include "optional/parts.hpp"

#include "avi/adaptive/time_dependent.hpp"

namespace experiment {

std::vector<Part> parts_of_dimension(int order) {
  const avi::State<2> start = part_start();
  const avi::State<avi::dynamic> same{.q = start.q, .p = start.p};
  const auto monitor = part_monitor();
  const auto free = avi::poincare<avi::dynamic>(avi::Automatic<avi::Kepler>{}, same, monitor);
  const auto in_time =
      avi::time_dependent<2>([](const auto& q, const auto&, const auto& p) { return avi::Kepler{}(q, p); },
                             [=](const auto& q, const auto&, const auto&) { return monitor(q); });
  return {part("run-time dimension", "automatic gradient", order, part_method<lean>(order, free), same),
          part("t and p^t as coordinates", "automatic gradient", order, part_method<lean>(order, in_time),
               avi::extended(in_time, start))};
}

}  // namespace experiment
