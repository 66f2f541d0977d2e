#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>

/// @file
/// ADAM (Kingma and Ba 2015, Algorithm 1).

namespace avi {

/// Steps scaled by decaying means of gradient and squared gradient. Element by element, \f[ m \leftarrow
/// \beta_1 m + (1 - \beta_1)\, g, \quad v \leftarrow \beta_2 v + (1 - \beta_2)\, g^2, \quad x \mathrel{-}=
/// rate\; \frac{m/(1 - \beta_1^k)}{\sqrt{v/(1 - \beta_2^k)} + \epsilon}. \f]
struct Adam {
  double rate = 1e-3;     ///< Step size, positive.
  double beta_1 = 0.9;    ///< Decay of the mean gradient, in [0, 1).
  double beta_2 = 0.999;  ///< Decay of the mean squared gradient, in [0, 1).
  double epsilon = 1e-8;  ///< Added outside the root, at least 0.

  /// What a run carries from step to step.
  struct State {
    VectorX mean;          ///< m.
    VectorX square;        ///< v.
    double power_1 = 1.0;  ///< beta_1^k.
    double power_2 = 1.0;  ///< beta_2^k.
  };

  /// Checks the parameters and makes the state of one run.
  /// @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    require_positive("ADAM's rate", rate);
    require(beta_1 >= 0.0 && beta_1 < 1.0, "ADAM's beta_1", beta_1, "in [0, 1)");
    require(beta_2 >= 0.0 && beta_2 < 1.0, "ADAM's beta_2", beta_2, "in [0, 1)");
    require(std::isfinite(epsilon) && epsilon >= 0.0, "ADAM's epsilon", epsilon, "finite and at least 0");
    const VectorX zero = VectorX::Zero(first.x.size());
    return {.mean = zero, .square = zero};
  }

  /// Moves x once, with the gradient at hand; the loop evaluates at the new x.
  template <class F>
  Outcome update(State& state, Iterate& now, F&) const {
    state.power_1 *= beta_1;
    state.power_2 *= beta_2;
    const double scale_1 = 1.0 - state.power_1, scale_2 = 1.0 - state.power_2;
    for (Eigen::Index i = 0; i < now.x.size(); ++i) {
      const double g = now.gradient[i];
      state.mean[i] = beta_1 * state.mean[i] + (1.0 - beta_1) * g;
      state.square[i] = beta_2 * state.square[i] + (1.0 - beta_2) * (g * g);
      now.x[i] -= rate * (state.mean[i] / scale_1) / (std::sqrt(state.square[i] / scale_2) + epsilon);
    }
    now.evaluated = false;
    return Outcome::ok;
  }
};

}  // namespace avi
