#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

/// @file
/// Gradient descent (Cauchy 1847).

namespace avi {

/// \f$x_k = x_{k-1} - h\, \nabla f(x_{k-1})\f$.
struct GradientDescent {
  double h = 1e-3;  ///< Step size, finite and positive.

  struct State {};  ///< Nothing is carried.

  /// Checks the parameters and makes the state of one run.
  /// @throws std::invalid_argument for h out of range.
  State start(const Iterate&) const {
    require_positive("Step size h", h);
    return {};
  }

  /// Moves x once, with the gradient at hand; the loop evaluates at the new x.
  template <class F>
  Outcome update(State&, Iterate& now, F&) const {
    now.x -= h * now.gradient;
    now.evaluated = false;
    return Outcome::ok;
  }
};

}  // namespace avi
