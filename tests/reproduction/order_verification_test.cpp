// quick: order_verification
#include "avi/io/table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace {

avi::Table cells() { return avi::Table::read(std::string(AVI_CHECK_DIR) + "/quick/order_verification.tsv"); }

// The theorem of Section 2.2: order min(r + 1, s) at least, for every Taylor order, rule, type and problem.
TEST(OrderTheorem, HoldsInEveryCell) {
  const auto table = cells();
  EXPECT_EQ(table.rows.size(), 4u * 2u * 2u * 4u * 16u) << "problems, types, constructions, r = 0..3, rules";
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    EXPECT_GT(table.number(i, "measured_order"), table.number(i, "expected_order") - 0.25)
        << table.text(i, "problem") << ' ' << table.text(i, "type") << ' ' << table.text(i, "construction")
        << " r = " << table.text(i, "r") << ' ' << table.text(i, "quadrature");
}

// Where the bound is attained the order is it and not more, so a method of lower order could not pass.
TEST(OrderTheorem, BoundIsAttainedByThePrintedConstruction) {
  const auto table = cells();
  int attained = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "construction") == "printed" && table.text(i, "problem") == "kepler_gamma")
      attained += std::abs(table.number(i, "measured_order") - table.number(i, "expected_order")) < 0.25;
  EXPECT_GT(attained, 100) << "of 128";
}

}  // namespace
