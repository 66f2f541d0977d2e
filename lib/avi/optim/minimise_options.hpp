#pragma once
#include "avi/core/require.hpp"
#include "avi/optim/stopping.hpp"

#include <functional>
#include <limits>

/// @file
/// Options of avi::minimise(), and the progress that its callback receives. The defaults suit every problem.

namespace avi {

/// The state of a minimisation, passed to MinimiseOptions::callback at x0 and after every iteration.
struct Progress {
  const VectorX& x;           ///< The iterate.
  const VectorX& gradient;    ///< Gradient there.
  double value;               ///< f there.
  double gradient_norm;       ///< 2-norm of the gradient.
  long iterations;            ///< Iterations completed.
  long gradient_evaluations;  ///< Gradients evaluated so far.
  /// False if value and gradient were interpolated from the two nearest evaluations on the line.
  bool exact;
};

/// Options of avi::minimise(). A run has converged when \f$\|\nabla f(x)\| \le \max(relative\,\|\nabla
/// f(x_0)\|, absolute)\f$ and the last iteration changed f by less than `change`. This is always tested with
/// an evaluated gradient, never an interpolated one. If `relative` and `absolute` are both 0, the run
/// continues until rounding ends it, or until the gradient is 0, or so small that its square underflows and
/// 1e-30 of what it was at x_0; the latter also counts as converged. Where f falls for ever, as
/// towards a minimum of fourth order, that may take all evaluations.
struct MinimiseOptions {
  double relative = 1e-6;  ///< Tolerance relative to the gradient at x_0, in [0, 1).
  double absolute = 0.0;   ///< Absolute tolerance of the gradient, at least 0.
  /// Bound on the change of f in one iteration, positive.
  double change = std::numeric_limits<double>::infinity();
  /// m, the number of pairs in the L-BFGS matrix, at most 1000. The memory is 2 m + 8 vectors, or 7 for m =
  /// 0.
  int memory = 7;
  long iterations = 10'000'000;  ///< Limit on iterations, at least 1.
  /// Limit on gradient evaluations, at least 1. A check of the gradient against values that has begun is
  /// completed, with up to 34 more.
  long evaluations = 10'000'000;
  /// Compare the gradient at x_0 with differences of values before the run; this mostly takes four
  /// evaluations.
  bool check_gradient = false;
  /// Called at x_0, as iteration 0, and after every iteration; returning false ends the run as
  /// Outcome::stopped.
  std::function<bool(const Progress&)> callback{};

  /// Checks the ranges. @throws std::invalid_argument for values outside the ranges above.
  void validate() const {
    require(relative >= 0.0 && relative < 1.0, "Relative tolerance", relative, "in [0, 1)");
    require(std::isfinite(absolute) && absolute >= 0.0, "Absolute tolerance", absolute,
            "finite and at least 0");
    require(change > 0.0, "Bound on the change of f", change, "positive");
    require(memory >= 0 && memory <= 1000, "Memory m", memory, "between 0 and 1000");
    require(iterations >= 1, "Cap on iterations", iterations, "at least 1");
    require(evaluations >= 1, "Cap on evaluations", evaluations, "at least 1");
  }
};

}  // namespace avi
