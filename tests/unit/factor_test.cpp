#include "src/autodiff/factor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace factor_test {

using avi::ExpressionGraph, avi::Operation, avi::detail::Factor;

// One over b from a / b, so that there is one division, unless a is so large or small that a / b, or what is
// multiplied with it, leaves the range of numbers where 1 / b does not.
TEST(Factor, IsOneOverANodeByAQuotientThatIsThere) {
  for (const double numerator : {1.0, -3.0, 0x1p80, -0x1p80, 0x1p-80, 0x1.8p80, 0x1p-81, 1e-200, 1e200}) {
    ExpressionGraph graph(2);
    const int quotient = graph.binary(Operation::divide, graph.constant(numerator), 0), before = graph.size();
    const Factor one_over = Factor(graph, 0).reciprocal();
    const bool is_near = std::abs(numerator) >= 0x1p-80 && std::abs(numerator) <= 0x1p80;
    EXPECT_EQ(one_over.node == quotient, is_near) << numerator;
    EXPECT_EQ(one_over.number, is_near ? 1.0 / numerator : 1.0) << numerator;
    EXPECT_EQ(graph.size() == before, is_near) << numerator;
  }
}

}  // namespace factor_test
