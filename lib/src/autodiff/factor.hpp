#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <cmath>

/// @file
/// The scalar with which slopes are written into a graph.

namespace avi::detail {

/// A number times a node of a graph, or a number alone. Numbers are kept apart from the nodes, and multiplied
/// in where that saves operations.
class Factor {
 public:
  /// A number.
  Factor(double value) : number(value) {}  // NOLINT: implicit, so that slopes read as written
  /// A number times a node.
  Factor(ExpressionGraph& where, double value, int of) : number(value), node(of), graph(&where) {}
  /// A node, or its number if it is a constant.
  Factor(ExpressionGraph& where, int of)
      : number(where.is_constant(of) ? where[of].number : 1.0), node(where.is_constant(of) ? -1 : of),
        graph(&where) {}

  double number = 0.0;               ///< The number.
  int node = -1;                     ///< The node, or -1.
  ExpressionGraph* graph = nullptr;  ///< Graph of the node; a number may have none.

  /// Returns the node of the product in a graph.
  [[nodiscard]] int in(ExpressionGraph& where) const {
    if (node < 0) return where.constant(number);
    return number == 1.0 ? node : where.binary(Operation::multiply, where.constant(number), node);
  }

  ///@{

  /// Operations, written into the graph.
  friend Factor operator-(const Factor& a) { return {-1.0 * a.number, a.node, a.graph}; }
  friend Factor operator*(const Factor& a, const Factor& b) {
    const double product = a.number * b.number;
    if (a.node < 0) return {product, b.node, b.graph ? b.graph : a.graph};
    if (b.node < 0) return {product, a.node, a.graph};
    return {product, a.graph->binary(Operation::multiply, a.node, b.node), a.graph};
  }
  friend Factor operator/(const Factor& a, const Factor& b) { return a * b.reciprocal(); }
  friend Factor operator+(const Factor& a, const Factor& b) { return combine(Operation::add, a, b); }
  friend Factor operator-(const Factor& a, const Factor& b) { return combine(Operation::subtract, a, b); }
  friend Factor sign_of(const Factor& a) { return a.through(Operation::sign); }
  friend Factor less(const Factor& a, const Factor& b) { return combine(Operation::less, a, b); }
  friend Factor when(const Factor& a, const Factor& b) { return combine(Operation::when, a, b); }
  ///@}
  /// @cond
#define AVI_ONE(name, ...)                                                                                   \
  friend Factor name(const Factor& a) { return a.through(Operation::name); }
#define AVI_TWO(name, ...)                                                                                   \
  friend Factor name(const Factor& a, const Factor& b) { return combine(Operation::name, a, b); }
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  /// @endcond

  /// The reciprocal, from a quotient that the formula already has, unless that leaves the range of numbers
  /// long before 1 / b does, or its products with the numerator do. Between 1e-284 and 1e284 it makes no
  /// difference.
  [[nodiscard]] Factor reciprocal() const {
    if (node < 0) return {1.0 / number, -1, graph};
    int quotient = graph->quotient(node);
    if (quotient >= 0) {
      const double numerator = (*graph)[(*graph)[quotient].a].number, size = std::abs(numerator);
      if (size >= 0x1p-80 && size <= 0x1p80) return {1.0 / numerator / number, quotient, graph};
    }
    quotient = graph->binary(Operation::divide, graph->constant(1.0), node);
    return {1.0 / number, quotient, graph};
  }

 private:
  Factor(double value, int of, ExpressionGraph* where) : number(value), node(of), graph(where) {}

  [[nodiscard]] Factor through(Operation operation) const {
    if (node < 0) return {evaluate(operation, number, 0.0), -1, graph};
    return {*graph, graph->unary(operation, in(*graph))};
  }
  static Factor combine(Operation operation, const Factor& a, const Factor& b) {
    ExpressionGraph* const graph = a.graph ? a.graph : b.graph;
    if (a.node < 0 && b.node < 0) return {evaluate(operation, a.number, b.number), -1, graph};
    const int left = a.in(*graph), right = b.in(*graph);
    return {*graph, graph->binary(operation, left, right)};
  }
};

/// The length of which u is a power of this degree, \f$|u|^{1/d}\f$; u of degree 2 is taken as positive.
inline Factor length_from(const Factor& u, double degree) {
  if (degree == 2.0) return sqrt(u);
  if (degree == 1.0) return abs(u);
  return {*u.graph, u.graph->power(abs(u).in(*u.graph), 1.0 / degree)};
}

}  // namespace avi::detail
