#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/core/outcome.hpp"
#include "avi/core/power.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

/// @file
/// The Type II Hamiltonian Taylor variational integrator of order r = 0 for Bregman dynamics: the form of the
/// published counts, and that for extreme orders.

namespace avi {

/// How physical time advances during one fictive step.
enum class Clock {
  euler,  ///< t += h monitor(t): what the integrator's own equation gives, as in the paper.
  exact   ///< t^s += h: the exact solution of the same equation.
};

/// The explicit update of Section 4.4 of the paper in momentum form. With \f$R = r\, t^{-p}\f$ and
/// \f$\eta = P h\, t^{-s}\f$, \f[ R' = R - \eta\, C t^p\, \nabla f(q), \quad q_+ = q + \eta R', \quad
/// R_+ = R' (t/t_+)^p, \f] where \f$t_+ = t\,(1 + h\, t^{-s}/s)\f$ by Euler's clock. These are the iterates
/// of the printed form to round-off with half its range of exponents: a heavy ball of step
/// \f$\eta^2 C t^p\f$ whose displacement \f$q_+ - q = \eta R'\f$ keeps the part \f$(t/t_+)^{p+s}\f$: p from
/// R, s from \f$\eta_+/\eta\f$. Direct with p = 2 has thus the friction 3/t of Nesterov's method. \f$r^t\f$
/// is not evolved, as nothing else depends on it.
struct BregmanHtvi {
  BregmanFamily family;        ///< p, p_ring and C.
  double h = 1e-3;             ///< Fictive step, finite and positive.
  BregmanStart from{};         ///< Time and momentum of the first iterate.
  Clock clock = Clock::euler;  ///< The paper's is Euler's.

  /// The state of a run.
  struct State {
    VectorX momentum;  ///< R.
    double t;          ///< Physical time.
    double power;      ///< t^p.
    double eta;        ///< eta of the coming step.
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

/// The update of BregmanHtvi in the displacement \f$v = \eta R\f$, with \f$L = \log t\f$,
/// \f$A = \log(t_+/t)\f$ and \f$a = P h \sqrt{C}\, t^{p/2-s}\f$. \f[ v' = v - a^2 \nabla f(q), \quad
/// q_+ = q + v', \quad v_+ = v' (t/t_+)^{p+s}, \quad L_+ = L + A, \f]
/// A = log1p(h t^(-s) / s) by Euler's clock, log1p(h t^(-s)) / s by the exact one. A heavy ball whose two
/// coefficients are all that is computed from t, so that a run goes on as long as the step
/// \f$a^2 = \eta^2 C t^p\f$ itself is a number: \f$t^{p-2s}\f$ below 1.8e308, where BregmanHtvi
/// needs \f$t^p\f$ and the printed form \f$t^{2p-s}\f$. For p <= 2s (Direct with p <= 2) it never ends.
/// Beyond, the outcome is non_finite and the iterate is the last good one.
///
/// The iterates are those of the other two forms to round-off, not to the last bit: published counts are made
/// with BregmanHtvi.
struct BregmanHeavyBall {
  BregmanFamily family;        ///< p, p_ring and C.
  double h = 1e-3;             ///< Fictive step, finite and positive.
  BregmanStart from{};         ///< Time and momentum of the first iterate.
  Clock clock = Clock::euler;  ///< The paper's is Euler's.

  /// The state of a run.
  struct State {
    VectorX displacement;  ///< v.
    double log_t;          ///< L.
  };

  /// State of one run. @throws std::invalid_argument for a parameter out of range.
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

  /// Advances by the fictive step with the gradient at hand; Outcome::non_finite where the step overflows.
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
