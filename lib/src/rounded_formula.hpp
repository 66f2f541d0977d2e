#pragma once
#include "avi/autodiff/expression_graph.hpp"
#include "avi/autodiff/partials.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

/// @file
/// What rounding makes of the value of a formula.

namespace avi::detail {

/// A formula, to be evaluated with errors of rounding.
class RoundedFormula {
 public:
  /// @param graph is kept by reference
  RoundedFormula(const ExpressionGraph& graph, int node) : graph_(graph), node_(node) {}

  /// An estimate of the rounding error at x: every argument and every result on the way is moved by half a
  /// unit of its last digit, up or down as drawn, four times; the largest change counts. To first order, so
  /// that no jump is taken for rounding.
  double rounding(const VectorX& x) {
    using Moved = Partials<double, 1>;
    constexpr int draws = 4;
    double most = 0.0;
    for (int draw = 0; draw < draws; ++draw) {
      values_.clear();
      while (static_cast<int>(values_.size()) <= node_) {
        const int node = static_cast<int>(values_.size());
        if (node < graph_.inputs())
          values_.push_back(Moved(x[node]));
        else
          evaluate(graph_, node, values_);
        Moved& last = values_.back();
        last = Moved::variable(last.value, 0, last.partial(0) + sign() * last.value);
      }
      most = std::max(most, std::abs(values_.back().partial(0)));
    }
    return 0.5 * std::numeric_limits<double>::epsilon() * most;
  }

 private:
  double sign() {
    bits_ = bits_ * 1664525u + 1013904223u;
    return bits_ >> 31 ? 1.0 : -1.0;
  }
  const ExpressionGraph& graph_;
  int node_;
  unsigned bits_ = 1;
  std::vector<Partials<double, 1>> values_;
};

}  // namespace avi::detail
