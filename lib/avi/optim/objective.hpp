#pragma once
#include "avi/core/dot.hpp"
#include "avi/core/require.hpp"

#include <concepts>

/// @file
/// Objectives of a minimisation, and a counter of their evaluations.

namespace avi {

/// A differentiable function: f(x, gradient) returns the value and fills in the gradient, which has the size
/// of x. If only the value is needed, a member f.value(x) is used where there is one.
template <class F>
concept Objective = requires(const F& f, const VectorX& x, VectorX& gradient) {
  { f(x, gradient) } -> std::convertible_to<double>;
};

/// An objective with a counter, as update rules see it. It counts all evaluations of values and gradients,
/// for whatever purpose.
template <Objective F>
class Counted {
 public:
  long values = 0;     ///< Values evaluated so far.
  long gradients = 0;  ///< Gradients evaluated so far.

  /// Stores a reference: the objective must outlive the counter.
  Counted(const F& f, Eigen::Index size) : f_(f), unused_(size) {}

  /// The value at x; the gradient is stored in `gradient`.
  /// @throws std::invalid_argument if the objective gives it another size.
  double operator()(const VectorX& x, VectorX& gradient) {
    ++values;
    ++gradients;
    const double value = f_(x, gradient);
    require(gradient.size() == unused_.size(), "Size of the gradient", gradient.size(), "the size of x0, ",
            unused_.size());
    return value;
  }

  /// The value at x only. If the objective has no member value(x), this also costs a gradient.
  double value(const VectorX& x) {
    if constexpr (requires { f_.value(x); }) {
      ++values;
      return f_.value(x);
    } else {
      return (*this)(x, unused_);
    }
  }

 private:
  const F& f_;
  VectorX unused_;
};

/// A point with the value and gradient of the objective there.
struct Iterate {
  VectorX x;           ///< n entries.
  VectorX gradient;    ///< n entries.
  double value = 0.0;  ///< Value of f.
  /// True if value and gradient belong to x. A method that moves x without evaluating f there sets this to
  /// false, and the loop then evaluates.
  bool evaluated = false;

  /// Evaluates f at x.
  template <class F>
  void evaluate(F& f) {
    value = f(x, gradient);
    evaluated = true;
  }
};

}  // namespace avi
