#include "src/autodiff/fusion.hpp"
#include "unit/random_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using avi::ExpressionGraph, avi::Operation, avi::detail::Fusion, avi::detail::Line;

namespace fusion_test {

/// The values of all results, line by line.
std::vector<double> run(const Fusion& fusion, const ExpressionGraph& graph, const std::vector<double>& x) {
  const double unknown = -12345.678;
  std::vector<double> value(fusion.results(), unknown);
  for (int i = 0; i < fusion.results(); ++i)
    if (i < graph.inputs())
      value[i] = x[i];
    else if (fusion.is_constant(i))
      value[i] = fusion.number(i);
  for (const Line& line : fusion.lines()) {
    std::vector<double> of;
    for (const int operand : fusion.operands(line)) {
      EXPECT_NE(value[operand], unknown) << "a line comes before its operand";
      of.push_back(value[operand]);
    }
    double& result = value[line.result];
    EXPECT_EQ(result, unknown) << "computed twice";
    if (line.first == Operation::sum_of_products) {
      EXPECT_EQ(line.second, Operation::nothing);
      EXPECT_GE(of.size(), 4u);
      EXPECT_LE(of.size(), 64u);
      result = of[0] * of[1];
      for (std::size_t k = 2; k < of.size(); k += 2)
        result = result + of[k] * of[k + 1];
    } else {
      result = random_graph::by_hand(line.first, of[0], of.size() > 1 ? of[1] : 0.0);
      if (line.second != Operation::nothing) result = random_graph::by_hand(line.second, result, of[2]);
      EXPECT_EQ(of.size(), static_cast<std::size_t>(avi::detail::operands(line.first)) +
                               (line.second != Operation::nothing ? 1u : 0u));
    }
  }
  return value;
}

TEST(Fusion, ComputesWhatTheNodesAre) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const ExpressionGraph graph = random_graph::draw(random, 3);
    std::vector<int> results;
    for (int i = 1 + static_cast<int>(random() % 5); i > 0; --i)
      results.push_back(static_cast<int>(random() % static_cast<unsigned>(graph.size())));
    const int recorded = static_cast<int>(random() % static_cast<unsigned>(graph.size()));
    const Fusion fusion(graph, results, recorded);
    const int known =
        std::max(graph.inputs(), 1 + *std::ranges::max_element(results));  // partial sums follow
    for (const std::vector<double>& x : {std::vector{0.3, 1.7, -0.6}, std::vector{2.5, -0.4, 0.9}}) {
      const auto expected = random_graph::values(graph, x), got = run(fusion, graph, x);
      for (const int result : results)
        ASSERT_TRUE(random_graph::alike(got[result], expected[result]))
            << "seed " << seed << ", node " << result << ": " << got[result] << ", " << expected[result];
      for (const Line& line : fusion.lines())
        if (line.result < known) {
          ASSERT_TRUE(random_graph::alike(got[line.result], expected[line.result])) << "seed " << seed;
        }
    }
  }
}

// Every operation alone, at arguments of all kinds.
TEST(Fusion, KnowsEveryOperation) {
  for (const Operation operation : random_graph::operations())
    for (const double a : {-2.5, -1.0, -0.3, 0.0, 0.4, 1.0, 3.0})
      for (const double b : {-1.5, 0.0, 0.5, 2.0}) {
        ExpressionGraph graph(2);
        const bool one = avi::detail::operands(operation) == 1;
        const int node = operation == Operation::power ? graph.power(0, b)
                         : one                         ? graph.unary(operation, 0)
                                                       : graph.binary(operation, 0, 1);
        const auto got = run(Fusion(graph, {node}, graph.size()), graph, {a, b});
        const double expected = random_graph::by_hand(operation, a, b);
        EXPECT_TRUE(random_graph::alike(got[node], expected))
            << avi::detail::name(operation) << " of " << a << ", " << b;
        EXPECT_TRUE(random_graph::alike(avi::detail::evaluate(operation, a, b), expected))
            << avi::detail::name(operation);
      }
}

TEST(Fusion, JoinsProductsWithTheirSums) {
  ExpressionGraph graph(4);
  const auto add = [&](int a, int b) { return graph.binary(Operation::add, a, b); };
  const auto times = [&](int a, int b) { return graph.binary(Operation::multiply, a, b); };
  const auto lines = [&](int node) { return Fusion(graph, {node}, graph.size()).lines(); };
  const int pair = graph.binary(Operation::subtract, 3, times(0, 1));
  ASSERT_EQ(lines(pair).size(), 1u);
  EXPECT_EQ(lines(pair)[0].first, Operation::multiply);
  EXPECT_EQ(lines(pair)[0].second, Operation::subtract_from);
  const int sum = add(add(add(times(0, 1), times(1, 2)), times(2, 3)), 0);
  ASSERT_EQ(lines(sum).size(), 1u);
  EXPECT_EQ(lines(sum)[0].first, Operation::sum_of_products);
  EXPECT_EQ(lines(sum)[0].count, 8);
  const int shared = times(0, 2), both = add(graph.unary(Operation::sin, shared), shared);
  EXPECT_EQ(lines(both).size(), 3u) << "what serves twice is computed once";
  (void)graph.unary(Operation::exp, 1);
  EXPECT_EQ(lines(shared).size(), 1u) << "what serves nothing is left out";
}

TEST(Operations, AreRefusedWhereTheyComputeNothing) {
  for (const Operation operation : {Operation::input, Operation::constant, Operation::sum_of_products})
    EXPECT_THROW(avi::detail::evaluate(operation, 1.0, 2.0), std::logic_error);
  ExpressionGraph graph(2);
  EXPECT_THROW(graph.unary(Operation::add, 0), std::logic_error);
  EXPECT_THROW(graph.binary(Operation::exp, 0, 1), std::logic_error);
  EXPECT_THROW(graph.binary(Operation::sum_of_products, 0, 1), std::logic_error);
}

}  // namespace fusion_test
