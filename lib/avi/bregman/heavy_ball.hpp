#pragma once
#include "avi/bregman/family.hpp"
#include "avi/bregman/htvi.hpp"
#include "avi/core/outcome.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

/// @file
/// The Type II HTVI of order r = 0 for Bregman dynamics with log t as its clock: the form for extreme orders.

namespace avi {

/// The update of bregman/htvi.hpp in the displacement v = eta R, with L = log t, A = log(t+/t) and
/// a = P h sqrt(C) t^(p/2 - s):
///
///   v' = v - a^2 grad f(q),   q+ = q + v',   v+ = v' (t/t+)^(p+s),   L+ = L + A,
///
/// A = log1p(h t^(-s) / s) by Euler's clock, log1p(h t^(-s)) / s by the exact one. A heavy ball whose two
/// coefficients are all that is computed from t, so that a run goes on as long as the step a^2 = eta^2 C t^p
/// itself is a number: t^(p-2s) below 1.8e308, where bregman/htvi.hpp needs t^p and the printed form
/// t^(2p-s). For p <= 2s (Direct with p <= 2) it never ends. Beyond, the outcome is non_finite and the
/// iterate is the last good one.
///
/// The iterates are those of the other two forms to round-off, not to the last bit: published counts are made
/// with bregman/htvi.hpp.
struct BregmanHeavyBall {
  BregmanFamily family;
  double h = 1e-3;  ///< Fictive step, finite and positive.
  BregmanStart from{};
  Clock clock = Clock::euler;

  struct State {
    VectorX displacement;  ///< v.
    double log_t = 0.0;    ///< L.
  };

  /// @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    family.validate();
    from.validate();
    require_positive("Step size h", h);
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
