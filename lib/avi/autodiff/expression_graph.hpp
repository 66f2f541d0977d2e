#pragma once
#include "avi/autodiff/operation.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// @file
/// A formula as a list of operations, each found once.

namespace avi {

/// The operations of a formula in the order of their first use. Equal operations on equal operands are one
/// node, operations on constants are evaluated at once, and sums with 0 and products with 0 and 1 are left
/// out; so 0 times an infinite value is 0 here.
class ExpressionGraph {
 public:
  /// One operation; operands are numbers of earlier nodes, -1 where there is none.
  struct Node {
    Operation operation;  ///< The operation.
    int a = -1;           ///< First operand; the number of the argument of an input.
    int b = -1;           ///< Second operand.
    double number = 0.0;  ///< Value of a constant.
  };

  /// A formula of that many arguments, its first nodes.
  explicit ExpressionGraph(int inputs) : inputs_(inputs) {
    for (int i = 0; i < inputs; ++i)
      find({.operation = Operation::input, .a = i});
  }

  /// A number that no other graph has, copies of this one aside: it tells this graph from what lay in its
  /// place before.
  [[nodiscard]] std::uint32_t identity() const { return identity_; }
  [[nodiscard]] int inputs() const { return inputs_; }                           ///< Number of arguments.
  [[nodiscard]] int late_inputs() const { return late_inputs_; }                 ///< See late_input().
  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()); }     ///< Number of nodes.
  [[nodiscard]] const Node& operator[](int node) const { return nodes_[node]; }  ///< That node.
  /// It is a number.
  [[nodiscard]] bool is_constant(int node) const { return nodes_[node].operation == Operation::constant; }
  /// It is this number.
  [[nodiscard]] bool is(int node, double number) const {
    return is_constant(node) && nodes_[node].number == number;
  }

  /// For every node up to the last of these, whether it is a part of one of their formulas, as they are.
  [[nodiscard]] std::vector<char> parts(const std::vector<int>& nodes) const;
  /// The same of one node.
  [[nodiscard]] std::vector<char> parts(int node) const { return parts(std::vector<int>{node}); }

  /// The node of one more argument, with the next number. Programs know arguments that are the first nodes
  /// alone: substitute() makes such a graph of this one.
  int late_input() { return find({.operation = Operation::input, .a = inputs_ + late_inputs_++}); }

  /// The node of a number.
  int constant(double number) { return find({.operation = Operation::constant, .number = number}); }

  /// That node, or -1 where there is none.
  [[nodiscard]] int find_constant(double number) const {
    return places_.empty() ? -1 : places_[place_of({.operation = Operation::constant, .number = number})];
  }

  /// The node of an operation on one node.
  int unary(Operation operation, int a);

  /// The node of an operation on two nodes.
  int binary(Operation operation, int a, int b);

  /// a to a constant power: the same roots, products and quotients as power() of a double where they are one.
  int power(int a, double exponent);

  /// The node of an operation of another graph, where its operands have these numbers in this one.
  int again(const ExpressionGraph& other, int node, const std::vector<int>& place);

  /// A formula of another graph, or of this one, at other arguments: its node in this graph where input i of
  /// the other one, late ones included, is the node arguments[i] of this one.
  int substitute(const ExpressionGraph& other, int node, const std::vector<int>& arguments);
  /// The same at the first inputs of this graph.
  int substitute(const ExpressionGraph& other, int node);

  /// Makes room for so many nodes, which saves time where their number is known.
  void reserve(int size);

  /// The node of a quotient number / b in the formula, or -1.
  [[nodiscard]] int quotient(int b) const {
    return static_cast<std::size_t>(b) < quotients_.size() ? quotients_[b] : -1;
  }

 private:
  static std::uint32_t next_identity();

  /// The node that an operation with a constant is for short, or -1 where there is none.
  int with_constant(Operation operation, int a, int b);
  /// The node, which is written down unless it is there.
  int find(const Node& node);
  /// Where in `places_` a node is, or may be put.
  [[nodiscard]] std::size_t place_of(const Node& node) const;
  void enlarge(std::size_t least);

  std::uint32_t identity_ = next_identity();
  int inputs_, late_inputs_ = 0;
  std::vector<Node> nodes_;
  std::vector<int> places_;     // of nodes, by their hashes; -1 where there is none; a power of 2 of them
  std::vector<int> quotients_;  // see quotient(); of the first nodes
};

namespace detail {

/// The value of a node at any scalar. @param values of the first nodes, of the inputs at least; those up to
/// `node` are added
template <class S>
S evaluate(const ExpressionGraph& graph, int node, std::vector<S>& values) {
  values.reserve(static_cast<std::size_t>(node) + 1);
  for (int i = static_cast<int>(values.size()); i <= node; ++i) {
    const ExpressionGraph::Node& what = graph[i];
    if (what.operation == Operation::constant)
      values.push_back(S(what.number));
    else if (what.operation == Operation::power)
      values.push_back(power(values[what.a], graph[what.b].number));
    else
      with_operation(what.operation, [&]<Operation known>() {
        if constexpr (known != Operation::power)
          values.push_back(apply<known>(values[what.a], values[what.b < 0 ? what.a : what.b]));
      });
  }
  return values[static_cast<std::size_t>(node)];
}

}  // namespace detail

}  // namespace avi
