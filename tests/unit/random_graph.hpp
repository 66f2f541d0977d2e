#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

/// Graphs drawn at random, and their values node by node, without anything of the library that evaluates.
namespace random_graph {

using avi::ExpressionGraph, avi::Operation;

/// Every operation that a node may be, arguments and numbers aside.
inline std::vector<Operation> operations() {
  std::vector<Operation> all;
  for (int i = 0; i < static_cast<int>(Operation::nothing); ++i)
    if (const auto operation = static_cast<Operation>(i);
        operation != Operation::input && operation != Operation::constant)
      all.push_back(operation);
  return all;
}

/// What the standard library makes of it.
inline double by_hand(Operation operation, double a, double b) {
  using enum Operation;
  switch (operation) {
#define AVI_ONE(name, ...)                                                                                   \
  case name:                                                                                                 \
    return std::name(a);
#define AVI_TWO(name, ...)                                                                                   \
  case name:                                                                                                 \
    return std::name(a, b);
    AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
  case add:
    return a + b;
  case subtract:
    return a - b;
  case subtract_from:
    return b - a;
  case multiply:
    return a * b;
  case divide:
    return a / b;
  case power:
    return avi::power(a, b);
  case sign:
    return a == 0.0 ? 0.0 : std::signbit(a) ? -1.0 : 1.0;
  case less:
    return a < b ? 1.0 : 0.0;
  case less_equal:
    return a <= b ? 1.0 : 0.0;
  case when:
    return a > 0.0 ? b : 0.0;
  case nothing:
    return a;
  case input:
  case constant:
  case sum_of_products:
    break;
  }
  throw std::logic_error("no operation");
}

/// The value of every node.
inline std::vector<double> values(const ExpressionGraph& graph, const std::vector<double>& x) {
  std::vector<double> all;
  for (int i = 0; i < graph.size(); ++i) {
    const ExpressionGraph::Node& node = graph[i];
    if (node.operation == Operation::input)
      all.push_back(x[node.a]);
    else if (node.operation == Operation::constant)
      all.push_back(node.number);
    else
      all.push_back(by_hand(node.operation, all[node.a], node.b < 0 ? 0.0 : all[node.b]));
  }
  return all;
}

/// Sums and products mostly, also of hundreds of terms, and every other operation now and then; results are
/// used once more often than not. Without signs, which differ where one NaN has another sign than the next.
inline ExpressionGraph draw(std::mt19937& random, int inputs, const std::vector<Operation>& without = {}) {
  std::vector<Operation> among;
  for (const Operation operation : operations())
    if (operation != Operation::sign && std::find(without.begin(), without.end(), operation) == without.end())
      among.push_back(operation);
  ExpressionGraph graph(inputs);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto some = [&] {
    if (below(12) == 0) return graph.constant(0.25 * (below(17) - 8));
    return below(2) ? below(graph.size()) : graph.size() - 1 - below(std::min(graph.size(), 6));
  };
  const int count = 4 + below(500);
  for (int i = 0; i < count; ++i) {
    const int kind = below(16);
    if (kind < 5) {
      graph.binary(Operation::add, some(), some());
    } else if (kind < 8) {
      graph.binary(Operation::subtract, some(), some());
    } else if (kind < 12) {
      graph.binary(Operation::multiply, some(), some());
    } else if (kind == 12 && below(4) == 0) {
      int sum = some();
      for (int terms = below(120); terms > 0; --terms) {
        const int term = below(3) ? graph.binary(Operation::multiply, some(), some()) : some();
        const Operation sign = below(3) ? Operation::add : Operation::subtract;
        sum = below(8) ? graph.binary(sign, sum, term) : graph.binary(sign, term, sum);
      }
    } else {
      const Operation operation = among[below(static_cast<int>(among.size()))];
      if (operation == Operation::power)
        graph.power(some(), 0.25 * (below(41) - 20));
      else if (avi::detail::operands(operation) == 1)
        graph.unary(operation, some());
      else
        graph.binary(operation, some(), some());
    }
  }
  return graph;
}

/// The same bits, or neither a number.
inline bool alike(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace random_graph
