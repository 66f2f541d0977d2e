#pragma once
#include "avi/core/power.hpp"

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

/// The first number of a scalar that may hold several.
template <class S>
double first_number(const S& x) {
  if constexpr (std::is_arithmetic_v<S>)
    return static_cast<double>(x);
  else
    return x[0];
}

/// 1 or -1 for each number of x.
template <class S>
S sign_of(const S& x) {
  if constexpr (std::is_arithmetic_v<S>)
    return std::copysign(S(1.0), x);
  else
    return x.each([](double v) { return std::copysign(1.0, v); });
}

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
  if constexpr (operation == Op::power) return avi::power(a, first_number(b));
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

/// use.template operator()<operation>(), for what may follow another operation, known at run time.
template <class Use>
[[gnu::always_inline]] inline void with_second(Operation operation, Use use) {
  using Op = Operation;
  switch (operation) {
  case Op::add:
    return use.template operator()<Op::add>();
  case Op::subtract:
    return use.template operator()<Op::subtract>();
  case Op::subtract_from:
    return use.template operator()<Op::subtract_from>();
  case Op::multiply:
    return use.template operator()<Op::multiply>();
  default:
    return use.template operator()<Op::nothing>();
  }
}

/// use.template operator()<operation>(), for any other operation known at run time. Inlined, with all that
/// it calls: the choice is made some ten times in an evaluation of a few dozen nanoseconds.
template <class Use>
[[gnu::always_inline]] inline void with_operation(Operation operation, Use use) {
  using Op = Operation;
  switch (operation) {
  case Op::add:
    return use.template operator()<Op::add>();
  case Op::subtract:
    return use.template operator()<Op::subtract>();
  case Op::multiply:
    return use.template operator()<Op::multiply>();
  case Op::divide:
    return use.template operator()<Op::divide>();
  case Op::power:
    return use.template operator()<Op::power>();
  case Op::sqrt:
    return use.template operator()<Op::sqrt>();
  case Op::exp:
    return use.template operator()<Op::exp>();
  case Op::log:
    return use.template operator()<Op::log>();
  case Op::sin:
    return use.template operator()<Op::sin>();
  case Op::cos:
    return use.template operator()<Op::cos>();
  case Op::tan:
    return use.template operator()<Op::tan>();
  case Op::sinh:
    return use.template operator()<Op::sinh>();
  case Op::cosh:
    return use.template operator()<Op::cosh>();
  case Op::tanh:
    return use.template operator()<Op::tanh>();
  case Op::atan:
    return use.template operator()<Op::atan>();
  case Op::abs:
    return use.template operator()<Op::abs>();
  case Op::sign:
    return use.template operator()<Op::sign>();
  default:
    break;  // not of this kind
  }
}

/// The result at numbers, for an operation known at run time.
inline double evaluate(Operation operation, double a, double b) {
  double result = 0.0;
  with_operation(operation, [&]<Operation known>() { result = apply<known>(a, b); });
  return result;
}

}  // namespace detail

}  // namespace avi
