#include "avi/optim/line_model.hpp"
#include "optimisers/optimiser_arena/meter.hpp"

#include <algorithm>

// Nonlinear conjugate gradients as textbooks have them: a search for the strong Wolfe conditions with sigma =
// 0.1 (Nocedal and Wright 2006, Algorithms 3.5 and 3.6, cubic interpolation), and the factors of Polak and
// Ribiere (PR+) and of Hager and Zhang (2005). The strongest conjugate gradients that we could set against
// avi::minimise().

namespace arena {
namespace {

struct Trial {
  double length = 0.0;
  avi::LinePoint at;
};

/// Searches along d from x, where value and slope are `start`; x_out and g_out hold the trial that is
/// returned.
Trial strong_wolfe(Meter& f, const VectorX& x, const VectorX& d, const avi::LinePoint& start, double length,
                   VectorX& x_out, VectorX& g_out) {
  constexpr double fall = 1e-4, flat = 0.1;
  Trial low{0.0, start}, high{}, now{};
  bool bracketed = false;
  for (int tries = 0; tries < 40; ++tries) {
    const Trial before = low;
    x_out = x + length * d;
    now = {length, {f(x_out, g_out), 0.0}};
    now.at.slope = avi::dot(g_out, d);
    const double noise = 1e-14 * (std::abs(start.value) + std::abs(now.at.value));
    if (!std::isfinite(now.at.value) || !std::isfinite(now.at.slope)) {
      high = now, bracketed = true;
      length = low.length + 0.1 * (length - low.length);
      high.at = {1e300, 1e300};
      continue;
    }
    const bool low_enough = now.at.value <= start.value + fall * length * start.slope + noise;
    if (low_enough && std::abs(now.at.slope) <= flat * std::abs(start.slope)) return now;
    if (!low_enough || now.at.value > low.at.value + noise ||
        (bracketed && now.at.slope * (high.length - low.length) > 0.0)) {
      if (low_enough && now.at.value <= low.at.value + noise)
        high = low, low = now;
      else
        high = now;
      bracketed = true;
    } else {
      if (!bracketed && now.at.slope > 0.0) high = low, bracketed = true;
      low = now;
    }
    if (!bracketed) {  // on, by the curvature between the last two points
      const double apart = now.length - before.length;
      length = before.length + apart * avi::LineModel(before.at, now.at, apart, 0.0).beyond();
      continue;
    }
    const double apart = high.length - low.length;
    double part = 0.5;
    if (high.at.value < 1e299) {
      const avi::LinePoint a{low.at.value, low.at.slope * (apart > 0 ? 1.0 : -1.0)};
      const avi::LinePoint b{high.at.value, high.at.slope * (apart > 0 ? 1.0 : -1.0)};
      part = avi::LineModel(a, b, std::abs(apart), 0.0).cubic();
    }
    length = low.length + std::clamp(part, 0.1, 0.9) * apart;
  }
  return now;
}

void conjugate(Meter& f, auto factor) {
  VectorX x = f.x0, g(x.size()), d, next, next_g(x.size());
  avi::LinePoint at{f(x, g), 0.0};
  d = -g;
  at.slope = avi::dot(d, g);
  double length = first_length(x, g, at.value);
  int stuck = 0;
  while (!f.over && stuck < 3) {
    const Trial trial = strong_wolfe(f, x, d, at, length, next, next_g);
    stuck = trial.at.value <= at.value + 1e-14 * std::abs(at.value) ? 0 : stuck + 1;
    const double beta = stuck > 0 ? 0.0 : factor(next_g, g, d);
    x.swap(next), g.swap(next_g);
    const double before = at.slope;
    d = beta * d - g;
    at = {trial.at.value, avi::dot(d, g)};
    if (!(at.slope < 0.0)) d = -g, at.slope = -avi::dot(g, g);
    length = trial.length * std::clamp(before / at.slope, 0.1, 10.0);
    ++f.iterations;
  }
}

double polak_ribiere(const VectorX& now, const VectorX& old, const VectorX&) {
  return std::max(0.0, (avi::dot(now, now) - avi::dot(now, old)) / avi::dot(old, old));
}
double hager_zhang(const VectorX& now, const VectorX& old, const VectorX& d) {
  const VectorX y = now - old;
  const double dy = avi::dot(d, y);
  const double beta = (avi::dot(y, now) - 2.0 * avi::dot(y, y) * avi::dot(d, now) / dy) / dy;
  return std::max(beta, -1.0 / (avi::norm(d) * std::min(0.01, avi::norm(old))));
}

}  // namespace

std::vector<Method> conjugate_gradients() {
  return {{"cg_pr", {[](Meter& f) { conjugate(f, polak_ribiere); }}},
          {"cg_hz", {[](Meter& f) { conjugate(f, hager_zhang); }}}};
}

}  // namespace arena
