#pragma once
#include "avi/autodiff/operation.hpp"

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
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

  /// For every node up to this one, whether it is a part of its formula, as the node itself is.
  [[nodiscard]] std::vector<char> parts(int node) const {
    std::vector<char> part(static_cast<std::size_t>(node) + 1, 0);
    part[node] = 1;
    for (int i = node; i >= 0; --i)
      if (part[i] && nodes_[i].operation != Operation::input)
        for (const int operand : {nodes_[i].a, nodes_[i].b})
          if (operand >= 0) part[operand] = 1;
    return part;
  }

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
  int unary(Operation operation, int a) {
    check(operation, 1);
    if (is_constant(a)) return constant(detail::evaluate(operation, nodes_[a].number, 0.0));
    return find({.operation = operation, .a = a});
  }

  /// The node of an operation on two nodes.
  int binary(Operation operation, int a, int b) {
    check(operation, 2);
    if (is_constant(a) && is_constant(b))
      return constant(detail::evaluate(operation, nodes_[a].number, nodes_[b].number));
    switch (operation) {
    case Operation::add:
      if (is(a, 0.0)) return b;
      if (is(b, 0.0)) return a;
      if (b < a) std::swap(a, b);
      break;
    case Operation::subtract:
      if (is(b, 0.0)) return a;
      if (a == b) return constant(0.0);
      if (is(a, 0.0)) return binary(Operation::multiply, constant(-1.0), b);
      break;
    case Operation::multiply:
      if (is(a, 0.0) || is(b, 0.0)) return constant(0.0);
      if (is(a, 1.0)) return b;
      if (is(b, 1.0)) return a;
      if (b < a) std::swap(a, b);
      break;
    case Operation::divide:
      if (is(a, 0.0)) return a;
      if (is(b, 1.0)) return a;
      break;
    case Operation::pow:
      if (is_constant(b)) return power(a, nodes_[b].number);
      break;
    case Operation::when:
      if (is_constant(a)) return is(a, 0.0) ? a : b;
      if (is(b, 0.0)) return b;
      if (is(b, 1.0)) return a;
      break;
    default:  // no shorter way
      break;
    }
    const int node = find({.operation = operation, .a = a, .b = b});
    if (operation == Operation::divide && is_constant(a)) {
      if (quotients_.size() <= static_cast<std::size_t>(b)) quotients_.resize(node, -1);
      if (quotients_[b] < 0) quotients_[b] = node;
    }
    return node;
  }

  /// a to a constant power: the same roots, products and quotients as power() of a double where they are one.
  int power(int a, double exponent) {
    if (exponent == 0.0) return constant(1.0);
    if (exponent == 1.0) return a;
    if (exponent == 2.0) return binary(Operation::multiply, a, a);
    if (exponent == 0.5) return unary(Operation::sqrt, a);
    if (exponent == -1.0 || exponent == -0.5)
      return binary(Operation::divide, constant(1.0), power(a, -exponent));
    return binary(Operation::power, a, constant(exponent));
  }

  /// The node of an operation of another graph, where its operands have these numbers in this one.
  int again(const ExpressionGraph& other, int node, const std::vector<int>& place) {
    const Node& what = other[node];
    if (what.operation == Operation::constant) return constant(what.number);
    const int a = place[what.a];
    if (what.b < 0) return unary(what.operation, a);
    return what.operation == Operation::power ? power(a, other[what.b].number)
                                              : binary(what.operation, a, place[what.b]);
  }

  /// A formula of another graph, or of this one, at other arguments: its node in this graph where input i of
  /// the other one, late ones included, is the node arguments[i] of this one.
  int substitute(const ExpressionGraph& other, int node, const std::vector<int>& arguments) {
    const std::vector<char> part = other.parts(node);
    std::vector<int> place(part.size(), -1);
    for (int i = 0; i <= node; ++i)
      if (part[i])
        place[i] = other[i].operation == Operation::input ? arguments[other[i].a] : again(other, i, place);
    return place[node];
  }

  /// Makes room for so many nodes, which saves time where their number is known.
  void reserve(int size) {
    nodes_.reserve(size);
    if (2 * places_.size() <= 3 * static_cast<std::size_t>(size))
      enlarge(3 * static_cast<std::size_t>(size) / 2);
  }

  /// The node of a quotient number / b in the formula, or -1.
  [[nodiscard]] int quotient(int b) const {
    return static_cast<std::size_t>(b) < quotients_.size() ? quotients_[b] : -1;
  }

 private:
  static std::uint32_t next_identity() {
    static std::atomic<std::uint32_t> last{0};
    return ++last;
  }
  static void check(Operation operation, int operands) {
    if (detail::operands(operation) != operands)
      throw std::logic_error(std::string("An operation does not have so many operands: ") +
                             detail::name(operation) + ".");
  }

  /// The node, which is written down unless it is there.
  int find(const Node& node) {
    if (2 * places_.size() <= 3 * nodes_.size()) enlarge(64 + 2 * places_.size());
    int& known = places_[place_of(node)];
    if (known < 0) {
      known = size();
      nodes_.push_back(node);
    }
    return known;
  }
  /// Where in `places_` a node is, or may be put.
  [[nodiscard]] std::size_t place_of(const Node& node) const {
    for (std::size_t place = hash(node);; ++place) {
      place &= places_.size() - 1;
      const int known = places_[place];
      if (known < 0) return place;
      const Node& other = nodes_[known];
      if (other.operation == node.operation && other.a == node.a && other.b == node.b &&
          std::bit_cast<std::uint64_t>(other.number) == std::bit_cast<std::uint64_t>(node.number))
        return place;
    }
  }
  void enlarge(std::size_t least) {
    places_.assign(std::bit_ceil(least), -1);
    for (int i = 0; i < size(); ++i) {
      std::size_t place = hash(nodes_[i]);
      while (places_[place &= places_.size() - 1] >= 0)
        ++place;
      places_[place] = i;
    }
  }
  static std::size_t hash(const Node& node) {
    std::uint64_t key = static_cast<std::uint32_t>(node.a) | std::uint64_t{static_cast<std::uint32_t>(node.b)}
                                                                 << 32;
    key =
        (key ^ std::bit_cast<std::uint64_t>(node.number)) * 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
    key = (key ^ (key >> 32) ^ static_cast<std::uint64_t>(node.operation)) * 0x9e3779b97f4a7c15;
    return static_cast<std::size_t>(key >> 32);
  }

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
