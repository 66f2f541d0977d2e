#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

// Powers of steps. Those of time are in the data, not asserted: they move with the machine's other work.

namespace cost_growth_test {

/// Number in the row of a subject.
double fit(const std::string& subject, const char* column) {
  return data::quick.number("cost_growth_fit", {{"subject", subject}}, column);
}

TEST(CostGrowth, OfAnOrbitWithEccentricityIsThePredictedPower) {
  // Twice what was measured, with order 8.
  const std::map<std::string, double> bounds{{"none", 0.03},           {"gamma = 0.5", 0.011},
                                             {"gamma = 0.625", 0.005}, {"gamma = 0.75", 0.015},
                                             {"gamma = 0.875", 0.017}, {"gamma = 1", 0.02}};
  for (const auto& [subject, bound] : bounds) {
    EXPECT_GE(fit(subject, "points"), 4) << subject;
    EXPECT_NEAR(fit(subject, "steps_exponent"), fit(subject, "steps_predicted"), bound) << subject;
  }
  // The control: the powers are told apart.
  EXPECT_LT(fit("gamma = 0.5", "steps_exponent"), fit("gamma = 0.75", "steps_exponent") - 0.25);
}

TEST(CostGrowth, ComparesRunsOfOneAccuracy) {
  const auto orbits = data::quick.rows("cost_growth", {{"axis", "closeness"}});
  for (const auto& row : orbits)
    EXPECT_NEAR(row.number("energy_error"), 1e-6, 3.1e-8) << row.text("value");
  EXPECT_GT(orbits.size(), 30U);
}

TEST(CostGrowth, WithTheHorizonIsLinear) {
  for (const char* method : {"stationary8", "stormer_verlet", "log_hamiltonian"})
    EXPECT_NEAR(fit(method, "steps_exponent"), 1.0, 2e-3) << method;
}

TEST(CostGrowth, WithTheDimensionIsLinear) {
  // Seconds: 0.86 to 1.0 were measured. Partials carried forward would give 2, which no other load hides.
  for (const char* subject : {"energy", "gradient", "sweep"})
    EXPECT_NEAR(fit(subject, "seconds_exponent"), 1.0, 0.4) << subject;
}

/// Seconds of a subject in dimension n.
double seconds(const std::string& subject, const char* n) {
  return data::quick.number("cost_growth", {{"subject", subject}, {"value", n}}, "seconds");
}

TEST(CostGrowth, ARunWithAnAutomaticGradientTakesLittleMoreThanWithASuppliedOne) {
  // The aim is 2. 1.4 to 1.5 times was measured, 2.0 beside other work, which this test may have: hence twice
  // that measured.
  EXPECT_LT(seconds("sweep", "32"), 2.8 * seconds("sweep, supplied gradient", "32"));
}

TEST(CostGrowth, ASweepCostsTheSameNumberOfEvaluationsOfHInEveryDimension) {
  std::vector<double> evaluations;
  for (const char* n : {"2", "32", "512"})
    evaluations.push_back(seconds("sweep", n) / seconds("energy", n));
  const auto [least, most] = std::minmax_element(evaluations.begin(), evaluations.end());
  EXPECT_GT(*least, 0.0);
  // The aim is 2. 2.1 to 2.9 were measured, 2.6 with nothing beside, the most at n = 2, where a recorded
  // program spends its time on finding the next operation. Partials carried forward would give 256.
  EXPECT_LT(*most, 3.8 * *least);
}

}  // namespace cost_growth_test
