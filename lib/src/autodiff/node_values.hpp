#pragma once
#include "src/autodiff/schedule.hpp"

#include <vector>

/// @file
/// Values of chosen nodes of a graph.

namespace avi::detail {

/// Values of chosen nodes of a graph of (q, p), at one point after another.
template <class Scalar = double>
class NodeValues {
 public:
  /// Makes the program of these nodes.
  NodeValues(const ExpressionGraph& graph, const std::vector<int>& nodes)
      : formula_{Schedule::program(graph, -1, nodes, graph.size())} {}

  /// Evaluates the nodes at q and p, n numbers each.
  void at(const Scalar* q, const Scalar* p, Eigen::Index n) { formula_.run(q, p, n); }
  /// Number of nodes.
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(formula_.program.slopes()); }
  /// Value of the node at this place in the list.
  [[nodiscard]] const Scalar& operator[](std::size_t place) const {
    return formula_.partial(static_cast<int>(place));
  }

 private:
  RecordedFormula<Scalar> formula_;  // whose derivatives the program takes them for
};

}  // namespace avi::detail
