#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>
#include <string>

/// @file
/// The stopping rule and the result of a minimisation.

namespace avi {

/// The 2-norm |a|, also where the squares of its entries underflow.
inline double length(const VectorView& a) {
  const double unscaled = norm(a);
  if (!(unscaled < 1e-150)) return unscaled;
  const double largest = largest_entry(a);
  return largest > 0.0 ? largest * norm(a / largest) : unscaled;
}

/// When a run ends after iteration k: if \f$|f(x_k) - f(x_{k-1})| < \delta\f$ and \f$\|\nabla f(x_k)\|_2 <
/// \delta\f$ (the termination criterion of the paper, equation (4.22)), at the limit on iterations, or on
/// divergence.
struct Stopping {
  double delta = 1e-10;          ///< Tolerance, at least 0; with 0 the criterion never holds.
  long iterations = 10'000'000;  ///< Limit on updates, at least 1.
  /// The run has diverged when |f| exceeds growth max(1, |f(x_0)|); x itself is not bounded as long as f
  /// stays below that. If f is NaN, the run has diverged if an entry of x exceeds growth max(1, |x_0|_inf),
  /// and otherwise ends as non_finite. At least 1.
  double growth = 1e30;

  /// Checks the ranges. @throws std::invalid_argument for values outside the ranges above.
  void validate() const {
    require(std::isfinite(delta) && delta >= 0.0, "Tolerance delta", delta, "finite and at least 0");
    require(iterations >= 1, "Cap on iterations", iterations, "at least 1");
    require(growth >= 1.0, "Growth that counts as divergence", growth, "at least 1");
  }

  /// The termination criterion. @param change f(x_k) - f(x_{k-1}) @param at the iterate x_k
  [[nodiscard]] bool holds(double change, const Iterate& at) const {
    return std::abs(change) < delta && length(at.gradient) < delta;
  }
};

/// The result of a minimisation. Outcome::ok means that it converged.
struct Minimisation {
  Outcome outcome = Outcome::step_limit;  ///< How the run ended.
  long iterations = 0;                    ///< Updates made.
  long gradient_evaluations = 0;          ///< All gradients, including those of the stopping test.
  long function_evaluations = 0;          ///< All values, likewise.
  /// The last iterate; if the run ended as diverged or non_finite, the last valid one, evaluated again.
  Iterate last;
  std::string message;  ///< Empty if converged; otherwise one sentence with iteration and reason.

  [[nodiscard]] bool ok() const { return outcome == Outcome::ok; }  ///< The run has converged.
};

}  // namespace avi
