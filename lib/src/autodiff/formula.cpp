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

Formula::Formula(ExpressionGraph&& graph, int node, std::vector<double> parameters)
    : parameters_(std::move(parameters)) {
  require(node >= 0 && node < graph.size(), "Node of a formula", node, "a node of the graph");
  require(static_cast<int>(parameters_.size()) < graph.inputs(), "Number of parameters", parameters_.size(),
          "less than that of the inputs, ", graph.inputs());
  const std::vector<char> part = graph.parts(node);
  if (node + 1 < graph.size() ||
      std::find(part.begin() + std::min(graph.inputs(), node), part.end(), 0) != part.end()) {
    ExpressionGraph own(graph.inputs());
    node = own.substitute(graph, node);
    graph = std::move(own);
  }
  shared_ = std::make_shared<const Shared>(Shared{std::move(graph), node, std::make_shared<Gradient>()});
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
  std::vector<int> arguments(static_cast<std::size_t>(inputs()));
  std::iota(arguments.begin(), arguments.end(), 0);
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
