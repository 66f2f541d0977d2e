#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

/// @file
/// From nodes of a graph to lines of a program: drops nodes that are not needed, and joins products with the
/// sums that use them.

namespace avi::detail {

/// One line of a program before it is placed.
struct Line {
  Operation first;   ///< The operation on the first two operands.
  Operation second;  ///< The operation on that result and a third operand, or none.
  int result;        ///< Number of the result: a node, or beyond them a partial sum.
  int begin;         ///< Its first operand in those of all lines.
  int count;         ///< Number of its operands; of pairs for a sum of products.
  int key = -1;      ///< Lines of smaller keys come first.
};

/// Lines for the nodes that some results need. A product that only one sum uses becomes part of it, and a
/// long sum, added from the left, is one line (or several of at most `longest` products). Multiplying by 1 or
/// -1 is exact, and every product and sum is still rounded by itself: the results are the same to the last
/// bit.
class Fusion {
 public:
  /// The lines of `graph`. @param recorded nodes before this one keep their order; the others come as soon as
  /// their operands are there
  Fusion(const ExpressionGraph& graph, const std::vector<int>& results, int recorded)
      : graph_(graph), nodes_(graph.size()), recorded_(recorded), uses_(nodes_, 0), absorbed_(nodes_, 0),
        sum_of_(nodes_, -1), keys_(nodes_, -1) {
    count_uses(results);
    count_additions();
    for (int node = nodes_ - 1; node >= 0; --node)
      if (needed(node)) {
        if (additions_[node] >= shortest)
          plan_sum(node);
        else if (pairs(operation(node)))
          plan_pair(node);
      }
    one_ = constant(1.0);
    first_partial_ = next_ = nodes_ + numbers_.size();
    keys_.resize(next_, -1);
    const auto most = static_cast<std::size_t>(nodes_);
    lines_.reserve(most);
    operands_.reserve(3 * most);
    for (int node = 0; node < nodes_; ++node)
      if (needed(node)) write(node);
  }

  [[nodiscard]] int results() const { return next_; }  ///< All of their numbers are below this one.
  /// Number of the operands of all lines.
  [[nodiscard]] std::size_t operand_count() const { return operands_.size(); }
  /// That result is a number, of the graph or one that lines need.
  [[nodiscard]] bool is_constant(int result) const {
    return result < nodes_ ? graph_.is_constant(result) : result < first_partial_;
  }
  /// Such a number.
  [[nodiscard]] double number(int result) const {
    return result < nodes_ ? graph_[result].number : numbers_[result - nodes_].number;
  }
  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }  ///< In an order that can be run.
  /// The operands of a line: numbers of results, inputs or constants.
  [[nodiscard]] std::span<const int> operands(const Line& line) const {
    return {operands_.data() + line.begin, static_cast<std::size_t>(line.count)};
  }

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
  void count_additions() {
    additions_.assign(nodes_, 0);
    for (int node = 0; node < nodes_; ++node)
      if (needed(node) && is_sum(node)) {
        const int inner = inner_sum(node);
        additions_[node] = 1 + (inner >= 0 ? additions_[inner] : 0);
      }
  }
  /// The operand of a sum that is itself a sum and serves nothing else, or -1. Of two, the longer one.
  [[nodiscard]] int inner_sum(int node) const {
    const int a = graph_[node].a, b = graph_[node].b;
    const auto joins = [&](int x) { return uses_[x] == 1 && is_sum(x); };
    const bool left = joins(a), right = operation(node) == Operation::add && joins(b);
    if (left && right) return additions_[a] >= additions_[b] ? a : b;
    return left ? a : right ? b : -1;
  }

  void plan_sum(int root) {
    int node = root;
    sum_of_[root] = static_cast<int>(products_.size());
    for (;;) {
      const int a = graph_[node].a, b = graph_[node].b, inner = inner_sum(node);
      const bool add = operation(node) == Operation::add;
      products_.push_back(product(add && inner == b ? a : b, add));
      if (inner < 0) {
        products_.push_back(product(a, true));
        break;
      }
      absorbed_[inner] = true;
      node = inner;
    }
    std::reverse(products_.begin() + sum_of_[root], products_.end());
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
          return {constant(-graph_[number].number), other};
        }
    }
    return {constant(positive ? 1.0 : -1.0), x};
  }
  /// A sum or product takes in one operand that is a sum or product and serves nothing else.
  void plan_pair(int node) {
    for (const int x : {graph_[node].b, graph_[node].a})
      if (uses_[x] == 1 && pairs(operation(x)) && additions_[x] < shortest) {
        absorbed_[x] = true;
        return;
      }
  }

  void write(int node) {
    if (sum_of_[node] >= 0) return write_sum(node);
    const ExpressionGraph::Node& what = graph_[node];
    const int key = node < recorded_ ? node : -1;
    if (pairs(what.operation))
      for (const bool last : {true, false}) {
        const int x = last ? what.b : what.a;
        if (!absorbed_[x]) continue;
        operands_.insert(operands_.end(), {graph_[x].a, graph_[x].b, last ? what.a : what.b});
        const bool from = last && what.operation == Operation::subtract;
        return write(operation(x), from ? Operation::subtract_from : what.operation, node, key);
      }
    operands_.push_back(what.a);
    if (what.b >= 0) operands_.push_back(what.b);
    write(what.operation, Operation::nothing, node, key);
  }
  void write_sum(int node) {
    const int end = sum_of_[node] + additions_[node] + 1;
    for (int i = sum_of_[node]; i < end; ++i) {
      if (operands_.size() - written_ == 2 * longest) {
        const int partial = next_++;
        keys_.push_back(-1);
        write(Operation::sum_of_products, Operation::nothing, partial, -1);
        operands_.insert(operands_.end(), {one_, partial});
      }
      operands_.insert(operands_.end(), {products_[i].first, products_[i].second});
    }
    write(Operation::sum_of_products, Operation::nothing, node, node < recorded_ ? node : -1);
  }
  /// A line with the operands since the last one.
  void write(Operation first, Operation second, int result, int key) {
    const std::size_t begin = std::exchange(written_, operands_.size());
    for (std::size_t i = begin; i < operands_.size(); ++i)
      key = std::max(key, keys_[operands_[i]]);
    keys_[result] = key;
    lines_.push_back({.first = first,
                      .second = second,
                      .result = result,
                      .begin = static_cast<int>(begin),
                      .count = static_cast<int>(operands_.size() - begin),
                      .key = key});
  }

  int constant(double number) {
    const int known = graph_.find_constant(number);
    return known >= 0 ? known : nodes_ + numbers_.constant(number);
  }

  const ExpressionGraph& graph_;
  ExpressionGraph numbers_{0};  // behind the nodes of the graph
  int nodes_, recorded_;
  std::vector<int> uses_;
  std::vector<char> absorbed_;
  std::vector<int> additions_;  // for each sum, those that would be one line with it
  std::vector<int> sum_of_;     // of each node that is a long sum the first of its products, else -1
  std::vector<std::pair<int, int>> products_;
  std::vector<int> keys_;  // of each result; inputs and numbers are there from the start
  std::vector<Line> lines_;
  std::vector<int> operands_;
  std::size_t written_ = 0;           // operands of the lines so far
  int first_partial_ = 0, next_ = 0;  // numbers of partial sums
  int one_ = -1;
};

}  // namespace avi::detail
