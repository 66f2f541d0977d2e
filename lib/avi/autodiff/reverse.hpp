#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

/// @file
/// Reverse accumulation on the graph: the gradient of a recorded formula as further operations of it.

namespace avi {

/// Writes the gradient of a node into its graph. With \f$\bar z = \partial f/\partial z\f$ for each
/// intermediate result z, \f$\bar z = \sum_u \bar u\,\partial u/\partial z\f$ over the operations u that use
/// z (Griewank and Walther 2008, Section 3.2): one sum for each z over its uses, so all derivatives together
/// cost a small multiple of f. Constant factors are kept apart from the nodes and multiplied in where that
/// saves operations.
class Reverse {
 public:
  /// Of `graph`, which grows.
  explicit Reverse(ExpressionGraph& graph) : graph_(graph) {}

  /// The nodes of df/d(input i) for i = 0, 1, ... @param inner an intermediate result that is taken for a
  /// constant; the node of df/d(inner) then comes last
  std::vector<int> gradient(int f, int inner = -1) {
    const int end = f + 1;
    parts_.assign(end, {});
    parts_[f].push_back({1.0, -1});
    std::vector<int> slopes(graph_.inputs() + (inner >= 0 ? 1 : 0), graph_.constant(0.0));
    for (int node = f; node >= 0; --node) {
      if (parts_[node].empty()) continue;
      const Term bar = total(node);
      const ExpressionGraph::Node what = graph_[node];  // a copy: the graph grows
      if (node == inner)
        slopes.back() = materialised(bar);
      else if (what.operation == Operation::input)
        slopes[what.a] = materialised(bar);
      else
        pass_on(node, what, bar);
    }
    return slopes;
  }

 private:
  /// A number times a node; the number alone where the node is -1.
  struct Term {
    double factor;
    int node;
  };

  [[nodiscard]] Term term(int node) const {
    return graph_.is_constant(node) ? Term{graph_[node].number, -1} : Term{1.0, node};
  }
  static Term scaled(double factor, const Term& x) { return {factor * x.factor, x.node}; }
  Term times(const Term& a, const Term& b) {
    const double factor = a.factor * b.factor;
    if (a.node < 0 || b.node < 0) return {factor, a.node < 0 ? b.node : a.node};
    return {factor, graph_.binary(Operation::multiply, a.node, b.node)};
  }
  int materialised(const Term& a) {
    const int factor = graph_.constant(a.factor);
    return a.node < 0 ? factor : graph_.binary(Operation::multiply, factor, a.node);
  }
  /// 1/b, from a quotient that the formula has where there is one.
  Term reciprocal(int b) {
    if (graph_.is_constant(b)) return {1.0 / graph_[b].number, -1};
    int quotient = graph_.quotient(b);
    if (quotient >= 0) {
      const double factor = 1.0 / graph_[graph_[quotient].a].number;
      if (std::isfinite(factor)) return {factor, quotient};
    }
    quotient = graph_.binary(Operation::divide, graph_.constant(1.0), b);
    return {1.0, quotient};
  }

  /// The sum of all that was passed on to `node`.
  Term total(int node) {
    std::vector<Term>& parts = parts_[node];
    double scale = 0.0;  // of the first part that is not a number
    for (const Term& part : parts)
      if (part.node >= 0 && scale == 0.0) scale = part.factor;
    double numbers = 0.0;
    int sum = -1;
    for (const Term& part : parts) {
      if (part.node < 0) {
        numbers += part.factor;
      } else if (sum < 0) {
        sum = part.node;
      } else {
        const double ratio = part.factor / scale;
        if (ratio == -1.0)
          sum = graph_.binary(Operation::subtract, sum, part.node);
        else
          sum = graph_.binary(Operation::add, sum, materialised({ratio, part.node}));
      }
    }
    parts = {};
    if (sum < 0) return {numbers, -1};
    if (numbers != 0.0) sum = graph_.binary(Operation::add, sum, graph_.constant(numbers / scale));
    // What is passed on to two operands is multiplied by its factor once, here, unless that is a power of 2.
    const Operation use = graph_[node].operation;
    int exponent = 0;
    if ((use == Operation::add || use == Operation::subtract) &&
        std::abs(std::frexp(scale, &exponent)) != 0.5)
      return {1.0, materialised({scale, sum})};
    return {scale, sum};
  }

  void give(int node, const Term& part) {
    if (!graph_.is_constant(node) && part.factor != 0.0) parts_[node].push_back(part);
  }

  /// Passes bar on to the operands of a node, times the derivatives of its operation.
  void pass_on(int node, const ExpressionGraph::Node& what, const Term& bar) {
    const int a = what.a, b = what.b;
    const auto self = term(node);
    switch (what.operation) {
    case Operation::add:
      give(a, bar);
      give(b, bar);
      break;
    case Operation::subtract:
      give(a, bar);
      give(b, scaled(-1.0, bar));
      break;
    case Operation::multiply:
      if (a == b) {
        give(a, scaled(2.0, times(bar, term(a))));
      } else {
        give(a, times(bar, term(b)));
        give(b, times(bar, term(a)));
      }
      break;
    case Operation::divide: {
      const Term inverse = times(bar, reciprocal(b));
      give(a, inverse);
      if (!graph_.is_constant(b)) give(b, scaled(-1.0, times(inverse, self)));
      break;
    }
    case Operation::sqrt:
      give(a, scaled(0.5, times(bar, reciprocal(node))));
      break;
    case Operation::power: {
      const double exponent = graph_[b].number;
      if (exponent >= 1.0)  // finite at a = 0, too
        give(a, scaled(exponent, times(bar, term(graph_.power(a, exponent - 1.0)))));
      else
        give(a, scaled(exponent, times(bar, times(self, reciprocal(a)))));
      break;
    }
    case Operation::constant:
    case Operation::sign:
      break;
    default:
      give(a, times(bar, slope(node, what.operation, a)));
    }
  }
  /// df/da of the node f(a).
  Term slope(int f, Operation operation, int a) {
    using Op = Operation;
    if (operation == Op::exp) return term(f);
    if (operation == Op::log) return reciprocal(a);
    if (operation == Op::sin) return term(graph_.unary(Op::cos, a));
    if (operation == Op::cos) return scaled(-1.0, term(graph_.unary(Op::sin, a)));
    if (operation == Op::tan) return one_with_square(Op::add, f);
    if (operation == Op::sinh) return term(graph_.unary(Op::cosh, a));
    if (operation == Op::cosh) return term(graph_.unary(Op::sinh, a));
    if (operation == Op::tanh) return one_with_square(Op::subtract, f);
    if (operation == Op::atan) return reciprocal(one_with_square(Op::add, a).node);
    return term(graph_.unary(Op::sign, a));  // abs
  }
  /// 1 + z^2 or 1 - z^2.
  Term one_with_square(Operation operation, int z) {
    const int square = graph_.binary(Operation::multiply, z, z);
    return term(graph_.binary(operation, graph_.constant(1.0), square));
  }

  ExpressionGraph& graph_;
  std::vector<std::vector<Term>> parts_;
};

}  // namespace avi
