#include "common/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

// The lemmas of the paper's appendix, order on extended phase space with and without a singular p-Hessian,
// and symplecticity in (q, t, p, p^t), by a second route that does not use the library.

namespace statements_test {

const experiment::Table& table() {  // read when it is there: this source shares a program with others
  static const auto data =
      experiment::Table::read(std::filesystem::path(AVI_CHECK_DIR) / "data/statements.tsv");
  return data;
}

TEST(Statements, PowersAreThoseStated) {
  int steps = 0;
  for (std::size_t i = 0; i < table().rows.size(); ++i) {
    const auto& statement = table().text(i, "statement");
    if (statement == "extended symplecticity") continue;
    EXPECT_GE(table().number(i, "points"), 4) << statement;
    EXPECT_GT(table().number(i, "measured"), table().number(i, "expected") - 0.35)
        << statement << " r = " << table().text(i, "r");
    if (!statement.ends_with("step")) continue;
    ++steps;
    EXPECT_LT(table().number(i, "measured"), table().number(i, "expected") + 0.9)
        << statement << " r = " << table().text(i, "r");
  }
  EXPECT_EQ(steps, 12);
}

TEST(Statements, StepsAreSymplecticOnExtendedPhaseSpace) {
  int seen = 0;
  for (std::size_t i = 0; i < table().rows.size(); ++i)
    if (table().text(i, "statement") == "extended symplecticity") {
      ++seen;
      EXPECT_LT(table().number(i, "measured"), 1.1e-13) << "measured 3.1e-14 and 5.5e-14";
    }
  EXPECT_EQ(seen, 2);
}

}  // namespace statements_test
