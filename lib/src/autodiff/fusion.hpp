#pragma once
#include "avi/autodiff/expression_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

/// @file
/// The lines of a program, made from the nodes of a graph: nodes that are not needed are dropped, and
/// products are joined with the sums that use them.

namespace avi::detail {

/// One line of a program before it is placed.
struct Line {
  Operation first;   ///< The operation on the first two operands.
  Operation second;  ///< The operation on that result and a third operand, or none.
  int result;        ///< Number of the result: a node or, beyond the nodes, a partial sum.
  int begin;         ///< Number of its first operand among those of all lines.
  int count;         ///< Number of its operands, two for each product of a sum.
};

/// An operand of lines: a node, or a number or partial sum that lines need beside the nodes.
struct Operand {
  int uses = 0;       ///< Number of uses as an operand, plus one for each time that it is asked for.
  int additions = 0;  ///< For a sum, the number of additions that would be one line with it.
  int key = -1;       ///< The last recorded node that it needs, itself included; none for inputs and numbers.
  int line = -1;      ///< The line that computes it; none for inputs and numbers.
  int slot = -1;      ///< Slot in the program, once that is known.
};

/// The lines for the nodes that some results need. A product that only one sum uses becomes part of it. A
/// long sum, added from the left, is one line, or several of at most `longest` products. Multiplication by 1
/// or -1 is exact, and every product and sum is still rounded by itself, so the results are the same to the
/// last bit.
class Fusion {
 public:
  /// Makes the lines of `graph`. @param recorded nodes before this one keep their order; the others come as
  /// soon as their operands are known
  Fusion(const ExpressionGraph& graph, const std::vector<int>& asked, int recorded)
      : graph_(graph), nodes_(graph.inputs()) {
    for (const int node : asked)
      nodes_ = std::max(nodes_, node + 1);
    recorded_ = std::min(recorded, nodes_);
    results_.reserve(static_cast<std::size_t>(nodes_) + nodes_ / 8 + 2);
    results_.resize(nodes_);
    const std::vector<int> needed = find_needed(asked);
    count_additions(needed);
    operands_.reserve(3 * needed.size());
    written_.reserve(needed.size());
    for (const int node : needed)
      if (results_[node].uses > 0) write(node);
    sort();
  }

  /// The lines in an order in which they can run: by keys, and for equal keys as they are in the graph.
  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  /// The operands of a line: numbers of results, inputs or constants.
  [[nodiscard]] std::span<const int> operands(const Line& line) const {
    return {operands_.data() + line.begin, static_cast<std::size_t>(line.count)};
  }
  /// Number of the operands of all lines.
  [[nodiscard]] std::size_t operand_count() const { return operands_.size(); }
  /// A bound above all numbers of results.
  [[nodiscard]] int results() const { return static_cast<int>(results_.size()); }
  [[nodiscard]] Operand& operator[](int result) { return results_[result]; }  ///< Data of a result.
  /// Returns true if a result is a number, of the graph or one that lines need.
  [[nodiscard]] bool is_constant(int result) const {
    return result < nodes_ ? graph_.is_constant(result) : more_.is_constant(result - nodes_);
  }
  /// Value of such a number.
  [[nodiscard]] double number(int result) const {
    return result < nodes_ ? graph_[result].number : more_[result - nodes_].number;
  }

 private:
  static constexpr int shortest = 3;  ///< Least number of additions in a long sum.
  static constexpr int longest = 32;

  [[nodiscard]] Operation operation(int node) const { return graph_[node].operation; }
  [[nodiscard]] bool is_sum(int node) const {
    return operation(node) == Operation::add || operation(node) == Operation::subtract;
  }

  /// Finds the nodes that are computed, from the last one to the first.
  std::vector<int> find_needed(const std::vector<int>& asked) {
    std::vector<int> needed;
    needed.reserve(nodes_);
    for (const int node : asked)
      ++results_[node].uses;
    for (int node = nodes_ - 1; node >= 0; --node) {
      if (results_[node].uses == 0) continue;
      const auto& [operation, a, b, number] = graph_[node];
      if (operation == Operation::input || operation == Operation::constant) continue;
      needed.push_back(node);
      ++results_[a].uses;
      if (b >= 0) ++results_[b].uses;
    }
    return needed;
  }
  void count_additions(const std::vector<int>& needed) {
    for (std::size_t i = needed.size(); i-- > 0;)
      if (const int node = needed[i]; is_sum(node)) {
        const int inner = inner_sum(node);
        results_[node].additions = 1 + (inner >= 0 ? results_[inner].additions : 0);
      }
  }
  /// The operand of a sum that is itself a sum and has no other use, or -1. Of two, the longer one.
  [[nodiscard]] int inner_sum(int node) const {
    const auto& [operation, a, b, number] = graph_[node];
    const auto joins = [&](int x) { return results_[x].uses == 1 && is_sum(x); };
    const bool left = joins(a), right = operation == Operation::add && joins(b);
    if (left && right) return results_[a].additions >= results_[b].additions ? a : b;
    return left ? a : right ? b : -1;
  }

