#pragma once
#include "avi/optim/minimiser.hpp"
#include "avi/optim/recorded_objective.hpp"
#include "avi/optim/starting_point.hpp"

/// @file
/// minimise(): a local minimum of a function.

namespace avi {

namespace detail {

/// An argument that converts only to VectorX. It tests whether a function takes one, because Eigen claims to
/// convert any vector type into any other.
struct PassesForVectorX {
  operator const VectorX&() const;  ///< Never called.
};

/// Stops the compiler with the reason why f is no function to minimise.
template <class F>
constexpr void refuse_as_objective() {
  using Float = Vector<float, dynamic>;
  constexpr bool value_alone = std::is_invocable_v<const F&, const PassesForVectorX&>;
  constexpr bool in_float = std::is_invocable_v<const F&, const Float&, Float&> ||
                            (std::is_invocable_v<const F&, const Float&> && !value_alone);
  static_assert(!in_float, "f works in float: the library computes in double alone.");
  static_assert(
      in_float || !value_alone,
      "f gives a value alone: have it fill a gradient, too, f(x, gradient), or write it for any kind "
      "of number, [](const auto& x) { ... }, so that its gradient can be found.");
  static_assert(in_float || value_alone,
                "f must be f(x, gradient), which returns the value and fills the gradient, or a formula f(x) "
                "for any kind of number; x and gradient are avi::VectorX.");
}

}  // namespace detail

/// Minimises f from x0, with default or given options, by L-BFGS, or by nonlinear conjugate gradients if
/// options.memory is 0; see Minimiser.
///
/// f(x, gradient) returns the value and fills in the gradient. Or f(x) is a formula that is generic in its
/// scalar, or a Formula, and the gradient is found by automatic differentiation. x0 is anything that
/// StartingPoint accepts. The run stops at the first stationary point that it meets, which may be a local
/// minimum, a saddle or a flat region. Each iteration lowers f as far as rounding allows. An evaluated
/// iterate never exceeds f(x0) by more than rounding. It exceeds an earlier iterate at most by this and by
/// what was taken for noise of f where a line search was stuck, at most 1e-8 of the largest |f| at x0 and at
/// such places.
/// @code
/// const auto run = avi::minimise([](const auto& x) { return (x[0] - 1.0) * (x[0] - 1.0) + x[1] * x[1]; },
///                                {3.0, 4.0});
/// if (run.ok()) use(run.last.x);
/// @endcode
/// Outcomes: ok, converged; stalled, rounding hides any further gain; no_descent, values and gradient
/// contradict each other, as at a kink or a wall of finite height; wrong_gradient, found by the check on
/// request, or a gradient of another size than x; diverged, f fell below -1e300; non_finite; step_limit;
/// stopped. In every case `last` is the last valid point that was evaluated. It need not be the trial with
/// the smallest f.
/// @throws std::invalid_argument for options out of range, or an empty or non-finite x0.
template <class F>
[[nodiscard]] Minimisation minimise(const F& f, const StartingPoint& x0,
                                    const MinimiseOptions& options = {}) {
  const VectorX& x = x0.vector();
  if constexpr (std::is_same_v<F, Formula>) {
    require(x.size() == f.inputs(), "Size of x0", x.size(), "the number of arguments of f, ", f.inputs());
    const RecordedObjective recorded(f);
    return Minimiser(std::cref(recorded), x, options).run();
  } else if constexpr (Objective<F>) {
    return Minimiser(std::cref(f), x, options).run();
  } else if constexpr (Recordable<F>) {
    require(x.size() > 0, "Size of x0", x.size(), "at least 1");
    const RecordedObjective recorded(f, x.size());
    return Minimiser(std::cref(recorded), x, options).run();
  } else {
    detail::refuse_as_objective<F>();
    return {};
  }
}

}  // namespace avi
