#pragma once
#include "avi/autodiff/scalar.hpp"

#include <cmath>
#include <cstdint>
#include <type_traits>

/// @file
/// The operations of a recorded formula: the only list of them, for folding constants and for evaluating.

namespace avi {

/// What is done with operands a and b.
enum class Operation : std::uint8_t {
  input,           ///< Argument number a; computes nothing.
  constant,        ///< A number; computes nothing.
  add,             ///< a + b
  subtract,        ///< a - b
  multiply,        ///< a b
  divide,          ///< a / b
  power,           ///< a to the constant power b
  sqrt,            ///< Square root of a; those below too are functions of a.
  exp,             ///< e to the a
  log,             ///< Natural logarithm.
  sin,             ///< Sine of a in radians.
  cos,             ///< Cosine of a in radians.
  tan,             ///< Tangent of a in radians.
  sinh,            ///< Hyperbolic sine.
  cosh,            ///< Hyperbolic cosine.
  tanh,            ///< Hyperbolic tangent.
  atan,            ///< Arc tangent, in radians.
  abs,             ///< |a|
  sign,            ///< 1 or -1, the slope of |a|.
  nothing,         ///< a itself.
  subtract_from,   ///< b - a
  sum_of_products  ///< Sum of many products, added from the first one on.
};

namespace detail {

/// The result of an operation at any scalar.
template <Operation operation, class S>
S apply(const S& a, const S& b) {
  using std::abs, std::atan, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh, std::sqrt,
      std::tan, std::tanh;
  using Op = Operation;
  if constexpr (operation == Op::add) return a + b;
  if constexpr (operation == Op::subtract) return a - b;
  if constexpr (operation == Op::subtract_from) return b - a;
  if constexpr (operation == Op::multiply) return a * b;
  if constexpr (operation == Op::divide) return a / b;
  if constexpr (operation == Op::power) {
    if constexpr (std::is_arithmetic_v<S>)
      return avi::power(a, b);
    else
      return avi::power(a, b[0]);
  }
  if constexpr (operation == Op::sqrt) return sqrt(a);
  if constexpr (operation == Op::exp) return exp(a);
  if constexpr (operation == Op::log) return log(a);
  if constexpr (operation == Op::sin) return sin(a);
  if constexpr (operation == Op::cos) return cos(a);
  if constexpr (operation == Op::tan) return tan(a);
  if constexpr (operation == Op::sinh) return sinh(a);
  if constexpr (operation == Op::cosh) return cosh(a);
  if constexpr (operation == Op::tanh) return tanh(a);
  if constexpr (operation == Op::atan) return atan(a);
  if constexpr (operation == Op::abs) return abs(a);
  if constexpr (operation == Op::sign) return sign_of(a);
  if constexpr (operation == Op::nothing) return a;
}

/// An operation may be followed by another one on its result and a third operand.
constexpr bool pairs(Operation first) {
  return first == Operation::add || first == Operation::subtract || first == Operation::multiply;
}

/// use.template operator()<operation>() for one of these operations, known at run time. Inlined, with all
/// that it calls: the choice is made some ten times in an evaluation of a few dozen nanoseconds.
template <Operation... known, class Use>
[[gnu::always_inline]] inline void with_one_of(Operation operation, Use use) {
  (void)((operation == known && (use.template operator()<known>(), true)) || ...);
}

/// The same for any operation but those that only follow others.
template <class Use>
[[gnu::always_inline]] inline void with_operation(Operation operation, Use use) {
  using enum Operation;
  with_one_of<add, subtract, multiply, divide, power, sqrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan,
              abs, sign>(operation, use);
}

/// The result at numbers, for an operation known at run time.
inline double evaluate(Operation operation, double a, double b) {
  double result = 0.0;
  with_operation(operation, [&]<Operation known>() { result = apply<known>(a, b); });
  return result;
}

}  // namespace detail

}  // namespace avi
