#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

/// @file
/// From nodes of a graph to lines of a program: drops nodes that are not needed, and joins products with the
/// sums that use them.

namespace avi {

/// One line of a program before it is placed.
struct Line {
  Operation first;            ///< What is done with the first two operands.
  Operation second;           ///< What is done with that result and a third one, if anything.
  int result;                 ///< Number of the result: a node, or beyond them a partial sum.
  std::vector<int> operands;  ///< Numbers of results, inputs or constants; pairs for a sum of products.
  int key = -1;               ///< Lines of smaller keys come first.
};

/// Lines for the nodes that some results need. A product that only one sum uses becomes part of it, and a
/// long sum, added from the left, is one line (or several of at most `longest` products). Multiplying by 1 or
/// -1 is exact, and every product and sum is still rounded by itself: the results are the same to the last
/// bit.
class Fusion {
 public:
  /// Of `graph`, which gets the numbers that lines need. @param recorded nodes before this one keep their
  /// order; the others come as soon as their operands are there
  Fusion(ExpressionGraph& graph, const std::vector<int>& results, int recorded)
      : graph_(graph), nodes_(graph.size()), recorded_(recorded), uses_(nodes_, 0), absorbed_(nodes_, false),
        keys_(nodes_, -1) {
    count_uses(results);
    const std::vector<int> additions = count_additions();
    for (int node = nodes_ - 1; node >= 0; --node)
      if (needed(node)) {
        if (additions[node] >= shortest)
          plan_sum(node, additions);
        else if (detail::pairs(operation(node)))
          plan_pair(node, additions);
      }
    one_ = graph_.constant(1.0);
    next_ = graph_.size();
    keys_.resize(next_, -1);
    for (int node = 0; node < nodes_; ++node)
      if (needed(node)) write(node);
  }

  [[nodiscard]] int results() const { return next_; }  ///< All of their numbers are below this one.
  [[nodiscard]] std::vector<Line> lines() && { return std::move(lines_); }  ///< In an order that can be run.

 private:
  static constexpr int shortest = 3;  ///< Additions that make a sum long.
  static constexpr int longest = 32;

  [[nodiscard]] Operation operation(int node) const { return graph_[node].operation; }
  [[nodiscard]] bool is_sum(int node) const {
    return operation(node) == Operation::add || operation(node) == Operation::subtract;
  }
  /// It is computed, and by a line of its own.
  [[nodiscard]] bool needed(int node) const {
    return uses_[node] > 0 && !absorbed_[node] && operation(node) != Operation::input &&
           !graph_.is_constant(node);
  }

  void count_uses(const std::vector<int>& results) {
    for (const int result : results)
      ++uses_[result];
    for (int node = nodes_ - 1; node >= 0; --node)
      if (needed(node)) {
        ++uses_[graph_[node].a];
        if (graph_[node].b >= 0) ++uses_[graph_[node].b];
      }
  }
  /// For each sum, the additions that would be one line with it.
  [[nodiscard]] std::vector<int> count_additions() const {
    std::vector<int> additions(nodes_, 0);
    for (int node = 0; node < nodes_; ++node)
      if (needed(node) && is_sum(node)) {
        const int inner = inner_sum(node, additions);
        additions[node] = 1 + (inner >= 0 ? additions[inner] : 0);
      }
    return additions;
  }
  /// The operand of a sum that is itself a sum and serves nothing else, or -1. Of two, the longer one.
  [[nodiscard]] int inner_sum(int node, const std::vector<int>& additions) const {
    const int a = graph_[node].a, b = graph_[node].b;
    const auto joins = [&](int x) { return uses_[x] == 1 && is_sum(x); };
    const bool left = joins(a), right = operation(node) == Operation::add && joins(b);
    if (left && right) return additions[a] >= additions[b] ? a : b;
    return left ? a : right ? b : -1;
  }

  void plan_sum(int root, const std::vector<int>& additions) {
    std::vector<std::pair<int, int>>& products = sums_[root];  // the last one first
    int node = root;
    for (;;) {
      const int a = graph_[node].a, b = graph_[node].b, inner = inner_sum(node, additions);
      const bool add = operation(node) == Operation::add;
      products.push_back(product(add && inner == b ? a : b, add));
      if (inner < 0) {
        products.push_back(product(a, true));
        break;
      }
      absorbed_[inner] = true;
      node = inner;
    }
    std::reverse(products.begin(), products.end());
  }
  /// +x or -x as a product.
  std::pair<int, int> product(int x, bool positive) {
    if (uses_[x] == 1 && operation(x) == Operation::multiply) {
      const int a = graph_[x].a, b = graph_[x].b;
      if (positive) {
        absorbed_[x] = true;
        return {a, b};
      }
      for (const auto& [number, other] : {std::pair{a, b}, std::pair{b, a}})
        if (graph_.is_constant(number)) {
          absorbed_[x] = true;
          return {graph_.constant(-graph_[number].number), other};
        }
    }
    return {graph_.constant(positive ? 1.0 : -1.0), x};
  }
  /// A sum or product takes in one operand that is a sum or product and serves nothing else.
  void plan_pair(int node, const std::vector<int>& additions) {
    for (const int x : {graph_[node].b, graph_[node].a})
      if (uses_[x] == 1 && detail::pairs(operation(x)) && additions[x] < shortest) {
        absorbed_[x] = true;
        return;
      }
  }

  void write(int node) {
    if (const auto sum = sums_.find(node); sum != sums_.end()) return write_sum(node, sum->second);
    const ExpressionGraph::Node& what = graph_[node];
    Line line{.first = what.operation, .second = Operation::nothing, .result = node, .operands = {what.a}};
    if (what.b >= 0) line.operands.push_back(what.b);
    for (const bool last : {true, false}) {
      const int x = last ? what.b : what.a;
      if (!detail::pairs(what.operation) || !absorbed_[x]) continue;
      line.first = operation(x);
      line.second = last && what.operation == Operation::subtract ? Operation::subtract_from : what.operation;
      line.operands = {graph_[x].a, graph_[x].b, last ? what.a : what.b};
      break;
    }
    write(std::move(line), node < recorded_ ? node : -1);
  }
  void write_sum(int node, const std::vector<std::pair<int, int>>& products) {
    std::vector<int> operands;
    for (const auto& [a, b] : products) {
      if (operands.size() == 2 * longest) {
        const int partial = next_++;
        keys_.push_back(-1);
        write({Operation::sum_of_products, Operation::nothing, partial, std::move(operands)}, -1);
        operands = {one_, partial};
      }
      operands.push_back(a);
      operands.push_back(b);
    }
    write({Operation::sum_of_products, Operation::nothing, node, std::move(operands)},
          node < recorded_ ? node : -1);
  }
  void write(Line line, int key) {
    for (const int operand : line.operands)
      key = std::max(key, keys_[operand]);
    keys_[line.result] = line.key = key;
    lines_.push_back(std::move(line));
  }

  ExpressionGraph& graph_;
  int nodes_, recorded_;
  std::vector<int> uses_;
  std::vector<bool> absorbed_;
  std::vector<int> keys_;  // of each result; inputs and numbers are there from the start
  std::map<int, std::vector<std::pair<int, int>>> sums_;
  std::vector<Line> lines_;
  int next_ = 0;  // number of the next partial sum
  int one_ = -1;
};

}  // namespace avi
