#include "common/frame.hpp"
#include "common/power_law.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "common/rules/bregman_runge_kutta.hpp"

// f along the exact Bregman dynamics, compared with the bound from its Lyapunov function:
//   E(t) = |x* - x - t^-p r|^2 / 2 + C t^p (f(x) - f*)
// decreases along solutions of a convex problem (Wibisono, Wilson and Jordan 2016, Theorem 1.1), hence
//   f(x(t)) - f* <= E(t_0) / (C t^p).
// The reference is Dormand-Prince 5(4) with tolerance 1e-11 in fictive time, Direct approach.
//
// The bound does not determine the actual rate. For f homogeneous of degree k about x*, the substitution
// x - x* = t^(-a) xi(log t) with a = p / (k - 2) makes the system autonomous:
//   xi'' + (p (k - 4) / (k - 2)) xi' - a (p - a) xi + C p^2 grad f(xi) = 0.
// It is damped for k > 4, so that f falls as t^(-p k / (k - 2)), and conservative for k = 4, so that f falls
// as t^(-2p); this is the case of our quartic. It is driven for k < 4, where the energy of the oscillation
// gives t^(-3 p k / (k + 2)).

namespace {

using namespace experiment;

double lyapunov(const avi::BregmanFamily& family, const CorrelatedQuartic& f, const avi::VectorX& q,
                const avi::VectorX& r, double t) {
  const avi::VectorX distance = f.minimiser() - q - std::pow(t, -family.p) * r;
  return 0.5 * avi::dot(distance, distance) + family.C * std::pow(t, family.p) * f.value(q);
}

}  // namespace

void experiment::conduct(Frame& frame) {
  Table& table = frame.table({"p", "t_end", "value", "bound", "largest_ratio", "largest_rise_of_E",
                              "fitted_rate", "gradient_evaluations", "outcome"});
  table.note("largest_ratio", "of f - f* to its bound E(t_0) / (C t^p), over the run");
  table.note("fitted_rate", "exponent of t of the upper envelope of f, over the last decade of f's fall");
  Table& curves = frame.table("curves", {"p", "t", "value", "most", "bound", "E"});
  const CorrelatedQuartic f;
  for (double p : {2.0, 4.0, 6.0, 10.0}) {
    const auto family = avi::BregmanFamily::direct(p);
    const avi::BregmanStart from;
    avi::Iterate first{.x = f.start(), .gradient = avi::VectorX::Zero(f.size())};
    avi::Counted<CorrelatedQuartic> objective(f, f.size());
    first.evaluate(objective);
    BregmanRungeKuttaState<avi::DormandPrince> state(first, family, from, 1e-6);
    const avi::StepControl control{.rtol = 1e-11, .atol = 1e-11};
    const Eigen::Index n = f.size();
    const double start_energy = lyapunov(family, f, state.z.head(n), state.z.segment(n, n), from.t);
    const double floor = frame.quick ? 1e-2 : 1e-8;
    double energy = start_energy, rise = 0.0, ratio = 0.0, next = 1.0, most = 0.0, most_at = 1.0;
    std::vector<double> times, envelope;  // largest f in each interval in which t grows by 1 %
    const auto field = [&](const avi::VectorX& z, avi::VectorX& dz) {
      state.field.evaluate(objective, z, dz);
    };
    avi::Outcome outcome = avi::Outcome::step_limit;
    double value = first.value;
    for (long k = 0; k < 400'000 && outcome == avi::Outcome::step_limit; ++k) {
      field(state.z, state.stages.k[0]);
      if (avi::controlled_step(state.stages, field, state.z, state.h, control) == 0.0) {
        outcome = avi::Outcome::not_converged;
        break;
      }
      state.z.swap(state.stages.end);
      const double t = state.z[2 * n];
      value = f.value(state.z.head(n));
      const double now = lyapunov(family, f, state.z.head(n), state.z.segment(n, n), t);
      rise = std::max(rise, (now - energy) / start_energy);
      energy = now;
      const double bound = start_energy / (family.C * std::pow(t, p));
      ratio = std::max(ratio, value / bound);
      if (value > most) most = value, most_at = t;
      if (t >= next) {
        curves.row(p, t, value, most, bound, now);
        times.push_back(most_at);
        envelope.push_back(most);
        next = t * 1.01;
        most = 0.0;
        if (envelope.back() < floor) outcome = avi::Outcome::ok;
      }
    }
    // The part of the envelope within a factor of 1e4 of its end.
    const auto fit = power_law(times, envelope, [&](double, double y) { return y < 1e4 * envelope.back(); });
    const double t = state.z[2 * n];
    table.row(p, t, value, start_energy / (family.C * std::pow(t, p)), ratio, rise, fit.slope,
              objective.gradients, avi::name(outcome));
  }
}
