#include "hostile/reference.hpp"

#include "hostile/formulas.hpp"

#include <algorithm>
#include <limits>

namespace hostile {

namespace {
constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
}

Reference::Reference(const System& system) : tape_(2 * system.n), size_(2 * system.n), step_(Vector(size_)) {
  std::vector<Number> q, p;
  for (int i = 0; i < system.n; ++i)
    q.emplace_back(tape_, i), p.emplace_back(tape_, system.n + i);
  tape_.finish(system(q, p).entry());
  for (const auto* x : {&system.q, &system.p})
    start_.insert(start_.end(), x->begin(), x->end());
  for (const auto* x : {&system.q_scale, &system.p_scale})
    scale_.insert(scale_.end(), x->begin(), x->end());
  for (const double unit : system.unit)
    reach_.push_back(static_cast<Real>(system.reach) * unit);
  span_ = static_cast<Real>(system.t_end) - static_cast<Real>(system.t);
  carry_.resize(size_);
  z_double_.resize(size_), slope_double_.resize(size_);
}

void Reference::field(const Vector& z, Vector& slope) {
  const int n = size_ / 2;
  if (in_double_) {
    std::copy(z.begin(), z.end(), z_double_.begin());
    tape_.gradient(z_double_.data(), slope_double_.data(), value_double_, adjoint_double_);
    std::copy(slope_double_.begin(), slope_double_.end(), slope.begin());
  } else {
    tape_.gradient(z.data(), slope.data(), value_, adjoint_);
  }
  std::swap_ranges(slope.begin(), slope.begin() + n, slope.begin() + n);
  for (int i = n; i < size_; ++i)
    slope[i] = -slope[i];
}

Real Reference::error(const Vector& z, Real tolerance, const Orbit& orbit) const {
  Real worst = 0;
  for (int i = 0; i < size_; ++i) {
    const Real allowed =
        tolerance * std::max(orbit.high[i] - orbit.low[i], scale_[i]) + 2 * epsilon * std::abs(z[i]);
    const Real increment = step_.increment()[i];
    const Real ratio = std::abs(increment - step_.coarser()[i]) / allowed;
    if (!std::isfinite(increment) || std::isnan(ratio)) return std::numeric_limits<Real>::infinity();
    worst = std::max(worst, ratio);
  }
  return worst;
}

// A step after which no coordinate has gone further than it may.
Real Reference::longest(const Orbit& orbit) const {
  Real h = span_;
  for (std::size_t i = 0; i < reach_.size(); ++i)
    if (orbit.slope[i] != 0) h = std::min(h, reach_[i] / std::abs(orbit.slope[i]));
  return h;
}

void Reference::begin(Orbit& orbit, const Vector& start) {
  orbit.end = orbit.low = orbit.high = start;
  orbit.slope.resize(size_);
  std::fill(carry_.begin(), carry_.end(), Real(0));
  field(orbit.end, orbit.slope);
}

// Adds the increment, with what rounding has lost so far.
void Reference::go_on(Orbit& orbit, Real h) {
  for (int i = 0; i < size_; ++i) {
    const Real add = step_.increment()[i] + carry_[i], sum = orbit.end[i] + add;
    carry_[i] = add - (sum - orbit.end[i]);
    orbit.end[i] = sum;
    orbit.low[i] = std::min(orbit.low[i], sum);
    orbit.high[i] = std::max(orbit.high[i], sum);
  }
  field(orbit.end, orbit.slope);
  orbit.steps.push_back(h);
}

Orbit Reference::run(Real tolerance, double most) {
  in_double_ = false;
  Orbit orbit;
  begin(orbit, start_);
  const double of_step = static_cast<double>(tape_.size() + size_) * rows * (rows + 1);
  Real h = span_ / 100, done = 0;
  for (int i = 0; i < size_; ++i)  // no entry moves by more than a tenth of its scale at first
    if (orbit.slope[i] != 0) h = std::min(h, scale_[i] / (10 * std::abs(orbit.slope[i])));
  while (done < span_) {
    if (orbit.work > most) return orbit.ending = Ending::too_long, orbit;
    h = std::min(h, longest(orbit));
    const bool last = done + h >= span_;
    const Real length = last ? span_ - done : h;
    step_.find([this](const Vector& z, Vector& slope) { field(z, slope); }, orbit.end, orbit.slope, length);
    orbit.work += of_step;
    const Real ratio = error(orbit.end, tolerance, orbit);
    const Real factor =
        std::isfinite(ratio) ? 0.85L * std::pow(std::max(ratio, Real(1e-12L)), -1.0L / (2 * rows - 1)) : 0.1L;
    if (ratio <= 1) {
      go_on(orbit, length);
      done = last ? span_ : done + length;
      if (!last || factor < 1) h = length * std::min(factor, Real(2));
    } else {
      h = length * std::max(factor, Real(0.1));
    }
    if (h < 1e-17L * span_ || !std::isfinite(h)) return orbit.ending = Ending::singular, orbit;
  }
  return orbit;
}

Orbit Reference::repeat(const Vector& start, const Vector& steps, bool in_double) {
  in_double_ = in_double;
  Orbit orbit;
  begin(orbit, start);
  for (const Real h : steps) {
    step_.find([this](const Vector& z, Vector& slope) { field(z, slope); }, orbit.end, orbit.slope, h);
    go_on(orbit, h);
  }
  for (const Real x : orbit.end)
    if (!std::isfinite(x)) orbit.ending = Ending::singular;
  return orbit;
}

}  // namespace hostile
