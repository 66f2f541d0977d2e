#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

/// @file
/// AdaGrad with a diagonal scaling (Duchi, Hazan and Singer 2011).

namespace avi {

/// \f$v \mathrel{+}= g^2\f$, \f$x \mathrel{-}= rate\; g/(\sqrt v + \epsilon)\f$, element by element, with v =
/// initial at the start.
struct AdaGrad {
  double rate = 1.0;      ///< Step size, positive.
  double epsilon = 1e-8;  ///< Added outside the root, at least 0.
  double initial = 0.0;   ///< Of the accumulator, at least 0.

  /// What a run carries from step to step.
  struct State {
    VectorX square;  ///< v.
  };

  /// Checks the parameters and makes the state of one run.
  /// @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    require_positive("AdaGrad's rate", rate);
    require(std::isfinite(epsilon) && epsilon >= 0.0, "AdaGrad's epsilon", epsilon, "finite and at least 0");
    require(std::isfinite(initial) && initial >= 0.0, "AdaGrad's initial accumulator", initial,
            "finite and at least 0");
    return {.square = VectorX::Constant(first.x.size(), initial)};
  }

  /// Moves x once, with the gradient at hand; the loop evaluates at the new x.
  template <class F>
  Outcome update(State& state, Iterate& now, F&) const {
    for (Eigen::Index i = 0; i < now.x.size(); ++i) {
      const double g = now.gradient[i];
      state.square[i] += g * g;
      now.x[i] -= rate * g / (std::sqrt(state.square[i]) + epsilon);
    }
    now.evaluated = false;
    return Outcome::ok;
  }
};

}  // namespace avi
