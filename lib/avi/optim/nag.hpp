#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

/// @file
/// Nesterov's accelerated gradient method (Nesterov 1983).

namespace avi {

/// Gradient steps from a point extrapolated along the last displacement. \f[ x_k = y_{k-1} - h\, \nabla
/// f(y_{k-1}), \quad y_k = x_k + \frac{k}{k+3}\, (x_k - x_{k-1}), \quad y_0 = x_0. \f] The paper's equation
/// (4.1) has (k-1)/(k+2): the same sequence counted from k = 1 instead of from 0. It is k/(k+3) that gives
/// the published counts. The gradient is taken at y, the stopping test at x: two gradients an iteration; the
/// method alone needs one.
struct Nag {
  double h = 1e-3;  ///< Step size, finite and positive.

  /// What a run carries from step to step.
  struct State {
    VectorX y;         ///< y_k.
    VectorX gradient;  ///< Gradient at y_k.
    VectorX previous;  ///< x_{k-1}.
    long k = 0;        ///< Iterations made.
  };

  /// Checks the parameters and makes the state of one run.
  /// @throws std::invalid_argument for h out of range.
  State start(const Iterate& first) const {
    require_positive("Step size h", h);
    return {.y = first.x, .gradient = first.gradient, .previous = first.x};
  }

  /// Moves x once, with a gradient at y from the second iteration on.
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