  /// Writes the line of a node, after the lines of all nodes that use it. Nodes that it takes in get no line
  /// of their own.
  void write(int node) {
    if (results_[node].additions >= shortest) return write_sum(node);
    const auto& [operation, a, b, number] = graph_[node];
    if (pairs(operation)) {
      if (joins_pair(b))
        return write_pair(b, operation == Operation::subtract ? Operation::subtract_from : operation, a,
                          node);
      if (joins_pair(a)) return write_pair(a, operation, b, node);
    }
    written_.push_back({operation, Operation::nothing, node, end(), b < 0 ? 1 : 2});
    operands_.push_back(a);
    if (b >= 0) operands_.push_back(b);
  }
  /// Returns true if a sum or product can take in this operand: a sum or product that has no other use.
  [[nodiscard]] bool joins_pair(int x) const {
    return results_[x].uses == 1 && pairs(operation(x)) && results_[x].additions < shortest;
  }
  void write_pair(int inner, Operation second, int other, int node) {
    results_[inner].uses = 0;
    const auto& [first, a, b, number] = graph_[inner];
    written_.push_back({first, second, node, end(), 3});
    operands_.push_back(a);
    operands_.push_back(b);
    operands_.push_back(other);
  }
  /// Writes the products of a long sum, from the last one to the first. Each of its lines but the first
  /// begins with the sum so far.
  void write_sum(int root) {
    const int additions = results_[root].additions, begin = end();
    int first = additions + 1 + (additions - 1) / (longest - 1), last = first, result = root;
    operands_.resize(operands_.size() + 2 * static_cast<std::size_t>(first));
    const auto put = [&](const std::pair<int, int>& product) {
      const int place = begin + 2 * --first;
      operands_[place] = product.first;
      operands_[place + 1] = product.second;
      if (first % longest != 0) return;
      written_.push_back({Operation::sum_of_products, Operation::nothing, result, place, 2 * (last - first)});
      last = first;
    };
    for (int node = root;;) {
      const auto& [operation, a, b, number] = graph_[node];
      const int inner = inner_sum(node);
      const bool add = operation == Operation::add;
      put(product(add && inner == b ? a : b, add));
      if (inner < 0) return put(product(a, true));
      if ((first - 1) % longest == 0) {
        const int partial = numbered(more_.late_input(), 1);
        put({unit(true), partial});
        result = partial;
      }
      results_[inner].uses = 0;
      node = inner;
    }
  }
  /// Returns +x or -x as a product.
  std::pair<int, int> product(int x, bool positive) {
    if (results_[x].uses == 1 && operation(x) == Operation::multiply) {
      const int a = graph_[x].a, b = graph_[x].b;
      if (positive) {
        results_[x].uses = 0;
        return {a, b};
      }
      for (const auto& [number, other] : {std::pair{a, b}, std::pair{b, a}})
        if (graph_.is_constant(number)) {
          results_[x].uses = 0;
          return {constant(-graph_[number].number), other};
        }
    }
    return {unit(positive), x};
  }
  [[nodiscard]] int end() const { return static_cast<int>(operands_.size()); }

  int constant(double number) {
    const int known = graph_.find_constant(number);
    return known >= 0 && known < nodes_ ? known : numbered(more_.constant(number), 0);
  }
  /// The number 1 or -1.
  int unit(bool positive) {
    int& known = units_[positive];
    if (known < 0) known = constant(positive ? 1.0 : -1.0);
    return known;
  }
  /// Returns a node of `more_` as a result.
  int numbered(int node, int uses) {
    if (nodes_ + node == results()) results_.push_back({.uses = uses});
    return nodes_ + node;
  }

  /// Sorts the lines, which were written from the last one to the first, by their keys.
  void sort() {
    std::vector<int> next(static_cast<std::size_t>(recorded_) + 2, 0);  // place of a line with each key
    for (std::size_t i = written_.size(); i-- > 0;) {
      const Line& line = written_[i];
      int key = line.result;
      if (key >= recorded_) {
        key = -1;
        for (const int operand : operands(line))
          key = std::max(key, results_[operand].key);
      }
      results_[line.result].key = key;
      ++next[key + 2];
    }
    for (std::size_t key = 1; key < next.size(); ++key)
      next[key] += next[key - 1];
    lines_.resize(written_.size());
    for (std::size_t i = written_.size(); i-- > 0;) {
      Operand& result = results_[written_[i].result];
      result.line = next[result.key + 1]++;
      lines_[result.line] = written_[i];
    }
  }

  const ExpressionGraph& graph_;
  ExpressionGraph more_{0};  // what lines need beside nodes: numbers and, as inputs, partial sums
  int nodes_, recorded_;     // up to the last node that is asked for
  int units_[2] = {-1, -1};  // -1 and 1, once they are needed
  std::vector<Operand> results_;
  std::vector<int> operands_;
  std::vector<Line> written_, lines_;
};

}  // namespace avi::detail
