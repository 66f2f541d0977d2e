#include "common/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

// Powers of steps. Those of time are in the data, not asserted: they move with the machine's other work.

namespace {

experiment::Table data(const std::string& curve = "") {
  return experiment::Table::read(std::string(AVI_CHECK_DIR) + "/quick/cost_growth" + curve + ".tsv");
}

/// Number in the row of a subject; NaN without such a row.
double fit(const experiment::Table& table, const std::string& subject, const std::string& column) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "subject") == subject) return table.number(i, column);
  return std::nan("");
}

TEST(CostGrowth, OfAnOrbitWithEccentricityIsThePredictedPower) {
  const auto table = data("_fit");
  // Twice what was measured.
  const std::map<std::string, double> bounds{{"none", 0.03},           {"gamma = 0.5", 0.011},
                                             {"gamma = 0.625", 0.005}, {"gamma = 0.75", 0.003},
                                             {"gamma = 0.875", 0.005}, {"gamma = 1", 0.017}};
  for (const auto& [subject, bound] : bounds) {
    EXPECT_GE(fit(table, subject, "points"), 4) << subject;
    EXPECT_NEAR(fit(table, subject, "steps_exponent"), fit(table, subject, "steps_predicted"), bound)
        << subject;
  }
  // The control: the powers are told apart.
  EXPECT_LT(fit(table, "gamma = 0.5", "steps_exponent"), fit(table, "gamma = 0.75", "steps_exponent") - 0.25);
}

TEST(CostGrowth, ComparesRunsOfOneAccuracy) {
  const auto table = data();
  int orbits = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "axis") == "closeness") {
      ++orbits;
      EXPECT_NEAR(table.number(i, "energy_error"), 1e-6, 3.1e-8) << i;
    }
  EXPECT_GT(orbits, 30);
}

TEST(CostGrowth, WithTheHorizonIsLinear) {
  const auto table = data("_fit");
  for (const char* method : {"htvi4", "stormer_verlet", "log_hamiltonian"})
    EXPECT_NEAR(fit(table, method, "steps_exponent"), 1.0, 2e-3) << method;
}

TEST(CostGrowth, WithTheDimensionIsLinear) {
  const auto table = data("_fit");
  // Seconds: 0.86 to 1.0 were measured. Partials carried forward would give 2, which no other load hides.
  for (const char* subject : {"energy", "gradient", "sweep"})
    EXPECT_NEAR(fit(table, subject, "seconds_exponent"), 1.0, 0.4) << subject;
}

}  // namespace
