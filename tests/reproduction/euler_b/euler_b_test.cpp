#include "euler_b/euler_b_runs.hpp"

#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

using experiment::run_euler_b;

namespace euler_b_test {

// On Kepler's problem |grad V| = 1 / |q|^2, so the truncation-error monitor is (2 tol / h^2) |q|^2: at
// matched scale it is g = q . q, the same steps and the same orbit. The paper finds that the one "used
// significantly more steps".
TEST(EulerB, TruncationMonitorIsTheNormSquaredMonitor) {
  const double h = 1e-3;
  const auto truncation = run_euler_b({"truncation", h, 0.5 * h * h}, 0.9, 1000.0);
  const auto norm_squared = run_euler_b({"norm_squared", h}, 0.9, 1000.0);
  EXPECT_EQ(truncation.steps, 2298342);
  EXPECT_EQ(norm_squared.steps, 2298342);
  EXPECT_NEAR(truncation.energy_error, 1.03e-3, 0.005e-3);
  EXPECT_NEAR(truncation.energy_error / norm_squared.energy_error, 1.0, 3e-9);
}

TEST(EulerB, ArclengthTakesATenthMoreAndPlainStepsTheMost) {
  EXPECT_EQ(run_euler_b({"arclength", 1e-3}, 0.9, 1000.0).steps, 2542859);
  EXPECT_NEAR(run_euler_b({"none", 1e-3}, 0.9, 1000.0).energy_error, 5.75e-2, 0.005e-2);
}

TEST(EulerB, AngularMomentumIsKeptToRoundOff) {
  for (const char* monitor : {"none", "arclength", "norm_squared"})
    EXPECT_LT(run_euler_b({monitor, 1e-3}, 0.9, 100.0).angular_momentum_error, 1e-13) << monitor;
}

TEST(EulerB, CostAtMatchedErrorRanksTheMonitors) {
  std::map<std::string, double> steps;
  for (const auto& row : data::quick.rows("euler_b_cost")) {
    EXPECT_NEAR(row.number("energy_error") / row.number("target"), 1.0, 0.02);
    if (row.number("target") == 1e-3) steps[row.text("monitor")] = row.number("steps");
  }
  EXPECT_NEAR(steps.at("truncation") / steps.at("norm_squared"), 1.0, 1e-3);
  EXPECT_NEAR(steps.at("arclength") / steps.at("norm_squared"), 1.10, 0.02);
  EXPECT_GT(steps.at("truncation_root") / steps.at("norm_squared"), 5.0);  // measured 7.5
  EXPECT_GT(steps.at("none") / steps.at("norm_squared"), 20.0);            // measured 23
}

TEST(EulerB, LargestStepsAtEqualErrorAreThoseOfBothFirstMonitors) {
  std::map<std::string, double> largest;
  for (const auto& row : data::quick.rows("euler_b_step_sizes"))
    largest[row.text("monitor")] = row.number("max_step");
  EXPECT_NEAR(largest.at("truncation") / largest.at("norm_squared"), 1.0, 1e-5);
  EXPECT_GT(largest.at("norm_squared"), largest.at("arclength"));
}

}  // namespace euler_b_test
