#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/core/require.hpp"
#include "avi/core/vector.hpp"

#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

/// @file
/// Recorded: the scalar with which a function is called to record its operations.

namespace avi {

class RecordedCondition;

namespace detail {
/// A plain number that may be combined with a recorded one in a formula.
template <class T>
concept PlainNumber = std::is_arithmetic_v<T> ||(std::is_enum_v<T>&& std::is_convertible_v<T, double>);
}  // namespace detail

/// A constant, or a node of the formula being recorded. Every operation on it is added to the graph. It has
/// no value, so a function cannot branch on it: comparisons can only be used in select(), and conversions to
/// a number do not compile.
class Recorded : Scalar<Recorded> {
 public:
  Recorded() = default;
  /// A constant.
  Recorded(double number) : number_(number) {}  // NOLINT: implicit, so that formulas read as written
  /// A node of a graph; the graph must outlive this object.
  Recorded(ExpressionGraph& graph, int node) {
    if (graph.is_constant(node)) {
      number_ = graph[node].number;
    } else {
      graph_ = &graph;
      node_ = node;
      recording_ = graph.identity();
    }
  }

  /// The node of this value in `graph`; a constant is added to it. @throws std::invalid_argument where the
  /// value belongs to another graph.
  [[nodiscard]] int node_in(ExpressionGraph& graph) const;

  ///@{

  /// Conversions that stop the compiler with an explanation, because a recorded value is no number. The
  /// implicit one is reached by functions of std:: and by `+=` on a plain number. It converts to float, not
  /// double: if Recorded and double converted to each other implicitly, `?:` between them would be ambiguous.
  template <std::same_as<float> T>
  operator T() const {  // NOLINT: implicit, so that this sentence is what the compiler says
    static_assert(
        !std::is_same_v<T, T>,
        "A formula is recorded without values, so its arguments and what is computed from them are no "
        "numbers: call sqrt(x), pow(x, y) and the like without std:: (after `using std::sqrt;`), and "
        "begin sums and helper functions with `auto`, not with double.");
    return T();
  }
  template <class T>
  requires(std::is_arithmetic_v<T> && !std::is_same_v<T, float>) explicit operator T() const {
    static_assert(
        !std::is_same_v<T, T>,
        "A formula is recorded without values, so its arguments and what is computed from them cannot "
        "be turned into numbers: make it generic in its scalar, and instead of a branch write "
        "select(a < b, x, y), min(x, y), max(x, y) or abs(x).");
    return T();
  }
  ///@}

  ///@{

  /// Operations that are added to the graph; on two constants they are evaluated at once.
  friend Recorded operator-(const Recorded& a) { return combine(Operation::multiply, -1.0, a); }
  friend Recorded operator+(const Recorded& a, const Recorded& b) { return combine(Operation::add, a, b); }
  friend Recorded operator-(const Recorded& a, const Recorded& b) {
    return combine(Operation::subtract, a, b);
  }
  friend Recorded operator*(const Recorded& a, const Recorded& b) {
    return combine(Operation::multiply, a, b);
  }
  friend Recorded operator/(const Recorded& a, const Recorded& b) { return combine(Operation::divide, a, b); }
  friend Recorded pow(const Recorded& a, double exponent) {
    if (!a.graph_) return power(a.number_, exponent);
    return {*a.graph_, a.graph_->power(a.node_in(*a.graph_), exponent)};
  }
  friend Recorded sign_of(const Recorded& a) { return a.through(Operation::sign); }
  friend Recorded less(const Recorded& a, const Recorded& b) { return combine(Operation::less, a, b); }
  friend Recorded less_equal(const Recorded& a, const Recorded& b) {
    return combine(Operation::less_equal, a, b);
  }
  friend Recorded when(const Recorded& condition, const Recorded& a) {
    return combine(Operation::when, condition, a);
  }
  ///@}

  ///@{

  /// Comparisons, for use in select().
  friend RecordedCondition operator<(const Recorded& a, const Recorded& b);
  friend RecordedCondition operator>(const Recorded& a, const Recorded& b);
  friend RecordedCondition operator<=(const Recorded& a, const Recorded& b);
  friend RecordedCondition operator>=(const Recorded& a, const Recorded& b);
  ///@}
  /// Compares two constants, as Eigen does with its own factors. @throws std::invalid_argument if either
  /// value is recorded
  friend bool operator==(const Recorded& a, const Recorded& b) {
    if (a.graph_ || b.graph_)
      throw std::invalid_argument(
          "A function that asks whether its arguments are equal cannot be recorded; "
          "instead of a branch write select(a < b, x, y), min(x, y), max(x, y) or abs(x).");
    return a.number_ == b.number_;
  }

