#include "common/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace order_verification_test {

using experiment::Table;

Table cells() { return Table::read(std::string(AVI_CHECK_DIR) + "/quick/order_verification.tsv"); }

std::string describe(const Table& table, std::size_t i) {
  return table.text(i, "problem") + ' ' + table.text(i, "type") + ' ' + table.text(i, "construction") +
         " r = " + table.text(i, "r") + ' ' + table.text(i, "quadrature");
}

// The theorem of Section 2.2: order min(r + 1, s) at least, for every Taylor order, rule, type and problem.
TEST(OrderTheorem, HoldsInEveryCell) {
  const Table table = cells();
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    EXPECT_GT(table.number(i, "measured_order"), table.number(i, "expected_order") - 0.25)
        << describe(table, i);
}

// Where the bound is attained the order is it and not more, so a method of lower order could not pass.
TEST(OrderTheorem, BoundIsAttainedByThePrintedConstruction) {
  const Table table = cells();
  int attained = 0, all = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "construction") == "printed" && table.text(i, "problem") == "kepler_gamma") {
      ++all;
      attained += std::abs(table.number(i, "measured_order") - table.number(i, "expected_order")) < 0.25;
    }
  EXPECT_GT(attained, 0.75 * all) << "of " << all;
}

// Order min(2r + 2, max(r + 1, s)), neither less nor more, on every class of problem.
TEST(StationaryAction, HasTwiceTheOrder) {
  const Table table = cells();
  std::set<std::string> problems;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.text(i, "construction") != "stationary") continue;
    problems.insert(table.text(i, "problem"));
    EXPECT_GE(table.number(i, "points"), 3) << describe(table, i);
    EXPECT_NEAR(table.number(i, "measured_order"), table.number(i, "expected_order"), 0.15)
        << describe(table, i);
  }
  EXPECT_EQ(problems.size(), 8u);
}

// The control: with the velocity of the field in the action no problem has it.
TEST(StationaryAction, IsWhatDoublesTheOrder) {
  const Table table = cells();
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (const double r = table.number(i, "r");
        table.text(i, "construction") == "printed" && table.text(i, "quadrature") == "gauss4" && r >= 1.0) {
      EXPECT_LT(table.number(i, "measured_order"), 2.0 * r + 2.0 - 0.5) << describe(table, i);
    }
}

}  // namespace order_verification_test
