#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

/// @file
/// Trust region steepest descent: a trust region with the linear model (Nocedal and Wright 2006, Chapter 4).

namespace avi {

/// Step \f$s = -\Delta\, g/|g|\f$, the minimiser of the linear model \f$f + g\cdot s\f$ in the ball
/// \f$|s| \le \Delta\f$, and ratio = \f$(f(x) - f(x + s))/(\Delta |g|)\f$. The step is taken when ratio >
/// accept, and Delta grows by `grow` when ratio > expand; otherwise Delta shrinks by `shrink` and the step is
/// tried again.
///
/// An iteration is a step that was taken; each trial costs a function value, each iteration a gradient.
struct TrustRegion {
  double radius = 1.0;   ///< Delta at the start, positive.
  double accept = 0.5;   ///< In [0, 1).
  double expand = 0.75;  ///< At least accept.
  double shrink = 0.9;   ///< In (0, 1).
  double grow = 2.0;     ///< At least 1.
  int trials = 1000;     ///< Cap on trials in one iteration, at least 1; beyond it: not_converged.

  /// What a run carries from step to step.
  struct State {
    VectorX trial;  ///< x + s.
    double radius;  ///< Delta.
  };

  /// Checks the parameters and makes the state of one run.
  /// @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    require_positive("Trust region radius", radius);
    require(accept >= 0.0 && accept < 1.0, "Ratio that accepts", accept, "in [0, 1)");
    require(expand >= accept, "Ratio that expands", expand, "at least the ratio that accepts");
    require(shrink > 0.0 && shrink < 1.0, "Factor that shrinks the radius", shrink, "in (0, 1)");
    require(std::isfinite(grow) && grow >= 1.0, "Factor that grows the radius", grow,
            "finite and at least 1");
    require(trials >= 1, "Cap on trials", trials, "at least 1");
    return {.trial = VectorX::Zero(first.x.size()), .radius = radius};
  }

  /// Moves x to the first trial that is accepted; Outcome::not_converged after `trials` of them.
  template <class F>
  Outcome update(State& state, Iterate& now, F& f) const {
    const double slope = norm(now.gradient);
    if (slope == 0.0) return Outcome::ok;  // stationary: the loop's test sees no change and ends the run
    for (int trial = 0; trial < trials; ++trial) {
      state.trial = now.x - (state.radius / slope) * now.gradient;
      const double ratio = (now.value - f.value(state.trial)) / (state.radius * slope);
      if (ratio > accept) {
        now.x.swap(state.trial);
        now.evaluated = false;
        if (ratio > expand) state.radius *= grow;
        return Outcome::ok;
      }
      state.radius *= shrink;
    }
    return Outcome::not_converged;
  }
};

}  // namespace avi