  /// @cond
  // Overloads for one plain operand: without them the built-in operators would be considered too.
#define AVI_WITH_NUMBERS(specifier, result, name)                                                            \
  template <detail::PlainNumber T>                                                                           \
  specifier result name(const Recorded& a, T b) {                                                            \
    return name(a, Recorded(static_cast<double>(b)));                                                        \
  }                                                                                                          \
  template <detail::PlainNumber T>                                                                           \
  specifier result name(T a, const Recorded& b) {                                                            \
    return name(Recorded(static_cast<double>(a)), b);                                                        \
  }
  AVI_WITH_NUMBERS(friend, Recorded, operator+)
  AVI_WITH_NUMBERS(friend, Recorded, operator-)
  AVI_WITH_NUMBERS(friend, Recorded, operator*)
  AVI_WITH_NUMBERS(friend, Recorded, operator/)
  template <detail::PlainNumber T>
  friend bool operator==(const Recorded& a, T b) {
    return a == Recorded(static_cast<double>(b));
  }
  // A plain number cannot accumulate recorded values: these operators stop the compiler with the message of
  // the conversion above.
#define AVI_ASSIGNMENT(name)                                                                                 \
  template <detail::PlainNumber T>                                                                           \
  friend T& name(T& a, const Recorded& b) {                                                                  \
    return a = static_cast<T>(static_cast<float>(b));                                                        \
  }
  AVI_ASSIGNMENT(operator+=)
  AVI_ASSIGNMENT(operator-=)
  AVI_ASSIGNMENT(operator*=)
  AVI_ASSIGNMENT(operator/=)
#undef AVI_ASSIGNMENT
#define AVI_ONE(name, ...)                                                                                   \
  friend Recorded name(const Recorded& a) { return a.through(Operation::name); }
#define AVI_TWO(name, ...)                                                                                   \
  friend Recorded name(const Recorded& a, const Recorded& b) { return combine(Operation::name, a, b); }      \
  AVI_WITH_NUMBERS(friend, Recorded, name)
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  /// @endcond

 private:
  [[nodiscard]] Recorded through(Operation operation) const;
  static Recorded combine(Operation operation, const Recorded& a, const Recorded& b);

  ExpressionGraph* graph_ = nullptr;  // null for a constant
  int node_ = -1;
  // identity of the graph, because another graph may later have the same address
  std::uint32_t recording_ = 0;
  double number_ = 0.0;
};

/// The result of a comparison of recorded numbers, known only when the formula is evaluated; for select().
class RecordedCondition {
 public:
  /// A condition from a recorded number that is 1 or 0.
  explicit RecordedCondition(const Recorded& number) : number_(number) {}

  /// A condition has no value while recording: this conversion stops the compiler.
  template <std::same_as<bool> T>
  operator T() const {  // NOLINT: implicit, so that this sentence is what the compiler says
    static_assert(
        !std::is_same_v<T, T>,
        "A formula is recorded once for all arguments, so it cannot branch on them: instead of `if` or "
        "`?:` write select(a < b, x, y), min(x, y), max(x, y) or abs(x), without std::.");
    return T();
  }

  ///@{

  /// Conjunction, disjunction and negation of conditions.
  friend RecordedCondition operator&&(const RecordedCondition& a, const RecordedCondition& b) {
    return RecordedCondition(when(a.number_, b.number_));
  }
  friend RecordedCondition operator||(const RecordedCondition& a, const RecordedCondition& b) {
    return !(!a && !b);
  }
  friend RecordedCondition operator!(const RecordedCondition& a) {
    return RecordedCondition(1.0 - a.number_);
  }
  ///@}
  /// x where the condition holds, else y. A chosen -0 becomes 0.
  friend Recorded choose(const RecordedCondition& condition, const Recorded& x, const Recorded& y) {
    return when(condition.number_, x) + when(1.0 - condition.number_, y);
  }

 private:
  Recorded number_;
};

/// @cond
inline RecordedCondition operator<(const Recorded& a, const Recorded& b) {
  return RecordedCondition(less(a, b));
}
inline RecordedCondition operator>(const Recorded& a, const Recorded& b) { return b < a; }
inline RecordedCondition operator<=(const Recorded& a, const Recorded& b) {
  return RecordedCondition(less_equal(a, b));
}
inline RecordedCondition operator>=(const Recorded& a, const Recorded& b) { return b <= a; }
AVI_WITH_NUMBERS(inline, RecordedCondition, operator<)
AVI_WITH_NUMBERS(inline, RecordedCondition, operator>)
AVI_WITH_NUMBERS(inline, RecordedCondition, operator<=)
AVI_WITH_NUMBERS(inline, RecordedCondition, operator>=)
#undef AVI_WITH_NUMBERS
/// @endcond

/// The vector with which a function is called when it is recorded. An index beyond its size is refused,
/// because the memory behind it would be taken for nodes. @tparam n size, or avi::dynamic
template <int n = dynamic>
using RecordedVector = detail::Checked<Recorded, n>;

/// The arguments `first` to `first + count - 1` of a formula. @tparam n count, or avi::dynamic
/// @throws std::invalid_argument where n is known and differs from `count`.
template <int n = dynamic>
RecordedVector<n> recorded_inputs(ExpressionGraph& graph, int first, Eigen::Index count) {
  require(n == dynamic || count == n, "Number of degrees of freedom to record", count, "", n);
  RecordedVector<n> x(count);
  for (int i = 0; i < count; ++i)
    x[i] = Recorded(graph, first + i);
  return x;
}

}  // namespace avi

/// @cond
namespace Eigen {
template <>
struct NumTraits<avi::Recorded> : NumTraits<double> {
  using Real = avi::Recorded;
  using NonInteger = avi::Recorded;
  using Nested = avi::Recorded;
  using Literal = double;
  enum { RequireInitialization = 1 };
};
}  // namespace Eigen
/// @endcond
