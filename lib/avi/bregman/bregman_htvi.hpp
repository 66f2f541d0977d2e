#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/core/outcome.hpp"
#include "avi/core/power.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

/// @file
/// The Type II Hamiltonian Taylor variational integrator of order r = 0 for Bregman dynamics, in two forms:
/// that of the published counts, and one for extreme orders.

namespace avi {

/// How physical time advances during one fictive step.
enum class Clock {
  euler,  ///< t += h monitor(t), from the integrator's own equation, as in the paper.
  exact   ///< t^s += h, the exact solution of that equation.
};

/// The explicit update of Section 4.4 of the paper, in momentum form. With \f$R = r\, t^{-p}\f$ and \f$\eta =
/// P h\, t^{-s}\f$, \f[ R' = R - \eta\, C t^p\, \nabla f(q), \quad q_+ = q + \eta R', \quad R_+ = R'
/// (t/t_+)^p, \f] where \f$t_+ = t\,(1 + h\, t^{-s}/s)\f$ for Euler's clock. The iterates equal those of the
/// printed form to round-off, but need only half its range of exponents. The method is a heavy ball of step
/// \f$\eta^2 C t^p\f$. From one step to the next, the displacement \f$q_+ - q = \eta R'\f$ is multiplied by
/// \f$(t/t_+)^{p+s}\f$, of which p comes from R and s from \f$\eta_+/\eta\f$. Direct with p = 2 thus has the
/// friction 3/t of Nesterov's method. \f$r^t\f$ is not evolved, because nothing else depends on it.
struct BregmanHtvi {
  BregmanFamily family;        ///< p, p_ring and C.
  double h = 1e-3;             ///< Fictive step, finite and positive.
  BregmanStart from{};         ///< Initial time and momentum.
  Clock clock = Clock::euler;  ///< The paper uses Euler's clock.

  /// The state of a run.
  struct State {
    VectorX momentum;  ///< R.
    double t;          ///< Physical time.
    double power;      ///< t^p.
    double eta;        ///< eta for the next step.
  };

  /// The state for a new run. @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    validate(family, from, h);
    const double power = accurate_power(from.t, family.p);
    return {.momentum = VectorX::Constant(first.x.size(), from.momentum / power),
            .t = from.t,
            .power = power,
            .eta = eta(from.t)};
  }

  /// One fictive step, with the gradient already evaluated in `now`.
  template <class F>
  Outcome update(State& state, Iterate& now, F&) const {
    const double step = state.eta * family.C * state.power;
    const double t_next =
        clock == Clock::euler ? state.t + state.t * (state.eta / family.p) : family.exact_clock(state.t, h);
    // Repeated multiplication would not be accurate enough: the last bit decides some published counts.
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
    // The next powers of t are computed already here. They do not depend on the objective, so the processor
    // can work on both at once.
    state.t = t_next;
    state.power = power_next;
    state.eta = eta(t_next);
    now.evaluated = false;
    return Outcome::ok;
  }

 private:
  /// P h t^(-s), by a division if s = 1.
  [[nodiscard]] double eta(double t) const {
    return family.order() * h * (family.is_direct() ? 1.0 / t : avi::power(t, -family.s()));
  }
};

/// The update of BregmanHtvi in terms of the displacement \f$v = \eta R\f$. With \f$L = \log t\f$, \f$A =
/// \log(t_+/t)\f$ and \f$a = P h \sqrt{C}\, t^{p/2-s}\f$, \f[ v' = v - a^2 \nabla f(q), \quad q_+ = q + v',
/// \quad v_+ = v' (t/t_+)^{p+s}, \quad L_+ = L + A. \f] A = log1p(h t^(-s) / s) for Euler's clock, log1p(h
/// t^(-s)) / s for the exact one. In this form of a heavy ball, only its two coefficients are computed from
/// t. A run can therefore continue as long as the step \f$a^2 = \eta^2 C t^p\f$ itself is finite: for
/// \f$t^{p-2s}\f$ below 1.8e308, whereas BregmanHtvi needs \f$t^p\f$ and the printed form \f$t^{2p-s}\f$ to
/// be so. For p <= 2s (Direct with p <= 2) this never ends a run. Beyond the limit the outcome is non_finite,
/// and the iterate is the last valid one.
///
/// The iterates equal those of the other two forms to round-off, but not to the last bit. Published counts
/// are reproduced with BregmanHtvi.
struct BregmanHeavyBall {
  BregmanFamily family;        ///< p, p_ring and C.
  double h = 1e-3;             ///< Fictive step, finite and positive.
  BregmanStart from{};         ///< Initial time and momentum.
  Clock clock = Clock::euler;  ///< The paper uses Euler's clock.

  /// The state of a run.
  struct State {
    VectorX displacement;  ///< v.
    double log_t;          ///< L.
  };

  /// The state for a new run. @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    validate(family, from, h);
    const double log_t = std::log(from.t);
    const double v = family.order() * h * from.momentum * std::exp(-(family.p + family.s()) * log_t);
    return {.displacement = VectorX::Constant(first.x.size(), v), .log_t = log_t};
  }

  /// The step a^2 at time t = exp(log_t); infinite where it overflows.
  [[nodiscard]] double step(double log_t) const {
    // The root is finite wherever the square is.
    const double a =
        family.order() * h * std::sqrt(family.C) * std::exp((0.5 * family.p - family.s()) * log_t);
    return a * a;
  }

  /// A = log(t+/t) at time t = exp(log_t).
  [[nodiscard]] double advance(double log_t) const {
    const double fictive = h * std::exp(-family.s() * log_t), s = family.s();
    return clock == Clock::euler ? std::log1p(fictive / s) : std::log1p(fictive) / s;
  }

  /// One fictive step, with the gradient already evaluated in `now`; Outcome::non_finite if the step a^2
  /// overflows.
  template <class F>
  Outcome update(State& state, Iterate& now, F&) const {
    const double length = step(state.log_t), ahead = advance(state.log_t);
    if (!std::isfinite(length)) return Outcome::non_finite;
    const double damping = std::exp(-(family.p + family.s()) * ahead);
    for (Eigen::Index i = 0; i < now.x.size(); ++i) {
      const double kicked = state.displacement[i] - length * now.gradient[i];
      now.x[i] += kicked;
      state.displacement[i] = damping * kicked;
    }
    state.log_t += ahead;
    now.evaluated = false;
    return Outcome::ok;
  }
};

}  // namespace avi
