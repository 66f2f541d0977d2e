#include "optimisers/optimiser_arena/meter.hpp"

#include "common/rules/update_rules.hpp"

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

/// Gradient descent with the adaptive step of Malitsky and Mishchenko (2020).
void adgd(Meter& f) {
  VectorX x = f.x0, g(x.size()), next, next_g(x.size());
  double length = first_length(x, g, f(x, g)), ratio = 1e9;
  while (!f.over) {
    next = x - length * g;
    f(next, next_g);
    const double dx = avi::norm(next - x), dg = avi::norm(next_g - g);
    const double grown = std::sqrt(1.0 + ratio) * length;
    const double now = dg > 0.0 ? std::min(grown, 0.5 * dx / dg) : grown;
    ratio = now / length, length = now;
    x.swap(next), g.swap(next_g);
    ++f.iterations;
    if (!std::isfinite(dx)) return;
  }
}

/// At the usual rate, and at the best of six.
template <class Rule>
void add(std::vector<Method>& all, const std::string& name, double usual) {
  const auto with = [](double rate) { return [rate](Meter& meter) { follow(meter, Rule{.rate = rate}); }; };
  all.push_back({name, {with(usual)}, true});
  all.push_back({name + "_best", {}, true});
  for (double rate : {1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0})
    all.back().runs.push_back(with(rate));
}

}  // namespace

std::vector<Method> first_order_methods() {
  std::vector<Method> all{
      {"nag_restart", {nag_restart}}, {"barzilai_borwein", {barzilai_borwein}}, {"adgd", {adgd}}};
  add<experiment::Adam>(all, "adam", 1e-3);
  add<experiment::AdaGrad>(all, "adagrad", 1e-2);
  add<experiment::RmsProp>(all, "rmsprop", 1e-2);
  return all;
}

}  // namespace arena
