#include "avi/autodiff/formula.hpp"

#include "avi/autodiff/recording.hpp"

#include <algorithm>
#include <mutex>
#include <numeric>

namespace avi {

/// The program of f and its gradient by all inputs, made when it is first asked for.
struct Formula::Gradient {
  std::once_flag made;
  Program program;
};

namespace {

/// The nodes 0, 1, ... count - 1.
std::vector<int> first_nodes(int count) {
  std::vector<int> nodes(static_cast<std::size_t>(count));
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

}  // namespace

Formula::Formula(ExpressionGraph&& graph, int node, std::vector<double> parameters)
    : parameters_(std::move(parameters)) {
  require(node >= 0 && node < graph.size(), "Node of a formula", node, "a node of the graph");
  require(static_cast<int>(parameters_.size()) < graph.inputs(), "Number of parameters", parameters_.size(),
          "less than that of the inputs, ", graph.inputs());
  const std::vector<char> part = graph.parts(node);
  if (node + 1 < graph.size() ||
      std::find(part.begin() + std::min(graph.inputs(), node), part.end(), 0) != part.end()) {
    ExpressionGraph own(graph.inputs());
    node = own.substitute(graph, node, first_nodes(graph.inputs()));
    shared_ = std::make_shared<const Shared>(Shared{std::move(own), node, std::make_shared<Gradient>()});
    return;
  }
  shared_ = std::make_shared<const Shared>(Shared{std::move(graph), node, std::make_shared<Gradient>()});
}

int Formula::checked(Eigen::Index inputs) {
  require(inputs >= 1, "Number of arguments to record", inputs, "at least 1");
  return static_cast<int>(inputs);
}

Formula Formula::with(std::vector<double> parameters) const {
  require(parameters.size() == parameters_.size(), "Number of parameters", parameters.size(), "",
          parameters_.size());
  Formula other = *this;
  other.parameters_ = std::move(parameters);
  return other;
}

Formula Formula::with_constants() const {
  if (parameters_.empty()) return *this;
  ExpressionGraph own(inputs());
  std::vector<int> arguments = first_nodes(inputs());
  for (const double c : parameters_)
    arguments.push_back(own.constant(c));
  const int its_node = own.substitute(graph(), node(), arguments);
  return {std::move(own), its_node};
}

void Formula::gradient(const double* x, double* slopes) const {
  Gradient& gradient = *shared_->gradient;
  std::call_once(gradient.made, [&] { gradient.program = Recording(graph(), node()).gradient(0, inputs()); });
  Program::Room<double> room(gradient.program);
  std::copy(parameters_.begin(), parameters_.end(), std::copy_n(x, inputs(), room.arguments()));
  gradient.program.run(room);
  for (int i = 0; i < inputs(); ++i)
    slopes[i] = gradient.program.slope(room, i);
}

}  // namespace avi
