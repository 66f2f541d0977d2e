#include "avi/autodiff/expression_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace expression_graph_test {

using avi::ExpressionGraph, avi::Operation;

/// The value of a node at (x, y) = (3, 0.7).
double value(const ExpressionGraph& graph, int node) {
  std::vector<double> values{3.0, 0.7};
  return avi::detail::evaluate(graph, node, values);
}

TEST(ExpressionGraph, HasTheValuesOfItsOperations) {
  const std::vector<double> numbers{0.0, 1.0, -1.0, 2.0, 0.5, -0.5};
  using enum Operation;
  for (const Operation operation : {add, subtract, multiply, divide, pow, less, less_equal, when})
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j) {
        ExpressionGraph graph(2);
        // Conditions are 0 or 1.
        if (operation == when && i > 1) continue;
        const auto node = [&](int k) {
          if (operation == when && k > 5) return graph.binary(less, k - 6, 1 - (k - 6));
          return k > 5 ? k - 6 : graph.constant(numbers[static_cast<std::size_t>(k)]);
        };
        const int a = node(i), b = node(j);
        const double expected = avi::detail::evaluate(operation, value(graph, a), value(graph, b));
        if (!std::isfinite(expected)) continue;  // 0 times what is not finite is 0
        EXPECT_DOUBLE_EQ(value(graph, graph.binary(operation, a, b)), expected)
            << avi::detail::name(operation) << " of " << value(graph, a) << " and " << value(graph, b);
      }
}

TEST(ExpressionGraph, LeavesOutWhatComputesNothing) {
  ExpressionGraph graph(2);
  const int x = 0, y = 1, zero = graph.constant(0.0), one = graph.constant(1.0), two = graph.constant(2.0);
  using enum Operation;
  const int condition = graph.binary(less, x, y);
  for (const auto& [node, expected] :
       {std::pair{graph.binary(add, x, zero), x},
        {graph.binary(add, zero, x), x},
        {graph.binary(subtract, x, zero), x},
        {graph.binary(subtract, x, x), zero},
        {graph.binary(multiply, x, one), x},
        {graph.binary(multiply, one, x), x},
        {graph.binary(multiply, x, zero), zero},
        {graph.binary(multiply, zero, x), zero},
        {graph.binary(divide, x, one), x},
        {graph.binary(divide, zero, x), zero},
        {graph.binary(when, one, x), x},
        {graph.binary(when, zero, x), zero},
        {graph.binary(when, condition, zero), zero},
        {graph.binary(when, condition, one), condition},
        {graph.power(x, 0.0), one},
        {graph.power(x, 1.0), x},
        {graph.power(x, 2.0), graph.binary(multiply, x, x)},
        {graph.power(x, 0.5), graph.unary(sqrt, x)},
        {graph.power(x, -1.0), graph.binary(divide, one, x)},
        {graph.power(x, -0.5), graph.binary(divide, one, graph.unary(sqrt, x))},
        {graph.binary(pow, x, two), graph.binary(multiply, x, x)},
        {graph.binary(subtract, zero, x), graph.binary(multiply, graph.constant(-1.0), x)},
        {graph.unary(exp, zero), one},
        {graph.binary(add, one, one), two}})
    EXPECT_EQ(node, expected);
  EXPECT_EQ(value(graph, graph.power(x, 3.0)), 27.0);
}

TEST(ExpressionGraph, HasEachOperationOnce) {
  ExpressionGraph graph(2);
  const int sum = graph.binary(Operation::add, 0, 1), product = graph.binary(Operation::multiply, 0, 1);
  EXPECT_EQ(graph.binary(Operation::add, 1, 0), sum);
  EXPECT_EQ(graph.binary(Operation::multiply, 1, 0), product);
  EXPECT_NE(graph.binary(Operation::subtract, 0, 1), graph.binary(Operation::subtract, 1, 0));
  EXPECT_NE(graph.binary(Operation::divide, 0, 1), graph.binary(Operation::divide, 1, 0));
  EXPECT_NE(graph.constant(0.0), graph.constant(-0.0));
  EXPECT_EQ(ExpressionGraph(1).find_constant(0.25), -1);
  EXPECT_EQ(graph.find_constant(0.25), -1);
  // However many there are.
  std::vector<int> nodes;
  for (int i = 0; i < 1000; ++i)
    nodes.push_back(graph.binary(Operation::multiply, sum, graph.constant(2.0 + i)));
  const int size = graph.size();
  graph.reserve(5000);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(graph.binary(Operation::multiply, graph.constant(2.0 + i), sum),
              nodes[static_cast<std::size_t>(i)]);
    EXPECT_EQ(graph[graph.find_constant(2.0 + i)].number, 2.0 + i);
  }
  EXPECT_EQ(graph.size(), size);
}

TEST(ExpressionGraph, KnowsThePartsOfAFormula) {
  ExpressionGraph graph(2);
  const int root = graph.unary(Operation::sqrt, 0), other = graph.unary(Operation::sqrt, 1);
  const int sum = graph.binary(Operation::add, root, graph.constant(4.0));
  const std::vector<char> part = graph.parts(sum);
  ASSERT_EQ(part.size(), static_cast<std::size_t>(sum) + 1);
  for (int i = 0; i <= sum; ++i)
    EXPECT_EQ(part[static_cast<std::size_t>(i)] != 0, i != 1 && i != other) << i;
}

TEST(ExpressionGraph, PutsAFormulaAtOtherArguments) {
  ExpressionGraph graph(2);
  const int late = graph.late_input();
  EXPECT_EQ(graph.late_inputs(), 1);
  // (x^3 - y) / z
  const int formula =
      graph.binary(Operation::divide, graph.binary(Operation::subtract, graph.power(0, 3.0), 1), late);
  ExpressionGraph other(2);
  const int product = other.binary(Operation::multiply, 0, 1);
  const int placed = other.substitute(graph, formula, {1, product, other.constant(2.0)});
  EXPECT_DOUBLE_EQ(value(other, placed), (std::pow(0.7, 3.0) - 2.1) / 2.0);
  // In itself, where constants are worked out.
  const int number =
      graph.substitute(graph, formula, {graph.constant(2.0), graph.constant(3.0), graph.constant(4.0)});
  EXPECT_TRUE(graph.is(number, 1.25));
  EXPECT_FALSE(graph.is(formula, 1.25));
}

TEST(ExpressionGraph, KnowsQuotientsOfANumber) {
  ExpressionGraph graph(2);
  const int sum = graph.binary(Operation::add, 0, 1);
  EXPECT_EQ(graph.quotient(sum), -1);
  EXPECT_EQ(graph.quotient(1), -1);
  const int first = graph.binary(Operation::divide, graph.constant(2.0), sum);
  graph.binary(Operation::divide, graph.constant(3.0), sum);
  graph.binary(Operation::divide, 0, 1);
  EXPECT_EQ(graph.quotient(sum), first) << "the first of them";
  EXPECT_EQ(graph.quotient(1), -1) << "not a quotient of an argument";
}

TEST(ExpressionGraph, RefusesAnOperationOnOtherOperands) {
  ExpressionGraph graph(2);
  EXPECT_THROW(graph.unary(Operation::add, 0), std::logic_error);
  EXPECT_THROW(graph.binary(Operation::sqrt, 0, 1), std::logic_error);
  EXPECT_NO_THROW(graph.unary(Operation::sign, 0));
}

}  // namespace expression_graph_test
