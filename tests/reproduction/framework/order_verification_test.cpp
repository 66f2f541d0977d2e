#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace order_verification_test {

std::vector<scorecard::Row> cells(scorecard::Cells wanted = {}) {
  return data::quick.rows("order_verification", wanted);
}

std::string describe(const scorecard::Row& cell) {
  return cell.text("problem") + ' ' + cell.text("type") + ' ' + cell.text("construction") +
         " r = " + cell.text("r") + ' ' + cell.text("quadrature");
}

// The theorem of Section 2.2: order min(r + 1, s) at least, for every Taylor order, rule, type and problem.
TEST(OrderTheorem, HoldsInEveryCell) {
  for (const auto& cell : cells())
    EXPECT_GT(cell.number("measured_order"), cell.number("expected_order") - 0.25) << describe(cell);
}

// Where the bound is attained the order is it and not more, so a method of lower order could not pass.
TEST(OrderTheorem, BoundIsAttainedByThePrintedConstruction) {
  const auto all = cells({{"construction", "printed"}, {"problem", "kepler_gamma"}});
  const auto attained = std::ranges::count_if(all, [](const auto& cell) {
    return std::abs(cell.number("measured_order") - cell.number("expected_order")) < 0.25;
  });
  EXPECT_GT(attained, 0.75 * all.size()) << "of " << all.size();
}

// Order min(2r + 2, max(r + 1, s)), neither less nor more, on every class of problem.
TEST(StationaryAction, HasTwiceTheOrder) {
  std::set<std::string> problems;
  for (const auto& cell : cells({{"construction", "stationary"}})) {
    problems.insert(cell.text("problem"));
    EXPECT_GE(cell.number("points"), 3) << describe(cell);
    EXPECT_NEAR(cell.number("measured_order"), cell.number("expected_order"), 0.15) << describe(cell);
  }
  EXPECT_EQ(problems.size(), 8u);
}

// The control: with the velocity of the field in the action no problem has it.
TEST(StationaryAction, IsWhatDoublesTheOrder) {
  for (const auto& cell : cells({{"construction", "printed"}, {"quadrature", "gauss4"}}))
    if (const double r = cell.number("r"); r >= 1.0) {
      EXPECT_LT(cell.number("measured_order"), 2.0 * r + 2.0 - 0.5) << describe(cell);
    }
}

}  // namespace order_verification_test
