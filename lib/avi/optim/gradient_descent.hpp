#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

/// @file
/// Gradient descent (Cauchy 1847).

namespace avi {

/// x_k = x_{k-1} - h grad f(x_{k-1}).
struct GradientDescent {
  double h = 1e-3;  ///< Step size, finite and positive.

  struct State {};

  /// @throws std::invalid_argument for h out of range.
  State start(const Iterate&) const {
    require_positive("Step size h", h);
    return {};
  }

  template <class F>
  Outcome update(State&, Iterate& now, F&) const {
    now.x -= h * now.gradient;
    now.evaluated = false;
    return Outcome::ok;
  }
};

}  // namespace avi
