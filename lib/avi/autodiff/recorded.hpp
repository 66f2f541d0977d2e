#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/core/vector.hpp"

#include <compare>
#include <stdexcept>
#include <type_traits>

/// @file
/// The scalar that writes down what is done to it.

namespace avi {

/// A number, or a node of the formula that is being recorded. What a callable does with it is written into
/// the graph. It has no value, so a callable cannot branch on it: comparisons by size and
/// conversions to a number do not compile.
class Recorded : Scalar<Recorded> {
 public:
  Recorded() = default;
  /// A number.
  Recorded(double number) : number_(number) {}  // NOLINT: implicit, so that formulas read as written
  /// A node of a graph, which must outlive it.
  Recorded(ExpressionGraph& graph, int node) {
    if (graph.is_constant(node)) {
      number_ = graph[node].number;
    } else {
      graph_ = &graph;
      node_ = node;
    }
  }

  /// The node of this value in `graph`. @throws std::invalid_argument where it belongs to another one.
  [[nodiscard]] int node_in(ExpressionGraph& graph) const {
    if (!graph_) return graph.constant(number_);
    if (graph_ != &graph)
      throw std::invalid_argument("A recorded function mixes the arguments of two recordings; it must not "
                                  "keep numbers from one call to the next.");
    return node_;
  }

  /// There is no such number while a function is recorded.
  template <class T>
  requires std::is_arithmetic_v<T>
  explicit operator T() const {
    static_assert(
        !std::is_arithmetic_v<T>,
        "A function that turns its arguments into numbers cannot be recorded: make it generic in its scalar, "
        "or, where the compiler knows the dimension, supply d_dq(q, p) and d_dp(q, p).");
    return T();
  }

  ///@{

  /// Written into the graph; of two constants, computed.
  friend Recorded operator-(const Recorded& a) { return combine(Operation::multiply, -1.0, a); }
  friend Recorded operator+(const Recorded& a, const Recorded& b) { return combine(Operation::add, a, b); }
  friend Recorded operator-(const Recorded& a, const Recorded& b) {
    return combine(Operation::subtract, a, b);
  }
  friend Recorded operator*(const Recorded& a, const Recorded& b) {
    return combine(Operation::multiply, a, b);
  }
  friend Recorded operator/(const Recorded& a, const Recorded& b) { return combine(Operation::divide, a, b); }
  /// Compares constants, as Eigen does with its own factors. @throws std::invalid_argument for recorded
  /// values
  friend bool operator==(const Recorded& a, const Recorded& b) {
    if (a.graph_ || b.graph_)
      throw std::invalid_argument(
          "A function that asks whether its arguments are equal cannot be recorded; "
          "where the compiler knows the dimension, supply d_dq(q, p) and d_dp(q, p).");
    return a.number_ == b.number_;
  }
  friend Recorded pow(const Recorded& a, double exponent) {
    if (!a.graph_) return power(a.number_, exponent);
    return {*a.graph_, a.graph_->power(a.node_, exponent)};
  }
  friend Recorded sqrt(const Recorded& a) { return a.through(Operation::sqrt); }
  friend Recorded exp(const Recorded& a) { return a.through(Operation::exp); }
  friend Recorded log(const Recorded& a) { return a.through(Operation::log); }
  friend Recorded sin(const Recorded& a) { return a.through(Operation::sin); }
  friend Recorded cos(const Recorded& a) { return a.through(Operation::cos); }
  friend Recorded tan(const Recorded& a) { return a.through(Operation::tan); }
  friend Recorded sinh(const Recorded& a) { return a.through(Operation::sinh); }
  friend Recorded cosh(const Recorded& a) { return a.through(Operation::cosh); }
  friend Recorded tanh(const Recorded& a) { return a.through(Operation::tanh); }
  friend Recorded atan(const Recorded& a) { return a.through(Operation::atan); }
  friend Recorded abs(const Recorded& a) { return a.through(Operation::abs); }
  friend Recorded sign_of(const Recorded& a) { return a.through(Operation::sign); }
  ///@}

  /// A recording has no branches: this does not compile.
  template <class A>
  friend std::partial_ordering operator<=>(const Recorded&, const A&) {
    static_assert(
        !std::is_same_v<A, A>,
        "A function that compares its arguments cannot be recorded: a straight line of operations has "
        "no branches. Write the function without comparisons, or, where the compiler knows the dimension, "
        "supply d_dq(q, p) and d_dp(q, p).");
    return std::partial_ordering::unordered;
  }

 private:
  [[nodiscard]] Recorded through(Operation operation) const {
    if (!graph_) return detail::evaluate(operation, number_, 0.0);
    return {*graph_, graph_->unary(operation, node_)};
  }
  static Recorded combine(Operation operation, const Recorded& a, const Recorded& b) {
    ExpressionGraph* graph = a.graph_ ? a.graph_ : b.graph_;
    if (!graph) return detail::evaluate(operation, a.number_, b.number_);
    const int left = a.node_in(*graph), right = b.node_in(*graph);
    return {*graph, graph->binary(operation, left, right)};
  }

  ExpressionGraph* graph_ = nullptr;  // none for a number
  int node_ = -1;
  double number_ = 0.0;
};

/// `count` arguments of a formula from the one numbered `first` on. @tparam n count, or avi::dynamic
template <int n = dynamic>
Vector<Recorded, n> recorded_inputs(ExpressionGraph& graph, int first, Eigen::Index count) {
  Vector<Recorded, n> x(count);
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
// Matrices of numbers may multiply recorded vectors.
template <class Op>
struct ScalarBinaryOpTraits<double, avi::Recorded, Op> {
  using ReturnType = avi::Recorded;
};
template <class Op>
struct ScalarBinaryOpTraits<avi::Recorded, double, Op> {
  using ReturnType = avi::Recorded;
};
}  // namespace Eigen
/// @endcond
