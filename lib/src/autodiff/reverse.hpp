#pragma once
#include "src/autodiff/factor.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

/// @file
/// Reverse accumulation on the graph: the gradient of a recorded formula as further operations of it.

namespace avi::detail {

/// The gradient of a node, written into its graph. With \f$\bar z = \partial f/\partial z\f$ for each
/// intermediate result z, \f$\bar z = \sum_u \bar u\,\partial u/\partial z\f$ over the operations u that use
/// z (Griewank and Walther 2008, Section 3.2): one sum for each z over its uses, so all derivatives together
/// cost a small multiple of f. What would be passed on to the side of a choice that is not taken is left out
/// altogether, so that an infinite or NaN slope there does no harm.
class Reverse {
 public:
  /// Takes a graph, which grows by the gradient.
  explicit Reverse(ExpressionGraph& graph) : graph_(graph) {}

  /// The nodes of df/d(input i) for i = 0, 1, ... @param inner an intermediate result that is treated as a
  /// constant; the node of df/d(inner) then comes last
  std::vector<int> gradient(int f, int inner = -1) {
    uses_.assign(static_cast<std::size_t>(f) + 1, {});
    parts_.clear();
    free_ = -1;
    graph_.reserve(graph_.size() + 5 * (f / 4));
    give(f, {.bar = 1.0});
    std::vector<int> slopes(graph_.inputs() + (inner >= 0 ? 1 : 0), graph_.constant(0.0));
    for (int node = f; node >= 0; --node) {
      if (uses_[node].first < 0) continue;
      const Term bar = total(node);
      const ExpressionGraph::Node what = graph_[node];  // a copy: the graph grows
      if (node == inner)
        slopes.back() = written(bar);
      else if (what.operation == Operation::input)
        slopes[what.a] = written(bar);
      else
        pass_on(node, what, bar);
    }
    return slopes;
  }

 private:
  /// @cond
  /// A contribution to a derivative: 0 where its condition, if it has one, does not hold.
  struct Term {
    Factor bar;
    int condition = -1;
  };
  struct Contribution {
    double number;
    int node, condition;
    int next = -1;  // the next one of the same node, in the order in which they came; or the next free one
  };
  struct Uses {
    int first = -1, last = -1;  // numbers of parts_
  };

  [[nodiscard]] Factor factor(int node) { return {graph_, node}; }
  static Factor scaled(double number, Factor x) {
    x.number *= number;
    return x;
  }
  int written(const Term& a) {
    const int node = a.bar.in(graph_);
    return a.condition < 0 ? node : graph_.binary(Operation::when, a.condition, node);
  }
  Factor factor(const Contribution& a) { return {graph_, a.number, a.node}; }

  /// Returns the node that tells whether at least one of the conditions of these parts holds.
  int any_condition(int first) {
    const int one = graph_.constant(1.0);
    int none = -1;
    for (int i = first; i >= 0; i = parts_[i].next) {
      const int fails = graph_.binary(Operation::subtract, one, parts_[i].condition);
      none = none < 0 ? fails : graph_.binary(Operation::when, none, fails);
    }
    return graph_.binary(Operation::subtract, one, none);
  }

  /// Returns the sum of these parts.
  Term sum_of(int first) {
    const int condition = parts_[first].condition;
    if (parts_[first].next < 0) return {.bar = factor(parts_[first]), .condition = condition};
    bool alike = true, conditional = true;
    for (int i = first; i >= 0; i = parts_[i].next) {
      alike = alike && parts_[i].condition == condition;
      conditional = conditional && parts_[i].condition >= 0;
    }
    const int common = alike ? condition : conditional ? any_condition(first) : -1;
    double scale = 0.0;  // number of the first part that has a node
    double numbers = 0.0;
    int sum = -1;
    // A part is added as a multiple of the scale, unless their ratio is beyond the range of numbers.
    const auto in_scale = [&](double number) {
      if (!std::isnormal(number / scale)) sum = Factor(graph_, std::exchange(scale, 1.0), sum).in(graph_);
      return number / scale;
    };
    for (int i = first; i >= 0; i = parts_[i].next) {
      const Factor part = alike || parts_[i].condition < 0
                              ? factor(parts_[i])
                              : factor(written({.bar = factor(parts_[i]), .condition = parts_[i].condition}));
      if (part.node < 0) {
        numbers += part.number;
      } else if (sum < 0) {
        sum = part.node;
        scale = part.number;
      } else {
        const double ratio = in_scale(part.number);
        if (ratio == -1.0)
          sum = graph_.binary(Operation::subtract, sum, part.node);
        else
          sum = graph_.binary(Operation::add, sum, Factor(graph_, ratio, part.node).in(graph_));
      }
    }
    if (sum < 0) return {.bar = numbers, .condition = common};
    if (numbers != 0.0) {
      const int rest = graph_.constant(in_scale(numbers));
      sum = graph_.binary(Operation::add, sum, rest);
    }
    return {.bar = {graph_, scale, sum}, .condition = common};
  }
  /// Returns all that was passed on to a node, and frees its parts.
  Term total(int node) {
    const Uses uses = uses_[node];
    Term all = sum_of(uses.first);
    parts_[uses.last].next = std::exchange(free_, uses.first);
    // A sum passes its factor on to two operands, so the factor is multiplied in once, here, unless it is a
    // power of 2.
    const Operation use = graph_[node].operation;
    int exponent = 0;
    if ((use == Operation::add || use == Operation::subtract) && all.bar.node >= 0 && all.bar.number != 1.0 &&
        std::abs(std::frexp(all.bar.number, &exponent)) != 0.5)
      all.bar = {graph_, 1.0, all.bar.in(graph_)};
    return all;
  }

