#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <map>
#include <vector>

/// @file
/// A recorded formula as a sum of terms.

namespace experiment {

using avi::ExpressionGraph, avi::Operation;

/// The terms of a formula: sums are taken apart, products of sums and quotients of a sum multiplied out,
/// equal terms collected. Sums of the first degree (differences of coordinates) stay together in a product,
/// so that translations leave the terms what they are. What would give more than `most` terms stays a
/// product.
class Terms {
 public:
  /// A number times a node.
  struct Term {
    double factor;
    int node;
  };

  /// Of `node` in a graph, which grows. Terms that are numbers are left out.
  static std::vector<Term> of(ExpressionGraph& graph, int node) {
    Terms terms(graph, node);
    std::vector<Term> result;
    for (const auto& [term, factor] : terms.sum(node))
      if (!graph.is_constant(term) && factor != 0.0) result.push_back({factor, term});
    return result;
  }

 private:
  using Sum = std::map<int, double>;  // the factor of each node
  static constexpr std::size_t most = 64;

  Terms(ExpressionGraph& graph, int last)
      : graph_(graph), linear_(last + 1), sums_(last + 1), one_(graph.constant(1.0)) {
    for (int i = 0; i <= last; ++i) {
      const auto& [operation, a, b, number] = graph[i];
      using Op = Operation;
      linear_[i] = operation == Op::input || operation == Op::constant ||
                   ((operation == Op::add || operation == Op::subtract) && linear_[a] && linear_[b]) ||
                   (operation == Op::multiply && linear_[a] && linear_[b] &&
                    (graph.is_constant(a) || graph.is_constant(b))) ||
                   (operation == Op::divide && linear_[a] && graph.is_constant(b));
    }
  }

  /// Each node once: formulas share their parts.
  const Sum& sum(int node) {
    if (sums_[node].empty()) sums_[node] = take_apart(node);
    return sums_[node];
  }
  Sum take_apart(int node) {
    const ExpressionGraph::Node what = graph_[node];  // a copy: the graph grows
    switch (what.operation) {
    case Operation::constant:
      return {{one_, what.number}};
    case Operation::add:
    case Operation::subtract: {
      Sum both = sum(what.a);
      for (const auto& [term, factor] : sum(what.b))
        both[term] += what.operation == Operation::add ? factor : -factor;
      return both;
    }
    case Operation::multiply:
      if (graph_.is_constant(what.a) || graph_.is_constant(what.b))
        return combined(node, sum(what.a), sum(what.b), what.operation);
      return combined(node, factor(what.a), factor(what.b), what.operation);
    case Operation::divide:
      if (!graph_.is_constant(what.b)) return combined(node, factor(what.a), {{what.b, 1.0}}, what.operation);
      return combined(node, sum(what.a), {{one_, 1.0 / graph_[what.b].number}}, Operation::multiply);
    default:
      return {{node, 1.0}};
    }
  }
  Sum factor(int node) { return linear_[node] && !graph_.is_constant(node) ? Sum{{node, 1.0}} : sum(node); }

  Sum combined(int node, const Sum& left, const Sum& right, Operation operation) {
    if (left.size() * right.size() > most) return {{node, 1.0}};
    Sum all;
    for (const auto& [a, x] : left)
      for (const auto& [b, y] : right)
        all[graph_.binary(operation, a, b)] += x * y;
    return all;
  }

  ExpressionGraph& graph_;
  std::vector<char> linear_;  // of the first degree in the inputs
  std::vector<Sum> sums_;     // of the nodes that were taken apart; the others are empty
  int one_;
};

}  // namespace experiment
