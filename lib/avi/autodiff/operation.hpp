#pragma once
#include "avi/autodiff/scalar.hpp"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <type_traits>

/// @file
/// The operations of a recorded formula: their names and values.

namespace avi {

/// An operation on operands a and b.
enum class Operation : std::uint8_t {
  input,     ///< Argument number a; computes nothing.
  constant,  ///< A number; computes nothing.
  add,       ///< a + b
  subtract,  ///< a - b
  multiply,  ///< a b
  divide,    ///< a / b
  power,     ///< a to the constant power b
/// @cond
#define AVI_ROW(name, ...) name,  // the function of that name, of a or of a and b
  AVI_FUNCTIONS(AVI_ROW, AVI_ROW)
#undef AVI_ROW
  /// @endcond
  sign,            ///< 1 or -1, the slope of |a|.
  less,            ///< 1 where a < b, else 0.
  less_equal,      ///< 1 where a <= b, else 0.
  when,            ///< b where the condition a is 1, else 0.
  nothing,         ///< a itself.
  subtract_from,   ///< b - a
  sum_of_products  ///< Sum of many products, added from the first one on.
};

/// @cond
namespace detail {

namespace shapes {
/// What a function f of one number a does, apart from its value and slope.
enum Shape : unsigned {
  plain = 0,
  vanishes = 1,  ///< f vanishes to the same degree as a.
  turns = 2,     ///< f is of another form for |a| < 1 than beyond, and its singularities lie beside a = 0.
  positive = 4,  ///< f > 0 for all a, as exp is, so that 1 / f has no pole.
  abrupt = 8,    ///< f, or its slope, changes exponentially fast on both sides of a = 0.
  kinked = 16    ///< f has a kink or a jump.
};
}  // namespace shapes

/// The name of an operation, its number of operand nodes in a graph (-1: any number), whether it is an
/// elementary function of the table, and its shapes.
struct OperationFacts {
  const char* name;
  int operands;
  bool is_function = false;
  unsigned shape = shapes::plain;
};
#define AVI_ONE(row, pack, shape, ...)                                                                       \
  {#row, 1, true, [] {                                                                                       \
     using namespace shapes;                                                                                 \
     return unsigned{shape};                                                                                 \
   }()},
#define AVI_TWO(row, ...) {#row, 2, true},
inline constexpr OperationFacts facts_of_operations[] = {
    {"input", 0},
    {"constant", 0},
    {"add", 2},
    {"subtract", 2},
    {"multiply", 2},
    {"divide", 2},
    {"power", 2},
    AVI_FUNCTIONS(AVI_ONE, AVI_TWO)  // in the order of the enum
    {"sign", 1, false, shapes::kinked},
    {"less", 2},
    {"less_equal", 2},
    {"when", 2},
    {"nothing", 1},
    {"subtract_from", 2},
    {"sum_of_products", -1}};
#undef AVI_ONE
#undef AVI_TWO
static_assert(std::size(facts_of_operations) == static_cast<std::size_t>(Operation::sum_of_products) + 1);

constexpr const OperationFacts& facts_of(Operation operation) {
  return facts_of_operations[static_cast<int>(operation)];
}
constexpr const char* name(Operation operation) { return facts_of(operation).name; }
constexpr int operands(Operation operation) { return facts_of(operation).operands; }
constexpr bool is_function(Operation operation) { return facts_of(operation).is_function; }
constexpr bool has(Operation operation, shapes::Shape shape) {
  return (facts_of(operation).shape & shape) != 0;
}

/// For a function that packs evaluate number by number, its function of <cmath>, such as std::tan for
/// Operation::tan. Returns nothing for all other operations.
template <Operation operation>
constexpr auto one_by_one() {
  using Op = Operation;
  using One = double (*)(double);
  using Two = double (*)(double, double);
#define AVI_side_by_side(row) void(0)
#define AVI_one_by_one(row)                                                                                  \
  if constexpr (operation == Op::row) return static_cast<One>(std::row)
#define AVI_ONE(row, pack, ...) AVI_##pack(row);
#define AVI_TWO(row, ...)                                                                                    \
  if constexpr (operation == Op::row) return static_cast<Two>(std::row);
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
#undef AVI_one_by_one
#undef AVI_side_by_side
}

/// The exponent of a power as a double: it is the same number in all lanes.
template <class S>
double first_number(const S& x) {
  if constexpr (std::is_arithmetic_v<S>)
    return x;
  else if constexpr (requires { value_of(x); })
    return first_number(value_of(x));
  else
    return x[0];
}

/// The result of an operation for any scalar.
template <Operation operation, class S>
S apply(const S& a, [[maybe_unused]] const S& b) {
  using Op = Operation;
#define AVI_ONE(row, ...)                                                                                    \
  if constexpr (operation == Op::row) {                                                                      \
    using std::row;                                                                                          \
    return row(a);                                                                                           \
  } else
#define AVI_TWO(row, ...)                                                                                    \
  if constexpr (operation == Op::row) {                                                                      \
    using std::row;                                                                                          \
    return row(a, b);                                                                                        \
  } else
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  if constexpr (operation == Op::add) {
    return a + b;
  } else if constexpr (operation == Op::subtract) {
    return a - b;
  } else if constexpr (operation == Op::subtract_from) {
    return b - a;
  } else if constexpr (operation == Op::multiply) {
    return a * b;
  } else if constexpr (operation == Op::divide) {
    return a / b;
  } else if constexpr (operation == Op::power) {
    return avi::power(a, first_number(b));
  } else if constexpr (operation == Op::sign) {
    return sign_of(a);
  } else if constexpr (operation == Op::less) {
    return less(a, b);
  } else if constexpr (operation == Op::less_equal) {
    return less_equal(a, b);
  } else if constexpr (operation == Op::when) {
    return when(a, b);
  } else {
    static_assert(operation == Op::nothing, "The value of this operation is not defined above.");
    return a;
  }
}

/// True where a second operation may be applied in the same instruction, to the result and a third operand.
constexpr bool pairs(Operation first) {
  return first == Operation::add || first == Operation::subtract || first == Operation::multiply;
}

/// Reports an operation that computes nothing; reaching it is an error in the library.
/// @throws std::logic_error always
[[noreturn, gnu::cold]] void computes_nothing(Operation operation);

/// Calls use.template operator()<operation>() for one of the listed operations, known only at run time. It is
/// inlined with everything it calls, because the choice is made about ten times in an evaluation of a few
/// dozen nanoseconds.
template <Operation... known, class Use>
[[gnu::always_inline]] inline void with_one_of(Operation operation, Use use) {
  if (!((operation == known && (use.template operator()<known>(), true)) || ...)) computes_nothing(operation);
}

/// The same for every operation that can stand alone or first in a pair. The compiler warns if a case is
/// missing.
template <class Use>
[[gnu::always_inline]] inline void with_operation(Operation operation, Use use) {
  switch (operation) {
#define AVI_ROW(row, ...)                                                                                    \
  case Operation::row:                                                                                       \
    return use.template operator()<Operation::row>();
    AVI_ROW(add)
    AVI_ROW(subtract)
    AVI_ROW(multiply)
    AVI_ROW(divide)
    AVI_ROW(power)
    AVI_FUNCTIONS(AVI_ROW, AVI_ROW)
    AVI_ROW(sign)
    AVI_ROW(less)
    AVI_ROW(less_equal)
    AVI_ROW(when)
#undef AVI_ROW
  case Operation::input:
  case Operation::constant:
  case Operation::nothing:
  case Operation::subtract_from:
  case Operation::sum_of_products:
    break;
  }
  computes_nothing(operation);
}

/// The result of an operation on numbers, known only at run time. @throws std::logic_error for one that
/// computes nothing
double evaluate(Operation operation, double a, double b);

}  // namespace detail
/// @endcond

}  // namespace avi
