#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/bregman/bregman_htvi.hpp"
#include "avi/core/outcome.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

/// @file
/// The Type II HTVI of order r = 0 for Bregman dynamics with log t as its clock: the form for extreme orders.

namespace avi {

/// The update of bregman/bregman_htvi.hpp in the displacement \f$v = \eta R\f$, with \f$L = \log t\f$,
/// \f$A = \log(t_+/t)\f$ and \f$a = P h \sqrt{C}\, t^{p/2-s}\f$. \f[ v' = v - a^2 \nabla f(q), \quad
/// q_+ = q + v', \quad v_+ = v' (t/t_+)^{p+s}, \quad L_+ = L + A, \f]
/// A = log1p(h t^(-s) / s) by Euler's clock, log1p(h t^(-s)) / s by the exact one. A heavy ball whose two
/// coefficients are all that is computed from t, so that a run goes on as long as the step
/// \f$a^2 = \eta^2 C t^p\f$ itself is a number: \f$t^{p-2s}\f$ below 1.8e308, where bregman/bregman_htvi.hpp
/// needs \f$t^p\f$ and the printed form \f$t^{2p-s}\f$. For p <= 2s (Direct with p <= 2) it never ends.
/// Beyond, the outcome is non_finite and the iterate is the last good one.
///
/// The iterates are those of the other two forms to round-off, not to the last bit: published counts are made
/// with bregman/bregman_htvi.hpp.
struct BregmanHeavyBall {
  BregmanFamily family;        ///< p, p_ring and C.
  double h = 1e-3;             ///< Fictive step, finite and positive.
  BregmanStart from{};         ///< Time and momentum of the first iterate.
  Clock clock = Clock::euler;  ///< The paper's is Euler's.

  /// What a run carries from step to step.
  struct State {
    VectorX displacement;  ///< v.
    double log_t = 0.0;    ///< L.
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
