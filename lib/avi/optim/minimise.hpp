#pragma once
#include "avi/optim/recorded_objective.hpp"
#include "avi/optim/state_clock.hpp"

/// @file
/// The front door of the optimisers.

namespace avi {

/// Minimises f from x0 with the defaults, or with what `options` chooses: the heavy ball of StateClock.
///
/// f(x, gradient) returns the value and fills the gradient. Local minima, saddles and flat ends are all
/// stationary points: the run stops at the first one it meets, and each iteration lowers f. @code const auto
/// run = avi::minimise([](const avi::VectorX& x, avi::VectorX& g) { g = x; return 0.5 * x.dot(x); },
///                                avi::VectorX::Ones(10));
/// if (run.converged()) use(run.last.x); @endcode
/// Outcome::ok: converged; stalled: rounding hides what could still be gained; no_descent: values and
/// gradient contradict each other; wrong_gradient: seen by the check on request, or a gradient of another
/// size; diverged: f fell below -1e30 max(1, |f(x0)|); non_finite; step_limit; stopped. Whichever it is,
/// `last` is the last good point that was evaluated.
/// @throws std::invalid_argument for options out of range or an empty or non-finite x0.
template <Objective F>
[[nodiscard]] Minimisation minimise(const F& f, const VectorX& x0, const MinimiseOptions& options = {}) {
  return StateClock(std::cref(f), x0, options).run();
}

/// The same for a formula f(x) that is generic in its scalar: the gradient is found by automatic
/// differentiation.
/// @code
/// const auto run = avi::minimise([](const auto& x) { return (x[0] - 1.0) * (x[0] - 1.0) + x[1] * x[1]; },
/// x0);
/// @endcode
template <Formula F>
requires(!Objective<F>) [[nodiscard]] Minimisation
    minimise(const F& f, const VectorX& x0, const MinimiseOptions& options = {}) {
  require(x0.size() > 0, "Size of x0", x0.size(), "at least 1");
  return minimise(RecordedObjective(f, x0.size()), x0, options);
}

}  // namespace avi
