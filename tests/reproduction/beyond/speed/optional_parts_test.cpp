#include "common/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

// What parts change in the number of expansions; the time they take is in the data, not asserted.

namespace optional_parts_test {

double evaluations(const experiment::Table& table, const std::string& order, const std::string& part) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "order") == order && table.text(i, "part") == part)
      return table.number(i, "evaluations_per_step");
  return std::nan("");
}

TEST(OptionalParts, ChangeTheNumberOfExpansionsAsTheyShould) {
  const auto table = experiment::Table::read(std::string(AVI_CHECK_DIR) + "/quick/optional_parts.tsv");
  EXPECT_GE(table.rows.size(), 24u);
  for (const std::string order : {"4", "8"}) {
    const double bare = evaluations(table, order, "bare");
    EXPECT_GT(bare, 1.0);
    for (const char* part :
         {"observer: energy each step", "dense output in each step", "order known to the compiler"})
      EXPECT_EQ(evaluations(table, order, part), bare) << part;
    // The same formulas in another order of addition.
    for (const char* part : {"automatic gradient", "t and p^t as coordinates"})
      EXPECT_NEAR(evaluations(table, order, part), bare, 0.1 * bare) << part;
    EXPECT_GT(evaluations(table, order, "landing at 10 times in 200 steps"), bare + 0.05);
  }
}

}  // namespace optional_parts_test
