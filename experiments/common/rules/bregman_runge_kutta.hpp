#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/core/outcome.hpp"
#include "avi/integrators/runge_kutta.hpp"
#include "avi/optim/objective.hpp"

// Bregman dynamics with explicit Runge-Kutta methods: the paper's non-symplectic baselines (Section 4.5.4).

namespace experiment {

using avi::Outcome, avi::VectorX, avi::require_positive, avi::Iterate, avi::BregmanFamily, avi::BregmanStart,
    avi::validate, avi::StepControl, avi::Tableau, avi::EmbeddedTableau, avi::RungeKuttaStages,
    avi::controlled_step;

/// Hamilton's equations of \f$\bar H\f$ in fictive time for z = (q, r, t): \f$q' = kinetic(t)\, r\f$,
/// \f$r' = -potential(t)\, \nabla f(q)\f$, \f$t' = monitor(t)\f$.
struct BregmanField {
  BregmanFamily family;  ///< p, p_ring and C.
  VectorX q;             ///< Working memory: position at which the objective is evaluated.
  VectorX gradient;      ///< Working memory: the gradient there.

  /// The field, for a gradient that is already known.
  void operator()(const VectorX& z, const VectorX& gradient_at_q, VectorX& dz) const {
    const Eigen::Index n = q.size();
    const double t = z[2 * n];
    dz.head(n) = family.kinetic(t) * z.segment(n, n);
    dz.segment(n, n) = -family.potential(t) * gradient_at_q;
    dz[2 * n] = family.monitor(t);
  }

  /// The field, with the gradient evaluated from the objective f. @return the value of f
  double evaluate(auto& f, const VectorX& z, VectorX& dz) {
    q = z.head(q.size());
    const double value = f(q, gradient);
    (*this)(z, gradient, dz);
    return value;
  }
};

/// The initial z, from the first iterate.
inline VectorX bregman_point(const Iterate& first, const BregmanStart& from) {
  const Eigen::Index n = first.x.size();
  VectorX z(2 * n + 1);
  z << first.x, VectorX::Constant(n, from.momentum), from.t;
  return z;
}

/// The state of a run between two steps: z, its stages, and the step to try next.
template <Tableau T>
struct BregmanRungeKuttaState {
  VectorX z;                   ///< The current point (q, r, t).
  BregmanField field;          ///< The field, z' = field(z).
  RungeKuttaStages<T> stages;  ///< Stages of the step being taken.
  double h;                    ///< Next fictive step to try.

  /// The state at the first iterate.
  BregmanRungeKuttaState(const Iterate& first, const BregmanFamily& family, const BregmanStart& from,
                         double step)
      : z(bregman_point(first, from)), field{.family = family, .q = first.x, .gradient = first.gradient},
        stages(z.size()), h(step) {}

  /// Moves to the point in stages.end.
  void accept(Iterate& now) {
    z.swap(stages.end);
    now.x = z.head(now.x.size());
    now.evaluated = false;
  }
};

/// An explicit Runge-Kutta method with fixed fictive step h.
template <Tableau T>
struct BregmanRungeKutta {
  BregmanFamily family;  ///< p, p_ring and C.
  double h = 1e-3;       ///< Fictive step, finite and positive.
  BregmanStart from{};   ///< Initial time and momentum.

  using State = BregmanRungeKuttaState<T>;
  State start(const Iterate& first) const {
    validate(family, from, h);
    return {first, family, from, h};
  }

  /// One fictive step, with one gradient per stage except the first.
  Outcome update(State& state, Iterate& now, auto& f) const {
    state.field(state.z, now.gradient, state.stages.k[0]);
    state.stages.advance([&](const VectorX& z, VectorX& dz) { state.field.evaluate(f, z, dz); }, state.z, h);
    state.accept(now);
    return Outcome::ok;
  }
};

/// An embedded Runge-Kutta pair with step-size control from its error estimate. An iteration is an accepted
/// step. Where the last stage is evaluated at the new point, its gradient is reused for the stopping test and
/// the next step.
template <EmbeddedTableau T>
struct BregmanEmbedded {
  BregmanFamily family;      ///< p, p_ring and C.
  StepControl control{};     ///< Tolerances and factors.
  double first_step = 1e-6;  ///< First fictive step, finite and positive.
  BregmanStart from{};       ///< Initial time and momentum.

  using State = BregmanRungeKuttaState<T>;
  State start(const Iterate& first) const {
    family.validate();
    from.validate();
    control.validate();
    require_positive("First step", first_step);
    return {first, family, from, first_step};
  }

  /// Takes one accepted step; Outcome::not_converged if the limit on rejections is reached.
  Outcome update(State& state, Iterate& now, auto& f) const {
    double last_value = now.value;
    state.field(state.z, now.gradient, state.stages.k[0]);
    const double taken = controlled_step(
        state.stages, [&](const VectorX& z, VectorX& dz) { last_value = state.field.evaluate(f, z, dz); },
        state.z, state.h, control);
    if (taken == 0.0) return Outcome::not_converged;
    state.accept(now);
    if (now.x == state.field.q) {
      now.value = last_value;
      now.gradient = state.field.gradient;
      now.evaluated = true;
    }
    return Outcome::ok;
  }
};

}  // namespace experiment
