#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

/// @file
/// Nesterov's accelerated gradient method (Nesterov 1983).

namespace avi {

/// x_k = y_{k-1} - h grad f(y_{k-1}),  y_k = x_k + k/(k+3) (x_k - x_{k-1}),  y_0 = x_0.
///
/// The paper's equation (NesterovUpdate) has (k-1)/(k+2): the same sequence counted from k = 1 instead of
/// from 0. It is k/(k+3) that gives the published counts. The gradient is taken at y, the stopping test at x:
/// two gradients an iteration, of which the method itself needs one.
struct Nag {
  double h = 1e-3;  ///< Step size, finite and positive.

  struct State {
    VectorX y;
    VectorX gradient;
    VectorX previous;
    long k = 0;
  };

  /// @throws std::invalid_argument for h out of range.
  State start(const Iterate& first) const {
    require_positive("Step size h", h);
    return {.y = first.x, .gradient = first.gradient, .previous = first.x};
  }

  template <class F>
  Outcome update(State& state, Iterate& now, F& f) const {
    if (state.k > 0) f(state.y, state.gradient);
    state.previous.swap(now.x);
    now.x = state.y - h * state.gradient;
    const double k = static_cast<double>(++state.k);
    state.y = now.x + (k / (k + 3.0)) * (now.x - state.previous);
    now.evaluated = false;
    return Outcome::ok;
  }
};

}  // namespace avi
