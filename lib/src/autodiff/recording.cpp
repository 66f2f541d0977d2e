#include "avi/autodiff/recording.hpp"

#include "src/autodiff/reverse.hpp"
#include "src/autodiff/schedule.hpp"

#include <stdexcept>

namespace avi {

int Recorded::node_in(ExpressionGraph& graph) const {
  if (!graph_) return graph.constant(number_);
  if (graph_ != &graph || recording_ != graph.identity())
    throw std::invalid_argument("A recorded function mixes the arguments of two recordings; it must not "
                                "keep numbers from one call to the next, nor an expression of Eigen in "
                                "`auto`: (...).eval() makes a vector of it.");
  return node_;
}

Recorded Recorded::through(Operation operation) const {
  if (!graph_) return detail::evaluate(operation, number_, 0.0);
  return {*graph_, graph_->unary(operation, node_in(*graph_))};
}

Recorded Recorded::combine(Operation operation, const Recorded& a, const Recorded& b) {
  // The graph of b is used, so that a graph of a which no longer exists is told from it without being looked
  // into.
  ExpressionGraph* graph = b.graph_ ? b.graph_ : a.graph_;
  if (!graph) return detail::evaluate(operation, a.number_, b.number_);
  const int left = a.node_in(*graph), right = b.node_in(*graph);
  return {*graph, graph->binary(operation, left, right)};
}

Recording::Recording(ExpressionGraph graph, int node, int inner, const std::vector<int>& supplied)
    : graph_(std::move(graph)), value_(node), recorded_(graph_.size()) {
  require(inputs() >= 1, "Number of arguments to record", inputs(), "at least 1");
  require(node >= 0 && node < graph_.size(), "Node to differentiate", node, "a node of the graph");
  slopes_ = detail::Reverse(graph_).gradient(node, supplied.empty() ? -1 : inner);
  for (std::size_t i = 0; i < supplied.size(); ++i)
    slopes_[i] = graph_.binary(Operation::add, slopes_[i],
                               graph_.binary(Operation::multiply, slopes_.back(), supplied[i]));
}

Program Recording::program(int value, int first, int count) const {
  require(first >= 0 && first <= inputs(), "First entry to differentiate by", first, "an entry of x");
  require(count >= 0 && count <= inputs() - first, "Number of derivatives", count,
          "at most that of the entries left");
  return detail::Schedule::program(graph_, value, {slopes_.begin() + first, slopes_.begin() + first + count},
                                   recorded_);
}

}  // namespace avi
