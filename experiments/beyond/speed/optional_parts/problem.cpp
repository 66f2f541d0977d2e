#include "beyond/speed/optional_parts/parts.hpp"

namespace experiment {

std::vector<Part> parts_of_problem(int order) {
  const avi::Kepler kepler;
  const avi::State<2> start = part_start();
  const auto monitor = part_monitor();
  std::vector<Part> parts;
  const auto add = [&](const char* name, const auto& problem, double h) {
    parts.push_back(part(name, "bare", order, part_method(order, problem), start, h));
  };
  add("no monitor", avi::poincare<2>(kepler, start), 0.0025);
  add("monitor of q and p",
      avi::poincare<2>(kepler, start, avi::bounded(avi::Energy<avi::Kepler>{kepler, 0.5}, 1e-4, 2.0)),
      part_h);
  add("automatic gradient", avi::poincare<2>(avi::Automatic<avi::Kepler>{kepler}, start, monitor), part_h);
  return parts;
}

}  // namespace experiment
