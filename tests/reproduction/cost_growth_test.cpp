// quick: cost_growth
#include "avi/io/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

// Powers of steps. Those of time are in the data, not asserted: they move with the machine's other work.

namespace {

avi::Table data(const std::string& curve = "") {
  return avi::Table::read(std::string(AVI_CHECK_DIR) + "/quick/cost_growth" + curve + ".tsv");
}

/// Number in the row of a subject; NaN without such a row.
double fit(const avi::Table& table, const std::string& subject, const std::string& column) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "subject") == subject) return table.number(i, column);
  return std::nan("");
}

TEST(CostGrowth, OfAnOrbitWithEccentricityIsThePredictedPower) {
  const auto table = data("_fit");
  // Twice what was measured. An orbit with gamma = 7/8 is limited by neither end alone.
  const std::map<std::string, double> bounds{{"none", 0.03},           {"gamma = 0.5", 0.016},
                                             {"gamma = 0.625", 0.01},  {"gamma = 0.75", 0.012},
                                             {"gamma = 0.875", 0.055}, {"gamma = 1", 0.027}};
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
      EXPECT_NEAR(table.number(i, "energy_error"), 1e-4, 3.1e-6) << i;
    }
  EXPECT_GT(orbits, 30);
}

TEST(CostGrowth, WithTheHorizonIsLinear) {
  const auto table = data("_fit");
  for (const char* method : {"htvi4", "stormer_verlet", "log_hamiltonian"})
    EXPECT_NEAR(fit(table, method, "steps_exponent"), 1.0, 2e-3) << method;
}

}  // namespace
