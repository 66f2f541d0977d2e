#pragma once
#include "avi/autodiff/operation.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// @file
/// ExpressionGraph: a formula as a list of operations, without duplicates.

namespace avi {

/// The operations of a formula, in the order of their first use. Equal operations on equal operands share one
/// node, operations on constants are evaluated at once, and sums with 0 and products with 0 and 1 are
/// dropped. So 0 times an infinite value is 0 here.
class ExpressionGraph {
 public:
  /// One operation. Operands are indices of earlier nodes, -1 where there is none.
  struct Node {
    Operation operation;  ///< The operation.
    int a = -1;           ///< First operand; for an input, the index of the argument.
    int b = -1;           ///< Second operand.
    double number = 0.0;  ///< Value of a constant.
  };

  /// A graph with this number of arguments, which are its first nodes.
  explicit ExpressionGraph(int inputs) : inputs_(inputs) {
    for (int i = 0; i < inputs; ++i)
      find({.operation = Operation::input, .a = i});
  }

  /// A number that only this graph and its copies have. It distinguishes this graph from an earlier one at
  /// the same address.
  [[nodiscard]] std::uint32_t identity() const { return identity_; }
  [[nodiscard]] int inputs() const { return inputs_; }  ///< Number of arguments.
  /// Number of arguments added by late_input().
  [[nodiscard]] int late_inputs() const { return late_inputs_; }
  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()); }     ///< Number of nodes.
  [[nodiscard]] const Node& operator[](int node) const { return nodes_[node]; }  ///< The node of this index.
  /// True where the node is a constant.
  [[nodiscard]] bool is_constant(int node) const { return nodes_[node].operation == Operation::constant; }
  /// True where the node is this constant.
  [[nodiscard]] bool is(int node, double number) const {
    return is_constant(node) && nodes_[node].number == number;
  }

  /// For each node up to the last of `nodes`, 1 if the value of one of these depends on it, otherwise 0.
  [[nodiscard]] std::vector<char> parts(const std::vector<int>& nodes) const;
  /// The same for one node.
  [[nodiscard]] std::vector<char> parts(int node) const { return parts(std::vector<int>{node}); }

  /// Adds one more argument, with the next index, and returns its node. A Program accepts arguments only as
  /// the first nodes; substitute() converts this graph to such a one.
  int late_input() { return find({.operation = Operation::input, .a = inputs_ + late_inputs_++}); }

  /// The node of a constant, added where it is missing.
  int constant(double number) { return find({.operation = Operation::constant, .number = number}); }

  /// The node of a constant, or -1 where the graph has none.
  [[nodiscard]] int find_constant(double number) const {
    return places_.empty() ? -1 : places_[place_of({.operation = Operation::constant, .number = number})];
  }

  /// The node of an operation on one node.
  int unary(Operation operation, int a);

  /// The node of an operation on two nodes.
  int binary(Operation operation, int a, int b);

  /// The node of a to a constant power. Powers 2, 1/2, -1 and -1/2 become the product, root and quotients by
  /// which power() of a double computes them; other powers are one operation.
  int power(int a, double exponent);

  /// Adds the operation of a node of another graph. @param place for each node of the other graph, its node
  /// in this one
  int again(const ExpressionGraph& other, int node, const std::vector<int>& place);

  /// Adds a formula of another graph, or of this one, at other arguments: input i of `other`, late inputs
  /// included, is replaced by the node arguments[i] of this graph. @return the node of the result
  int substitute(const ExpressionGraph& other, int node, const std::vector<int>& arguments);
  /// The same, with the inputs of `other` replaced by the first inputs of this graph.
  int substitute(const ExpressionGraph& other, int node);

  /// Reserves memory for this number of nodes, which saves time where the number is known.
  void reserve(int size);

  /// A node of the form number / b in the graph, or -1.
  [[nodiscard]] int quotient(int b) const {
    return static_cast<std::size_t>(b) < quotients_.size() ? quotients_[b] : -1;
  }

 private:
  static std::uint32_t next_identity();

  /// The node that replaces an operation with a constant operand, where it can be simplified; otherwise -1.
  int with_constant(Operation operation, int a, int b);
  /// The index of a node; it is added to the graph unless it is there already.
  int find(const Node& node);
  /// Index in `places_` where this node is, or where it would be entered.
  [[nodiscard]] std::size_t place_of(const Node& node) const;
  void enlarge(std::size_t least);

  std::uint32_t identity_ = next_identity();
  int inputs_, late_inputs_ = 0;
  std::vector<Node> nodes_;
  std::vector<int> places_;     // hash table of node indices, -1 where empty; its size is a power of 2
  std::vector<int> quotients_;  // see quotient(); of the first nodes
};

namespace detail {

/// The value of a node for any scalar. @param values of the first nodes, at least of all inputs; those up to
/// `node` are appended
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
