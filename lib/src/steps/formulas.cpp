#include "src/steps/formulas.hpp"

#include "src/autodiff/schedule.hpp"

#include <utility>

namespace avi::detail {

Formulas Formulas::of(ExpressionGraph graph, int transformed, int rate, int energy,
                      const std::vector<int>& supplied, int parameters) {
  Program its_rate;
  const bool unit = graph.is(rate, 1.0);
  if (!unit) its_rate = Schedule::program(graph, rate, {}, graph.size());
  Formulas made = fixed(Recording(std::move(graph), transformed, energy, supplied), parameters);
  made.unit = unit;
  made.rate = std::move(its_rate);
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
