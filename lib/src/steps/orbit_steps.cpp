#include "src/steps/orbit_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace avi::detail {

/// Makes a step from a state to a time before which H does not switch, or the whole step h if that does not
/// come so far. Its size is found by the secant method, from below and above.
StepReport OrbitSteps::stop_at_switch(const State<dynamic>& from, double h, double time, State<dynamic>& z) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double sense = std::copysign(1.0, h), most = std::abs(h), way = std::abs(time - from.t);
  const double near = 4.0 * epsilon * std::max(std::abs(time), way);
  StepReport report{.evaluations = 0};
  double low = 0.0, high = 2.0 * most;  // bounds of that size
  const double due = way > 4.0 * std::abs(ahead_) ? ahead_ : 0.0;
  double size = std::min((way - sense * due) / rate_, most), last = 0.0, last_late = way;
  for (int k = 0; k < 60; ++k) {
    z = from;
    const StepReport step = whole_step(z, sense * size);
    report.outcome = step.outcome;
    report.evaluations += step.evaluations;
    size_ = sense * size;
    double next = 0.5 * (low + size);
    if (step.ok()) {
      const double late = sense * (time - z.t - due);
      if (!fixed_) rate_ = std::abs(z.t - from.t) / size;
      if (late > near && size == most) return report;
      if (std::abs(late) <= near || (high - low <= 4.0 * epsilon * size && std::abs(late) <= 100.0 * near)) {
        ahead_ -= fixed_ ? due : due + sense * late;
        z.t = z.q[n_ - 1] = time;
        return report;
      }
      (late > 0.0 ? low : high) = size;
      next = size + late * (size - last) / (last_late - late);
      last = size, last_late = late;
    } else {
      high = size;
    }
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    size = std::min(next, most);
  }
  if (report.ok()) report.outcome = Outcome::not_converged;
  return report;
}

/// Makes a step that ends at the next switch, if there is one in it: a step over a switch could hardly be
/// solved.
StepReport OrbitSteps::step_to_switch(State<dynamic>& z, double h) {
  StepReport report{.evaluations = 0};
  const auto spend = [&](const StepReport& step) {
    report.outcome = step.outcome;
    report.evaluations += step.evaluations;
  };
  State<dynamic> from = z, to;
  // The last step ended at a switch, or at several, and this one begins behind them. Before them, H has no
  // meaning with the momentum of time from behind them, and a step with a monitor of the energy might be
  // solved there with g below 0. Until the next switch, the clock is ahead of the system by the difference.
  double behind = z.t;
  while (const auto here = switches_->at(behind, std::copysign(1.0, h))) {
    from.p[n_ - 1] += switches_->fall(from.q.data(), from.p.data(), *here);
    behind = here->after;
  }
  ahead_ -= behind - from.t;
  from.t = from.q[n_ - 1] = behind;
  if (!(rate_ > 0.0)) {
    to = from;
    spend(clone()->whole_step(to, 1e-6 * h));
    if (!report.ok()) return report;
    rate_ = std::abs((to.t - from.t) / (1e-6 * h));
  }
  auto ahead = switches_->next(from.t, from.t + h * rate_);
  if (!ahead) {
    to = from;
    size_ = h;
    spend(whole_step(to, h));
    ahead = switches_->next(from.t, report.ok() ? to.t : from.t + 2.0 * h * rate_);
    if (!ahead && report.ok()) {
      if (fixed_)
        ahead_ += h - (to.t - from.t);
      else
        rate_ = std::abs((to.t - from.t) / h);
    }
  }
  if (ahead) spend(stop_at_switch(from, h, ahead->before, to));
  if (report.ok()) z = to;
  return report;
}

/// Finds the first kink in the last step, between two states.
std::optional<Kinks::Crossing> OrbitSteps::first_kink(const State<dynamic>& from, const State<dynamic>& to) {
  inside_.resize(2 * n_);
  kinks_->look(0, from.q.data(), from.p.data(), n_);
  for (int k = 1; k < Kinks::parts; ++k) {
    double t = 0.0;
    roughly(static_cast<double>(k) / Kinks::parts, inside_, t);
    kinks_->look(k, inside_.data(), inside_.data() + n_, n_);
  }
  kinks_->look(Kinks::parts, to.q.data(), to.p.data(), n_);
  return kinks_->first([&](std::size_t i, double c) { return kink_at(i, c); });
}

/// Function i of the kinks at a part of the last step.
double OrbitSteps::kink_at(std::size_t i, double c) {
  double t = 0.0;
  roughly(c, inside_, t);
  return kinks_->at(i, inside_.data(), inside_.data() + n_, n_);
}

/// Makes a step that ends at the next kink, if there is one in it. Its size is found by the secant method,
/// which begins where the polynomial of the whole step has the kink. A step over a kink may not be solved:
/// then a shorter one is made.
StepReport OrbitSteps::step_to_kink(State<dynamic>& z, double h) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  StepReport report{.evaluations = 0};
  State<dynamic> to;
  const double ahead = ahead_;
  const auto go = [&](double size) {
    to = z, ahead_ = ahead;
    const StepReport step = step_inside(to, size);
    report.outcome = step.outcome;
    report.evaluations += step.evaluations;
    return step.ok();
  };
  for (int halves = 0; !go(std::ldexp(h, -halves)); ++halves)
    if (report.outcome != Outcome::not_converged || halves == 3) return report;
  at_kink_ = false;
  for (int kinks = 0; kinks < 8; ++kinks) {
    const auto kink = first_kink(z, to);
    if (!kink) break;
    const double whole = size_, most = std::abs(kink->at_low) + std::abs(kink->at_high);
    // A polynomial over a kink errs, so that the zero may be beside where that has it.
    constexpr double beside = 1.0 / Kinks::parts;
    double low = std::max(kink->low - beside, Kinks::soon), high = std::min(kink->high + beside, 1.0);
    double part = kink->place, slope = kink->slope, at = most;
    for (int k = 0; k < 60 && high - low > 4.0 * epsilon * high; ++k) {
      const double last = at, its_part = size_ / whole;
      if (!go(part * whole)) return report;
      at = kinks_->at(kink->index, to.q.data(), to.p.data(), n_);
      if (k > 0) slope = (at - last) / (part - its_part);
      (at * kink->at_low > 0.0 ? low : high) = part;
      // It is zero, or as small as rounding lets it become.
      if (std::abs(at) <= 1e-14 * most) break;
      if (std::abs(at) <= 1e-10 * most && !(std::abs(at) < 0.1 * std::abs(last))) break;
      part -= at / slope;
      if (!(part > low && part < high)) part = 0.5 * (low + high);
    }
    if (!(std::abs(at) <= 1e-9 * most)) {
      // Either only the polynomial has this zero, or the whole step is so long that it goes through a wall
      // off which shorter ones turn back: then half of it is made.
      if (!go(whole)) return report;
      const bool through = kinks_->at(kink->index, to.q.data(), to.p.data(), n_) * kink->at_low < 0.0;
      if (!through) break;
      if (!go(0.5 * whole)) return report;
      at_kink_ = false;
      continue;
    }
    at_kink_ = true;
  }
  z = to;
  return report;
}

}  // namespace avi::detail
