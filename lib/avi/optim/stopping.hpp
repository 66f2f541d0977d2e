#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/optim/objective.hpp"

#include <cmath>
#include <string>

/// @file
/// When a minimisation ends, and what it tells its caller.

namespace avi {

/// |a|, also where the squares of its entries underflow.
inline double length(const VectorView& a) {
  const double unscaled = norm(a);
  if (!(unscaled < 1e-150)) return unscaled;
  const double largest = largest_entry(a);
  return largest > 0.0 ? largest * norm(a / largest) : unscaled;
}

/// End of a run after iteration k: \f$|f(x_k) - f(x_{k-1})| < \delta\f$ and \f$\|\nabla f(x_k)\|_2 <
/// \delta\f$ (the paper's termination criterion, equation (4.22)), or the cap, or the run has left every
/// bound.
struct Stopping {
  double delta = 1e-10;          ///< At least 0; with 0 the test never holds and the run goes on to the cap.
  long iterations = 10'000'000;  ///< Cap on updates, at least 1.
  /// The run has diverged when |f| exceeds growth max(1, |f(x_0)|): x itself may go wherever f stays within
  /// that. Where f is NaN it has diverged if an entry of x exceeds growth max(1, |x_0|_inf), and met what is
  /// not a number if none does. At least 1.
  double growth = 1e30;

  /// Checks the ranges. @throws std::invalid_argument for values outside the ranges above.
  void validate() const {
    require(std::isfinite(delta) && delta >= 0.0, "Tolerance delta", delta, "finite and at least 0");
    require(iterations >= 1, "Cap on iterations", iterations, "at least 1");
    require(growth >= 1.0, "Growth that counts as divergence", growth, "at least 1");
  }

  /// The termination criterion; `change` is f(x_k) - f(x_{k-1}).
  [[nodiscard]] bool holds(double change, const Iterate& at) const {
    return std::abs(change) < delta && length(at.gradient) < delta;
  }
};

/// The result of a minimisation. Outcome::ok means converged.
struct Minimisation {
  Outcome outcome = Outcome::step_limit;  ///< How the run ended.
  long iterations = 0;                    ///< Updates made.
  long gradient_evaluations = 0;          ///< All of them, those of the stopping test included.
  long function_evaluations = 0;          ///< Likewise.
  /// The last iterate; where a run ended as diverged or non_finite, the last good one, evaluated once more.
  Iterate last;
  std::string message;  ///< Empty when converged; else one sentence with iteration and reason.

  [[nodiscard]] bool ok() const { return outcome == Outcome::ok; }  ///< The criterion held.
  [[nodiscard]] bool converged() const { return ok(); }             ///< The same, in the field's word.
};

}  // namespace avi
