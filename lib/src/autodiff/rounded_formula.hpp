#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/autodiff/partials.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

/// @file
/// Rounding errors in the value of a formula.

namespace avi::detail {

/// A formula that is evaluated together with its rounding errors.
class RoundedFormula {
 public:
  /// Takes a node of a graph. @param graph kept by reference
  RoundedFormula(const ExpressionGraph& graph, int node) : graph_(graph), node_(node) {}

  /// An estimate of the rounding error at x. Every argument and every intermediate result is changed by half
  /// a unit of its last digit, up or down at random, in four draws; the largest change of the value counts.
  /// The changes are of first order, so that no jump is taken for rounding.
  [[nodiscard]] double rounding(const VectorX& x) {
    constexpr int draws = 4;
    double most = 0.0;
    for (int draw = 0; draw < draws; ++draw) {
      move(x, [&](int node) { return sign() * values_[node].value; });
      most = std::max(most, std::abs(values_.back().partial(0)));
    }
    return 0.5 * std::numeric_limits<double>::epsilon() * most;
  }

  /// The value at x, rounded only once: the value in doubles, less its rounding errors on the way, which are
  /// known, to first order. Where terms cancel, as near a pole, it has digits that doubles have lost.
  [[nodiscard]] double rounded_once(const std::vector<double>& x) {
    move(x, [&](int node) { return error_of(node); });
    const double value = values_.back().value, error = values_.back().partial(0);
    return std::isfinite(error) ? value + error : value;
  }

 private:
  using Moved = Partials<double, 1>;

  /// Evaluates the formula at x, to first order. @param by the change of a node that has just been evaluated,
  /// which is added to its part of first order
  template <class Numbers, class By>
  void move(const Numbers& x, By&& by) {
    values_.clear();
    values_.reserve(static_cast<std::size_t>(node_) + 1);  // once, not at each node
    while (static_cast<int>(values_.size()) <= node_) {
      const int node = static_cast<int>(values_.size());
      if (node < graph_.inputs())
        values_.push_back(Moved(x[node]));
      else
        evaluate(graph_, node, values_);
      const double own = by(node);
      Moved& last = values_.back();
      last = Moved::variable(last.value, 0, last.partial(0) + own);
    }
  }
  /// The part of a node's result that rounding took away: for arithmetic and roots, to the last bit or nearly
  /// so (Knuth 1969, Dekker 1971); for all else, to the digits of a long double.
  [[nodiscard]] double error_of(int node) const {
    const ExpressionGraph::Node& what = graph_[node];
    if (node < graph_.inputs() || what.operation == Operation::constant) return 0.0;
    const double a = values_[what.a].value, b = values_[what.b < 0 ? what.a : what.b].value,
                 result = values_[node].value;
    switch (what.operation) {
    case Operation::add:
    case Operation::subtract: {
      const double second = what.operation == Operation::add ? b : -b, its_part = result - a;
      return (a - (result - its_part)) + (second - its_part);
    }
    case Operation::multiply:
      return std::fma(a, b, -result);
    case Operation::divide:
      return std::fma(-result, b, a) / b;
    case Operation::sqrt:
      return result > 0.0 ? std::fma(-result, result, a) / (2.0 * result) : 0.0;
    default:
      break;
    }
    const long double x = a, y = b;
    long double exact = result;
    with_operation(what.operation, [&]<Operation known>() { exact = apply<known>(x, y); });
    return static_cast<double>(exact - result);
  }
  double sign() {
    bits_ = bits_ * 1664525u + 1013904223u;
    return bits_ >> 31 ? 1.0 : -1.0;
  }
  const ExpressionGraph& graph_;
  int node_;
  unsigned bits_ = 1;
  std::vector<Moved> values_;
};

}  // namespace avi::detail
