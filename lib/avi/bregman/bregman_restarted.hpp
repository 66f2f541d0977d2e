#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/run_updates.hpp"
#include "avi/optim/sweep.hpp"

#include <algorithm>
#include <cmath>

/// @file
/// Restarted Bregman dynamics with the clock p/t; the step follows from curvatures that cost no evaluations.

namespace avi {

/// Discretised Bregman dynamics with friction (P + 1)/t in Nesterov's form, with restarts and an automatic
/// step. \f[ x_{k+1} = y_k - g_k / L, \qquad y_{k+1} = x_{k+1} + \frac{k}{k + P + 1} (x_{k+1} - x_k), \qquad
/// g_k = \nabla f(y_k), \f] where k counts from the last restart. The dynamics restarts, with t back at t_0,
/// where \f$g_k \cdot (x_{k+1} - x_k) > 0\f$ (O'Donoghue and Candes 2015).
///
/// The step is 1/L with L = max(0.7 L, L_s, L_g), which costs no evaluations. \f$L_s = |\Delta g_k| / |\Delta
/// y_k|\f$ is the curvature along the last displacement, most of which comes from momentum. \f[ L_g =
/// \frac{|\Delta g_k - c\, \Delta g_{k-1}|}{|\Delta y_k - c\, \Delta y_{k-1}|} \f] is the curvature along the
/// newest gradient: c is the regression coefficient of \f$\Delta y_k + g_{k-1}/L\f$ on \f$\Delta y_{k-1}\f$,
/// so that the denominator is that part of the displacement which the gradient caused. If f rises above its
/// value at the last restart, L is doubled and the run goes back to that point.
///
/// The iterate is y, where the gradient is evaluated: one evaluation per iteration.
struct BregmanRestarted {
  double P = 2.0;  ///< Order of the dynamics in its own time, positive; P = 2 gives Nesterov's k/(k + 3).

  /// The state of a run.
  struct State {
    VectorX x;             ///< x_k.
    VectorX before;        ///< y_{k-1}.
    VectorX gradient;      ///< g_{k-1}.
    VectorX displacement;  ///< y_{k-1} - y_{k-2}.
    VectorX change;        ///< g_{k-1} - g_{k-2}.
    VectorX anchor;        ///< y at the last restart.
    double anchor_value;   ///< f at the anchor.
    double L;              ///< Estimated curvature, the inverse of the step.
    double last_L;         ///< L in the last update.
    double k = 0.0;        ///< Updates since the last restart.
    long updates = 0;      ///< Updates since the run last went back to its anchor.
  };

  /// The state for a new run. @throws std::invalid_argument for P out of range.
  State start(const Iterate& first) const {
    require_positive("Order P", P);
    const VectorX zero = VectorX::Zero(first.x.size());
    const double x = largest_entry(first.x), g = largest_entry(first.gradient);
    const double square = dot(first.gradient, first.gradient);
    double length = x > 0.0 ? 0.01 * x / g : 0.01 * std::abs(first.value) / square;
    if (!(length > 0.0) || !std::isfinite(length)) length = 1.0;
    return {.x = first.x,
            .before = zero,
            .gradient = zero,
            .displacement = zero,
            .change = zero,
            .anchor = first.x,
            .anchor_value = first.value,
            .L = 1.0 / length,
            .last_L = 1.0 / length};
  }

  /// Moves y once, with the gradient already evaluated in `now`.
  template <class F>
  Outcome update(State& state, Iterate& now, F& f) const {
    if (!(now.value <= state.anchor_value + 1e-10 * std::abs(state.anchor_value))) {
      state.L *= 2.0;
      now.x = state.anchor;
      state.x = state.anchor;
      now.evaluate(f);
      state.k = 0.0;
      state.updates = 0;
    }
    if (state.updates > 0) measure(state, now);
    state.last_L = state.L;
    const double length = 1.0 / state.L;
    const Eigen::Index n = now.x.size();
    const double uphill =
        sweep<1>(n, [=, x = state.x.data(), y = now.x.data(), g = now.gradient.data()](auto e, auto& sum) {
          const auto slope = e(g);
          sum[0] += slope * (e(y) - length * slope - e(x));
        })[0];
    if (uphill > 0.0) {
      state.k = 0.0;
      if (now.value < state.anchor_value) state.anchor = now.x, state.anchor_value = now.value;
    } else {
      state.k += 1.0;
    }
    const double momentum = state.k / (state.k + P + 1.0);
    state.gradient = now.gradient;
    state.before = now.x;
    sweep<0>(n, [=, x = state.x.data(), y = now.x.data(), g = now.gradient.data()](auto e, auto&) {
      const auto next = e(y) - length * e(g), ahead = next + momentum * (next - e(x));
      e.set(x, next);
      e.set(y, ahead);
    });
    ++state.updates;
    now.evaluated = false;
    return Outcome::ok;
  }

 private:
  /// Computes the new L, and stores the displacement and the change of gradient for the next update.
  static void measure(State& state, const Iterate& now) {
    const Eigen::Index n = now.x.size();
    const double length = 1.0 / state.last_L;
    const auto sums =
        sweep<4>(n, [=, y = now.x.data(), g = now.gradient.data(), y0 = state.before.data(),
                     g0 = state.gradient.data(), dy0 = state.displacement.data()](auto e, auto& sum) {
          const auto dy = e(y) - e(y0), dg = e(g) - e(g0), old = e(dy0);
          sum[0] += dy * dy;
          sum[1] += dg * dg;
          sum[2] += (dy + length * e(g0)) * old;
          sum[3] += old * old;
        });
    const double c = sums[2] / sums[3];  // NaN if y did not move; `own` is then not used
    const auto own = sweep<2>(n, [=, y = now.x.data(), g = now.gradient.data(), y0 = state.before.data(),
                                  g0 = state.gradient.data(), dy0 = state.displacement.data(),
                                  dg0 = state.change.data()](auto e, auto& sum) {
      const auto dy = e(y) - e(y0), dg = e(g) - e(g0), s = dy - c * e(dy0), t = dg - c * e(dg0);
      sum[0] += s * s;
      sum[1] += t * t;
      e.set(dy0, dy);
      e.set(dg0, dg);
    });
    double L = 0.7 * state.L;
    if (sums[0] > 0.0) L = std::max(L, root_of_quotient(sums[1], sums[0]));
    if (state.updates > 1 && own[0] > 0.0) L = std::max(L, root_of_quotient(own[1], own[0]));
    if (std::isfinite(L) && L > 0.0) state.L = L;
  }

  /// sqrt(a / b), also where a / b overflows or underflows, as in unusual units of x.
  static double root_of_quotient(double a, double b) {
    const double quotient = a / b;
    return std::isnormal(quotient) ? std::sqrt(quotient) : std::sqrt(a) / std::sqrt(b);
  }
};

}  // namespace avi
