#include "avi/htvi/quadrature.hpp"

#include "refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace quadrature_test {

std::vector<avi::Quadrature> rules() {
  std::vector<avi::Quadrature> all{avi::rectangle_left(), avi::midpoint(), avi::trapezoid(), avi::simpson(),
                                   avi::boole()};
  for (int m = 1; m <= 8; ++m)
    all.push_back(avi::gauss(m));
  for (int m = 2; m <= 8; ++m)
    all.push_back(avi::lobatto(m));
  for (int m = 1; m <= 8; ++m)
    all.push_back(avi::radau(m));
  return all;
}

/// Error of the rule for x^degree.
double defect(const avi::Quadrature& rule, int degree) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
  return std::abs(sum - 1.0 / (degree + 1));
}

TEST(Quadrature, IsExactToItsOrderAndNoFurther) {
  for (const auto& rule : rules()) {
    avi::validate(rule);
    for (int degree = 0; degree < rule.order; ++degree)
      EXPECT_LT(defect(rule, degree), 1e-15) << rule.name << degree;
    EXPECT_GT(defect(rule, rule.order), 1e-11) << rule.name;
  }
}

TEST(Quadrature, HasItsNodesInOrderAndInside) {
  for (int m = 2; m <= 16; ++m)
    for (const auto& rule : {avi::gauss(m), avi::lobatto(m), avi::radau(m)}) {
      ASSERT_EQ(rule.nodes.size(), static_cast<std::size_t>(m)) << rule.name;
      EXPECT_GE(rule.nodes.front(), 0.0);
      EXPECT_LE(rule.nodes.back(), 1.0);
      for (int i = 1; i < m; ++i)
        EXPECT_GT(rule.nodes[i], rule.nodes[i - 1] + 1e-3) << rule.name;
      for (int degree = 0; degree < rule.order; ++degree)
        EXPECT_LT(defect(rule, degree), 7e-15) << rule.name << " " << degree;
    }
}

TEST(Quadrature, GaussAgreesWithClosedForms) {
  const auto rule = avi::gauss(3);
  EXPECT_NEAR(rule.nodes[0], 0.5 - std::sqrt(0.15), 1e-16);
  EXPECT_NEAR(rule.nodes[1], 0.5, 1e-16);
  EXPECT_NEAR(rule.weights[0], 5.0 / 18.0, 2e-16);
  EXPECT_NEAR(rule.weights[1], 8.0 / 18.0, 2e-16);
  const auto ends = avi::lobatto(3), simpson = avi::simpson();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(ends.nodes[i], simpson.nodes[i], 1e-16);
    EXPECT_NEAR(ends.weights[i], simpson.weights[i], 2e-16);
  }
}

// More of it is in bad_htvi_input_test.cpp.
TEST(Quadrature, RefusesWhatIsNoRule) {
  for (const auto& [rule, least] : {std::pair{&avi::gauss, 1}, {&avi::lobatto, 2}, {&avi::radau, 1}})
    for (const int m : {least, 16})
      EXPECT_NO_THROW(rule(m)) << m;
  EXPECT_THROW(avi::validate({"heavy", 1, {0.5}, {2.0}}), std::invalid_argument);
  EXPECT_THROW(avi::validate({"a little heavy", 1, {0.5}, {1.0 + 1.2e-12}}), std::invalid_argument);
  EXPECT_NO_THROW(avi::validate({"rounded", 1, {0.5}, {1.0 + 8e-13}}));
  for (const double node : {-0.1, 1.1, 7.0})
    EXPECT_THROW(avi::validate({"outside", 1, {node}, {1.0}}), std::invalid_argument) << node;
  for (const int order : {-1, 0, 5, 99})
    EXPECT_THROW(avi::validate({"gauss2", order, avi::gauss(2).nodes, {0.5, 0.5}}), std::invalid_argument)
        << order;
  EXPECT_EQ(
      refusal([] {
        avi::validate({"left", 2, {0.0}, {1.0}});
      }),
      "Order of the quadrature is 2; it must be at most 1, the first power that it does not integrate.");
  EXPECT_THROW(avi::validate({"nan", 1, {std::nan("")}, {1.0}}), std::invalid_argument);
}

}  // namespace quadrature_test