  void give(int node, const Term& part) {
    if (graph_.is_constant(node) || part.bar.number == 0.0) return;
    int place = free_;
    if (place < 0) {
      place = static_cast<int>(parts_.size());
      parts_.emplace_back();
    } else {
      free_ = parts_[place].next;
    }
    Uses& uses = uses_[node];
    (uses.first < 0 ? uses.first : parts_[uses.last].next) = place;
    uses.last = place;
    parts_[place] = {.number = part.bar.number, .node = part.bar.node, .condition = part.condition};
  }

  /// Passes `bar` on to the operands of a node, times the derivatives of its operation.
  void pass_on(int node, const ExpressionGraph::Node& what, const Term& bar) {
    const int a = what.a, b = what.b;
    const auto times = [&](const Factor& slope) {
      return Term{.bar = bar.bar * slope, .condition = bar.condition};
    };
    switch (what.operation) {
    case Operation::add:
      give(a, bar);
      give(b, bar);
      break;
    case Operation::subtract:
      give(a, bar);
      give(b, times(-1.0));
      break;
    case Operation::multiply:
      if (a == b) {
        give(a, times(scaled(2.0, factor(a))));
      } else {
        give(a, times(factor(b)));
        give(b, times(factor(a)));
      }
      break;
    case Operation::divide: {
      const Term inverse = times(factor(b).reciprocal());
      give(a, inverse);
      if (!graph_.is_constant(b)) give(b, {.bar = -(inverse.bar * factor(node)), .condition = bar.condition});
      break;
    }
    case Operation::power: {
      const double exponent = graph_[b].number;
      if (exponent >= 1.0)  // finite at a = 0, too
        give(a, times(scaled(exponent, factor(graph_.power(a, exponent - 1.0)))));
      else
        give(a, times(scaled(exponent, factor(node) * factor(a).reciprocal())));
      break;
    }
    case Operation::when: {
      int condition = a;  // both conditions, where there are two
      if (bar.condition >= 0) condition = graph_.binary(Operation::when, bar.condition, a);
      give(b, {.bar = bar.bar, .condition = condition});
      break;
    }
#define AVI_ONE(name, ...)                                                                                   \
  case Operation::name:                                                                                      \
    give(a, times(slopes::slope_of_##name(factor(a), factor(node))));                                        \
    break;
#define AVI_TWO(name, ...)                                                                                   \
  case Operation::name:                                                                                      \
    if (!graph_.is_constant(a))                                                                              \
      give(a, times(slopes::slopes_of_##name<0>(factor(a), factor(b), factor(node))));                       \
    if (!graph_.is_constant(b))                                                                              \
      give(b, times(slopes::slopes_of_##name<1>(factor(a), factor(b), factor(node))));                       \
    break;
      AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
    case Operation::sign:  // these are constant except for jumps
    case Operation::less:
    case Operation::less_equal:
      break;
    case Operation::input:  // these have no operands
    case Operation::constant:
      break;
    case Operation::nothing:  // these are in programs only
    case Operation::subtract_from:
    case Operation::sum_of_products:
      computes_nothing(what.operation);
    }
  }

  /// @endcond

  ExpressionGraph& graph_;
  std::vector<Uses> uses_;  // uses of each node
  std::vector<Contribution> parts_;
  int free_ = -1;  // the first of the free parts
};

}  // namespace avi::detail
