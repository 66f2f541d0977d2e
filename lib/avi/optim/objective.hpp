#pragma once
#include "avi/core/dot.hpp"
#include "avi/core/require.hpp"

#include <concepts>

/// @file
/// Objectives of a minimisation, and the number of their evaluations.

namespace avi {

/// A differentiable function: f(x, gradient) returns the value and fills the gradient, both of the size of x.
/// A member f.value(x) is used, where there is one, when only the value is asked for.
template <class F>
concept Objective = requires(const F& f, const VectorX& x, VectorX& gradient) {
  { f(x, gradient) } -> std::convertible_to<double>;
};

/// The objective as methods see it: counts every evaluation of the value and of the gradient, whatever it
/// serves.
template <Objective F>
class Counted {
 public:
  long values = 0;     ///< Function values so far.
  long gradients = 0;  ///< Gradients so far.

  /// Keeps a reference: the objective must outlive the counter.
  Counted(const F& f, Eigen::Index size) : f_(f), unused_(size) {}

  /// Value at x; the gradient goes to `gradient`.
  /// @throws std::invalid_argument where the objective makes it another size.
  double operator()(const VectorX& x, VectorX& gradient) {
    ++values;
    ++gradients;
    const double value = f_(x, gradient);
    require(gradient.size() == unused_.size(), "Size of the gradient", gradient.size(), "the size of x0, ",
            unused_.size());
    return value;
  }

  /// Value at x alone. It costs a gradient too when the objective has no member value(x).
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
  double value = 0.0;  ///< f.
  /// True when value and gradient belong to x. A method that moves x without evaluating there clears it, and
  /// the loop evaluates.
  bool evaluated = false;

  /// Makes value and gradient belong to x.
  template <class F>
  void evaluate(F& f) {
    value = f(x, gradient);
    evaluated = true;
  }
};

}  // namespace avi
