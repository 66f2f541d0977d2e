#include "formulas.hpp"

#include "schedule.hpp"

namespace avi::detail {

Formulas Formulas::of(const ExpressionGraph& graph, int transformed, int rate, int energy,
                      const std::vector<int>& supplied, int parameters) {
  Formulas made = fixed(Recording(graph, transformed, energy, supplied), parameters);
  made.unit = graph.is(rate, 1.0);
  if (!made.unit) made.rate = Schedule::program(graph, rate, {}, graph.size());
  return made;
}

Formulas Formulas::fixed(const Recording& recording, int parameters) {
  const int n = (recording.inputs() - parameters) / 2;
  return {.forces = recording.gradient(0, n),
          .velocities = recording.gradient(n, n),
          .rate = {},
          .unit = true,
          .n = n,
          .parameters = std::vector<double>(static_cast<std::size_t>(parameters))};
}

}  // namespace avi::detail
