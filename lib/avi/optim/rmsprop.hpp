#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

/// @file
/// RMSprop (Tieleman and Hinton 2012, lecture 6.5).

namespace avi {

/// \f$v \leftarrow \rho v + (1 - \rho)\, g^2\f$, \f$x \mathrel{-}= rate\; g/\sqrt{v + \epsilon}\f$, element
/// by element.
///
/// \f$\epsilon\f$ stands inside the root. Many programs add it outside; only inside gives the published
/// counts.
struct RmsProp {
  double rate = 1e-2;     ///< Step size, positive.
  double rho = 0.9;       ///< Decay of the mean squared gradient, in [0, 1).
  double epsilon = 1e-8;  ///< Added inside the root, at least 0.

  /// What a run carries from step to step.
  struct State {
    VectorX square;  ///< v.
  };

  /// Checks the parameters and makes the state of one run.
  /// @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    require_positive("RMSprop's rate", rate);
    require(rho >= 0.0 && rho < 1.0, "RMSprop's rho", rho, "in [0, 1)");
    require(std::isfinite(epsilon) && epsilon >= 0.0, "RMSprop's epsilon", epsilon, "finite and at least 0");
    return {.square = VectorX::Zero(first.x.size())};
  }

  /// Moves x once, with the gradient at hand; the loop evaluates at the new x.
  template <class F>
  Outcome update(State& state, Iterate& now, F&) const {
    for (Eigen::Index i = 0; i < now.x.size(); ++i) {
      const double g = now.gradient[i];
      state.square[i] = rho * state.square[i] + (1.0 - rho) * (g * g);
      now.x[i] -= rate * g / std::sqrt(state.square[i] + epsilon);
    }
    now.evaluated = false;
    return Outcome::ok;
  }
};

}  // namespace avi
