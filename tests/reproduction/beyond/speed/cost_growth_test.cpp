#include "common/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

// Powers of steps. Those of time are in the data, not asserted: they move with the machine's other work.

namespace cost_growth_test {

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
  // Twice what was measured, with order 8.
  const std::map<std::string, double> bounds{{"none", 0.03},           {"gamma = 0.5", 0.011},
                                             {"gamma = 0.625", 0.005}, {"gamma = 0.75", 0.015},
                                             {"gamma = 0.875", 0.017}, {"gamma = 1", 0.02}};
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
  for (const char* method : {"stationary8", "stormer_verlet", "log_hamiltonian"})
    EXPECT_NEAR(fit(table, method, "steps_exponent"), 1.0, 2e-3) << method;
}

TEST(CostGrowth, WithTheDimensionIsLinear) {
  const auto table = data("_fit");
  // Seconds: 0.86 to 1.0 were measured. Partials carried forward would give 2, which no other load hides.
  for (const char* subject : {"energy", "gradient", "sweep"})
    EXPECT_NEAR(fit(table, subject, "seconds_exponent"), 1.0, 0.4) << subject;
}

/// Seconds of a subject in dimension n.
double seconds(const experiment::Table& table, const std::string& subject, double n) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "subject") == subject && table.number(i, "value") == n)
      return table.number(i, "seconds");
  return std::nan("");
}

TEST(CostGrowth, ARunWithAnAutomaticGradientTakesLittleMoreThanWithASuppliedOne) {
  const auto table = data();
  // The aim is 2. 1.4 to 1.5 times was measured, 2.0 beside other work, which this test may have: hence twice
  // that measured.
  EXPECT_LT(seconds(table, "sweep", 32), 2.8 * seconds(table, "sweep, supplied gradient", 32));
}

TEST(CostGrowth, ASweepCostsTheSameNumberOfEvaluationsOfHInEveryDimension) {
  const auto table = data();
  std::vector<double> evaluations;
  for (const double n : {2.0, 32.0, 512.0})
    evaluations.push_back(seconds(table, "sweep", n) / seconds(table, "energy", n));
  const auto [least, most] = std::minmax_element(evaluations.begin(), evaluations.end());
  EXPECT_GT(*least, 0.0);
  // The aim is 2. 2.1 to 2.9 were measured, 2.6 with nothing beside, the most at n = 2, where a recorded
  // program spends its time on finding the next operation. Partials carried forward would give 256.
  EXPECT_LT(*most, 3.8 * *least);
}

}  // namespace cost_growth_test
