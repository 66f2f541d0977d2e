#include "common/rules/update_rules.hpp"
#include "optimisers/optimiser_arena/meter.hpp"

#include <algorithm>
#include <deque>

namespace arena {
namespace {

/// Nesterov's method with backtracking on L (Beck and Teboulle 2009) and restart by the gradient (O'Donoghue
/// and Candes 2015).
void nag_restart(Meter& f) {
  VectorX x = f.x0, y = f.x0, g(x.size()), next;
  double value = f(y, g), length = first_length(y, g, value), k = 0.0;
  while (!f.over) {
    const double square = avi::dot(g, g);
    for (int tries = 0; tries < 60; ++tries) {
      next = y - length * g;
      if (f.value(next) <= value - 0.5 * length * square + 1e-15 * std::abs(value)) break;
      length *= 0.5;
    }
    k = avi::dot(g, next - x) > 0.0 ? 0.0 : k + 1.0;
    y = next + (k / (k + 3.0)) * (next - x);
    x = next;
    length *= 1.1;
    value = f(y, g);
    ++f.iterations;
  }
}

/// Barzilai and Borwein's step (1988) with the non-monotone test over ten values (Raydan 1997).
void barzilai_borwein(Meter& f) {
  VectorX x = f.x0, g(x.size()), next, next_g(x.size());
  double value = f(x, g), length = first_length(x, g, value);
  std::deque<double> last{value};
  while (!f.over) {
    const double square = avi::dot(g, g), top = *std::max_element(last.begin(), last.end());
    double next_value = 0.0;
    for (int tries = 0; tries < 60; ++tries, length *= 0.25) {
      next = x - length * g;
      next_value = f(next, next_g);
      if (next_value <= top - 1e-4 * length * square) break;
    }
    const VectorX s = next - x, y = next_g - g;
    const double curvature = avi::dot(s, y);
    length = curvature > 0.0 ? avi::dot(s, s) / curvature : 10.0 * length;
    x.swap(next), g.swap(next_g), value = next_value;
    last.push_back(value);
    if (last.size() > 10) last.pop_front();
    ++f.iterations;
  }
}

}  // namespace

std::vector<Method> first_order_methods() {
  Method rmsprop{.name = "rmsprop_best", .runs = {}, .slow = true};  // at the best of six rates
  for (const double rate : {1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0})
    rmsprop.runs.push_back([rate](Meter& meter) { follow(meter, experiment::RmsProp{.rate = rate}); });
  return {{"nag_restart", {nag_restart}}, {"barzilai_borwein", {barzilai_borwein}}, rmsprop};
}

}  // namespace arena
