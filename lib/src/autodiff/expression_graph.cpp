#include "avi/autodiff/expression_graph.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace avi {

void detail::computes_nothing(Operation operation) {
  throw std::logic_error(std::string("An operation of a recorded formula cannot be evaluated: ") +
                         name(operation) + ".");
}

double detail::evaluate(Operation operation, double a, double b) {
  double result = 0.0;
  with_operation(operation, [&]<Operation known>() { result = apply<known>(a, b); });
  return result;
}

namespace {

[[noreturn, gnu::cold]] void refuse(Operation operation) {
  throw std::logic_error(std::string("An operation does not have so many operands: ") +
                         detail::name(operation) + ".");
}

std::size_t hash(const ExpressionGraph::Node& node) {
  std::uint64_t key = static_cast<std::uint32_t>(node.a) | std::uint64_t{static_cast<std::uint32_t>(node.b)}
                                                               << 32;
  key = (key ^ std::bit_cast<std::uint64_t>(node.number)) * 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  key = (key ^ (key >> 32) ^ static_cast<std::uint64_t>(node.operation)) * 0x9e3779b97f4a7c15;
  return static_cast<std::size_t>(key >> 32);
}

bool same(const ExpressionGraph::Node& x, const ExpressionGraph::Node& y) {
  return x.a == y.a && x.b == y.b && x.operation == y.operation &&
         std::bit_cast<std::uint64_t>(x.number) == std::bit_cast<std::uint64_t>(y.number);
}

}  // namespace

std::uint32_t ExpressionGraph::next_identity() {
  static std::atomic<std::uint32_t> last{0};
  return ++last;
}

std::vector<char> ExpressionGraph::parts(const std::vector<int>& nodes) const {
  std::vector<char> part;
  for (const int node : nodes) {
    part.resize(std::max(part.size(), static_cast<std::size_t>(node) + 1), 0);
    part[node] = 1;
  }
  for (auto i = static_cast<int>(part.size()) - 1; i >= 0; --i)
    if (part[i] && nodes_[i].operation != Operation::input)
      for (const int operand : {nodes_[i].a, nodes_[i].b})
        if (operand >= 0) part[operand] = 1;
  return part;
}

int ExpressionGraph::unary(Operation operation, int a) {
  if (detail::operands(operation) != 1) refuse(operation);
  if (is_constant(a)) return constant(detail::evaluate(operation, nodes_[a].number, 0.0));
  return find({.operation = operation, .a = a});
}

int ExpressionGraph::binary(Operation operation, int a, int b) {
  if (detail::operands(operation) != 2) refuse(operation);
  if (is_constant(a) || is_constant(b)) {
    const int known = with_constant(operation, a, b);
    if (known >= 0) return known;
  } else if (operation == Operation::subtract && a == b) {
    return constant(0.0);
  }
  if ((operation == Operation::add || operation == Operation::multiply) && b < a) std::swap(a, b);
  const int node = find({.operation = operation, .a = a, .b = b});
  if (operation == Operation::divide && is_constant(a)) {
    if (quotients_.size() <= static_cast<std::size_t>(b)) quotients_.resize(node, -1);
    if (quotients_[b] < 0) quotients_[b] = node;
  }
  return node;
}

int ExpressionGraph::with_constant(Operation operation, int a, int b) {
  if (is_constant(a) && is_constant(b))
    return constant(detail::evaluate(operation, nodes_[a].number, nodes_[b].number));
  switch (operation) {
  case Operation::add:
    if (is(a, 0.0)) return b;
    if (is(b, 0.0)) return a;
    break;
  case Operation::subtract:
    if (is(b, 0.0)) return a;
    if (is(a, 0.0)) return binary(Operation::multiply, constant(-1.0), b);
    break;
  case Operation::multiply:
    if (is(a, 0.0) || is(b, 0.0)) return constant(0.0);
    if (is(a, 1.0)) return b;
    if (is(b, 1.0)) return a;
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
  return -1;
}

int ExpressionGraph::power(int a, double exponent) {
  if (exponent == 0.0) return constant(1.0);
  if (exponent == 1.0) return a;
  if (exponent == 2.0) return binary(Operation::multiply, a, a);
  if (exponent == 0.5) return unary(Operation::sqrt, a);
  if (exponent == -1.0 || exponent == -0.5)
    return binary(Operation::divide, constant(1.0), power(a, -exponent));
  return binary(Operation::power, a, constant(exponent));
}

int ExpressionGraph::again(const ExpressionGraph& other, int node, const std::vector<int>& place) {
  const Node& what = other[node];
  if (what.operation == Operation::constant) return constant(what.number);
  const int a = place[what.a];
  if (what.b < 0) return unary(what.operation, a);
  return what.operation == Operation::power ? power(a, other[what.b].number)
                                            : binary(what.operation, a, place[what.b]);
}

int ExpressionGraph::substitute(const ExpressionGraph& other, int node, const std::vector<int>& arguments) {
  const std::vector<char> part = other.parts(node);
  std::vector<int> place(part.size(), -1);
  for (int i = 0; i <= node; ++i)
    if (part[i])
      place[i] = other[i].operation == Operation::input ? arguments[other[i].a] : again(other, i, place);
  return place[node];
}

int ExpressionGraph::substitute(const ExpressionGraph& other, int node) {
  std::vector<int> arguments(static_cast<std::size_t>(other.inputs() + other.late_inputs()));
  std::iota(arguments.begin(), arguments.end(), 0);
  return substitute(other, node, arguments);
}

void ExpressionGraph::reserve(int size) {
  nodes_.reserve(size);
  if (2 * places_.size() <= 3 * static_cast<std::size_t>(size))
    enlarge(3 * static_cast<std::size_t>(size) / 2);
}

std::size_t ExpressionGraph::place_of(const Node& node) const {
  const std::size_t last = places_.size() - 1;
  std::size_t place = hash(node) & last;
  while (places_[place] >= 0 && !same(nodes_[places_[place]], node))
    place = (place + 1) & last;
  return place;
}

int ExpressionGraph::find(const Node& node) {
  if (2 * places_.size() <= 3 * nodes_.size()) enlarge(64 + 2 * places_.size());
  int& known = places_[place_of(node)];
  if (known < 0) {
    known = size();
    nodes_.push_back(node);
  }
  return known;
}

void ExpressionGraph::enlarge(std::size_t least) {
  places_.assign(std::bit_ceil(least), -1);
  const std::size_t last = places_.size() - 1;
  for (int i = 0; i < size(); ++i) {
    std::size_t place = hash(nodes_[i]) & last;
    while (places_[place] >= 0)
      place = (place + 1) & last;
    places_[place] = i;
  }
}

}  // namespace avi
