#include "avi/autodiff/taylor_steps.hpp"

#include "src/autodiff/factor.hpp"

#include <cmath>

namespace avi {

namespace detail {
namespace {

/// The builder of the steps, on a graph that grows by the slopes of functions.
class TaylorBuilder {
 public:
  TaylorBuilder(ExpressionGraph& graph, TaylorSteps& steps) : graph_(graph), made_(steps) {}

  void build(const std::vector<int>& outputs, const std::vector<int>& rest) {
    find_slopes(outputs);
    find_slopes(rest);
    made_.places.resize(graph_.size(), -1);
    for (int i = 0; i < graph_.inputs(); ++i)
      made_.places[i] = i * made_.stride;
    add_steps(graph_.parts(outputs));
    made_.first = made_.steps.size();
    add_steps(needed_);
    for (auto& step : made_.steps)
      for (int k = 0; k < 2; ++k)
        if (const int slope = slopes_[step.node][k]; slope >= 0) step.slopes[k] = series(slope);
    for (const std::vector<int>* all : {&outputs, &rest})
      for (const int node : *all)
        (void)series(node);
  }

 private:
  using Rule = TaylorSteps::Rule;
  using Step = TaylorSteps::Step;

  static constexpr bool has_slope_rule(Operation operation) {
    return is_function(operation) && operation != Operation::sqrt && operation != Operation::exp &&
           operation != Operation::abs;
  }
  /// Returns the nodes of the slopes of a function; -1 for a constant operand.
  std::array<int, 2> slope_nodes(int node, const ExpressionGraph::Node& what) {
    const Factor a(graph_, what.a), f(graph_, node);
    if (what.operation == Operation::pow) {  // from f: another power would have a slope of its own, and so on
      const Factor b(graph_, what.b);
      return {graph_.is_constant(what.a) ? -1 : (b * (f / a)).in(graph_),
              graph_.is_constant(what.b) ? -1 : (f * log(a)).in(graph_)};
    }
    switch (what.operation) {
#define AVI_ONE(name, ...)                                                                                   \
  case Operation::name:                                                                                      \
    return {slopes::slope_of_##name(a, f).in(graph_), -1};
#define AVI_TWO(name, ...)                                                                                   \
  case Operation::name: {                                                                                    \
    const Factor b(graph_, what.b);                                                                          \
    return {graph_.is_constant(what.a) ? -1 : slopes::slopes_of_##name<0>(a, b, f).in(graph_),               \
            graph_.is_constant(what.b) ? -1 : slopes::slopes_of_##name<1>(a, b, f).in(graph_)};              \
  }
      AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
    default:
      return {-1, -1};
    }
  }
  /// Marks all nodes that these outputs need, with the slopes of functions, which it adds to the graph.
  void find_slopes(std::vector<int> open) {
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      needed_.resize(graph_.size(), 0);
      slopes_.resize(graph_.size(), {-1, -1});
      if (needed_[node]) continue;
      needed_[node] = 1;
      const ExpressionGraph::Node what = graph_[node];  // a copy: the graph grows
      if (what.operation == Operation::input || what.operation == Operation::constant) continue;
      if (has_slope_rule(what.operation)) slopes_[node] = slope_nodes(node, what);
      for (const int other : {what.a, what.b, slopes_[node][0], slopes_[node][1]})
        if (other >= 0) open.push_back(other);
    }
    needed_.resize(graph_.size(), 0);
  }
  /// Returns the place of the coefficients of a node; those of a constant are made here.
  int series(int node) {
    int& place = made_.places[node];
    if (place < 0) {
      place = allocate();
      made_.numbers.push_back({place, graph_[node].number});
    }
    return place;
  }
  int allocate() { return std::exchange(made_.size, made_.size + made_.stride); }
  void add_steps(const std::vector<char>& wanted) {
    for (int node = graph_.inputs(); node < static_cast<int>(wanted.size()); ++node)
      if (wanted[node] && made_.places[node] < 0 && !graph_.is_constant(node)) {
        if (is_whole_power(node)) {
          made_.places[node] = add_products(node);
          continue;
        }
        made_.steps.push_back(step_of(node));
        made_.places[node] = made_.steps.back().c_at;
      }
  }
  /// Returns true for a power that has a series where its base is 0, too; the recurrence of all others
  /// divides by the base.
  [[nodiscard]] bool is_whole_power(int node) const {
    if (graph_[node].operation != Operation::power) return false;
    const double exponent = graph_[graph_[node].b].number;
    return exponent >= 1.0 && exponent <= 0x1p30 && exponent == std::round(exponent);
  }
  /// Adds the steps of such a power, products in the order of power(). Returns the place of the last result.
  int add_products(int node) {
    const auto times = [&](int a, int b) {
      made_.steps.push_back({.rule = a == b ? Rule::square : Rule::product,
                             .operation = Operation::multiply,
                             .node = node,
                             .c_at = allocate(),
                             .a_at = a,
                             .b_at = b});
      return made_.steps.back().c_at;
    };
    int square = made_.places[graph_[node].a], product = -1;
    for (int n = static_cast<int>(graph_[graph_[node].b].number);; square = times(square, square)) {
      if (n % 2) product = product < 0 ? square : times(product, square);
      if ((n /= 2) == 0) return product;
    }
  }
  Step step_of(int node) {
    const auto& [operation, a, b, unused] = graph_[node];
    const bool constant_a = graph_.is_constant(a), constant_b = b >= 0 && graph_.is_constant(b);
    Step step{.operation = operation, .node = node, .c_at = allocate()};
    if (constant_a) step.number = graph_[a].number;
    if (constant_b) step.number = graph_[b].number;
    if (!constant_a) step.a_at = made_.places[a];
    if (b >= 0 && !constant_b) step.b_at = made_.places[b];
    switch (operation) {
    case Operation::add:
      step.rule = constant_a || constant_b ? Rule::shift : Rule::sum;
      break;
    case Operation::subtract:
      step.rule = constant_a ? Rule::turned : constant_b ? Rule::shift : Rule::difference;
      if (constant_b) step.number = -step.number;
      break;
    case Operation::multiply:
      step.rule = constant_a || constant_b ? Rule::scaled : a == b ? Rule::square : Rule::product;
      break;
    case Operation::divide:
      step.rule = constant_a ? Rule::reciprocal : constant_b ? Rule::scaled : Rule::quotient;
      if (constant_b) step.number = 1.0 / step.number;
      break;
    case Operation::power:
      step.rule = Rule::power;
      break;
    case Operation::sqrt:
      step.rule = Rule::root;
      break;
    case Operation::exp:
      step.rule = Rule::exponential;
      break;
    case Operation::abs:
      step.rule = Rule::absolute;
      break;
    case Operation::sign:
    case Operation::less:
    case Operation::less_equal:
      step.rule = Rule::jump;
      break;
    case Operation::when:
      step.rule = Rule::choice;
      break;
    default:  // Rule::function
      break;
    }
    if ((step.rule == Rule::shift || step.rule == Rule::scaled) && step.a_at < 0)
      std::swap(step.a_at, step.b_at);
    return step;
  }

  ExpressionGraph& graph_;
  TaylorSteps& made_;
  std::vector<char> needed_;
  std::vector<std::array<int, 2>> slopes_;
};

}  // namespace
}  // namespace detail

TaylorSteps::TaylorSteps(ExpressionGraph graph, const std::vector<int>& outputs, const std::vector<int>& rest,
                         int order)
    : stride(order + 2), size(graph.inputs() * stride) {
  detail::TaylorBuilder(graph, *this).build(outputs, rest);
}

}  // namespace avi
