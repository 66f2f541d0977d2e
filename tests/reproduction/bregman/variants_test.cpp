#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

// Variants of Bregman methods that the paper mentions: what theory says of each.

namespace variants_test {

std::vector<double> column(const std::string& variant, const char* name) {
  std::vector<double> found;
  for (const auto& row : data::quick.rows("variants", {{"variant", variant}}))
    found.push_back(row.number(name));
  return found;
}

/// Type II at the published step is the published run (in other coordinates); Type III converges at every
/// step.
TEST(Variants, TypeThreeIsStableAtEveryStep) {
  const auto second = column("type_2", "sustained"), third = column("type_3", "sustained");
  ASSERT_EQ(second.size(), 4u);
  EXPECT_EQ(column("type_2", "first_passage")[0], 9360.0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(std::isfinite(second[i]), i == 0) << i;
    ASSERT_TRUE(std::isfinite(third[i])) << i;
    if (i > 0) {
      EXPECT_LT(third[i], third[i - 1]);
    }
  }
}

/// Without momentum the same proximal steps need no more iterations.
TEST(Variants, MomentumDoesNotSpeedProximalStepsUp) {
  const auto with = column("type_3", "sustained"), without = column("proximal_points", "sustained");
  ASSERT_EQ(without.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT(without[i], with[i]);
}

/// The distance to the limit equation is of the order of the square root of h.
TEST(Variants, NesterovFollowsItsLimitEquation) {
  const auto distance = column("nag_limit", "value");
  ASSERT_EQ(distance.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_NEAR(distance[i - 1] / distance[i], 2.0, 0.1);
}

TEST(Variants, MirrorDescentKeepsToItsBoundOnTheSimplex) {
  for (const double ratio : column("mirror", "value"))
    EXPECT_LT(ratio, 1.0);  // NaN, an iterate off the simplex, fails too
}

}  // namespace variants_test
