#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/core/outcome.hpp"
#include "avi/core/power.hpp"
#include "avi/optim/objective.hpp"

/// @file
/// The Type II Hamiltonian Taylor variational integrator of order r = 0 for Bregman dynamics.

namespace avi {

/// How physical time advances during one fictive step.
enum class Clock {
  euler,  ///< t += h monitor(t): what the integrator's own equation gives, as in the paper.
  exact   ///< t^s += h: the exact solution of the same equation.
};

/// The explicit update of Section 4.4 of the paper in momentum form. With \f$R = r\, t^{-p}\f$ and
/// \f$\eta = P h\, t^{-s}\f$, \f[ R' = R - \eta\, C t^p\, \nabla f(q), \quad q_+ = q + \eta R', \quad
/// R_+ = R' (t/t_+)^p, \f] where \f$t_+ = t\,(1 + h\, t^{-s}/s)\f$ by Euler's clock. These are the iterates
/// of the printed form to round-off with half its range of exponents: a heavy ball
/// of step \f$\eta^2 C t^p\f$ whose displacement \f$q_+ - q = \eta R'\f$ keeps the part \f$(t/t_+)^{p+s}\f$:
/// p from R, s from \f$\eta_+/\eta\f$. Direct with p = 2 has thus the friction 3/t of Nesterov's method.
/// \f$r^t\f$ is not evolved, as nothing else depends on it.
struct BregmanHtvi {
  BregmanFamily family;        ///< p, p_ring and C.
  double h = 1e-3;             ///< Fictive step, finite and positive.
  BregmanStart from{};         ///< Time and momentum of the first iterate.
  Clock clock = Clock::euler;  ///< The paper's is Euler's.

  /// What a run carries from step to step.
  struct State {
    VectorX momentum;  ///< R.
    double t = 1.0;    ///< Physical time.
    double power;      ///< t^p.
    double eta;        ///< Of the coming step.
  };

  /// State of one run. @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    validate(family, from, h);
    const double power = accurate_power(from.t, family.p);
    return {.momentum = VectorX::Constant(first.x.size(), from.momentum / power),
            .t = from.t,
            .power = power,
            .eta = eta(from.t)};
  }

  /// Advances by the fictive step with the gradient at hand.
  template <class F>
  Outcome update(State& state, Iterate& now, F&) const {
    const double step = state.eta * family.C * state.power;
    const double t_next =
        clock == Clock::euler ? state.t + state.t * (state.eta / family.p) : family.exact_clock(state.t, h);
    // Not by plain repeated multiplication: the last bit decides some published counts.
    const double power_next = accurate_power(t_next, family.p);
    const double damping = state.power / power_next;
    const Eigen::Index n = now.x.size();
    double* momentum = state.momentum.data();
    double* x = now.x.data();
    const double* gradient = now.gradient.data();
    for (Eigen::Index i = 0; i < n; ++i) {
      const double kicked = momentum[i] - step * gradient[i];
      x[i] += state.eta * kicked;
      momentum[i] = damping * kicked;
    }
    // The clock runs ahead of the gradient: these powers depend on nothing that the objective computes, so
    // that the processor works on both at once.
    state.t = t_next;
    state.power = power_next;
    state.eta = eta(t_next);
    now.evaluated = false;
    return Outcome::ok;
  }

 private:
  /// P h t^(-s); a division where a general power is not needed.
  [[nodiscard]] double eta(double t) const {
    return family.order() * h * (family.is_direct() ? 1.0 / t : avi::power(t, -family.s()));
  }
};

}  // namespace avi
