#include "reproduction/data.hpp"

#include <gtest/gtest.h>

// The lemmas of the paper's appendix, order on extended phase space with and without a singular p-Hessian,
// and symplecticity in (q, t, p, p^t), by a second route that does not use the library.

namespace statements_test {

TEST(Statements, PowersAreThoseStated) {
  int steps = 0;
  for (const auto& row : data::whole.rows("statements")) {
    const auto& statement = row.text("statement");
    if (statement == "extended symplecticity") continue;
    EXPECT_GE(row.number("points"), 4) << statement;
    EXPECT_GT(row.number("measured"), row.number("expected") - 0.35) << statement << " r = " << row.text("r");
    if (!statement.ends_with("step")) continue;
    ++steps;
    EXPECT_LT(row.number("measured"), row.number("expected") + 0.9) << statement << " r = " << row.text("r");
  }
  EXPECT_EQ(steps, 12);
}

TEST(Statements, StepsAreSymplecticOnExtendedPhaseSpace) {
  const auto rows = data::whole.rows("statements", {{"statement", "extended symplecticity"}});
  for (const auto& row : rows)
    EXPECT_LT(row.number("measured"), 1.1e-13) << "measured 3.1e-14 and 5.5e-14";
  EXPECT_EQ(rows.size(), 2U);
}

}  // namespace statements_test
