#pragma once
#include "avi/core/require.hpp"
#include "avi/optim/stopping.hpp"

#include <functional>
#include <limits>

/// @file
/// Options of avi::minimise(), and the progress that its callback sees. Every default serves every problem.

namespace avi {

/// Where a minimisation stands, shown to MinimiseOptions::callback at x0 and after every iteration.
struct Progress {
  const VectorX& x;           ///< The iterate.
  const VectorX& gradient;    ///< Gradient there.
  double value;               ///< f there.
  double gradient_norm;       ///< 2-norm of the gradient.
  long iterations;            ///< Iterations made.
  long gradient_evaluations;  ///< So far.
  /// False where value and gradient were interpolated from the two evaluations nearest on the line.
  bool exact;
};

/// Choices of avi::minimise(). A run has converged when \f$\|\nabla f(x)\| \le \max(relative\,\|\nabla
/// f(x_0)\|, absolute)\f$ and the last iteration changed f by less than `change`; that is always decided on
/// an evaluated gradient, never on an interpolated one. With `relative` and `absolute` both 0 the run goes on
/// until rounding ends it or the gradient is 0, or so small that its square underflows: that is converged,
/// too.
struct MinimiseOptions {
  double relative = 1e-6;                                   ///< In [0, 1).
  double absolute = 0.0;                                    ///< At least 0.
  double change = std::numeric_limits<double>::infinity();  ///< Positive; of f in one iteration.
  /// m, the pairs that make the mass matrix: 0 for none (7 vectors of memory), at most 1000; else 2 m + 8.
  int memory = 7;
  long iterations = 10'000'000;  ///< Cap, at least 1.
  /// Cap on gradients, at least 1. A comparison with values that was begun is finished: up to 20 more.
  long evaluations = 10'000'000;
  /// Compares the gradient at x_0 with differences of values first, mostly for four evaluations more.
  bool check_gradient = false;
  /// Called at x_0, as iteration 0, and after every iteration; false ends the run as Outcome::stopped.
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
