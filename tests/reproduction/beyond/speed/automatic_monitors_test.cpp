#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

// The monitors that solve() chooses, on five of the problems.

namespace automatic_monitors_test {

TEST(AutomaticMonitors, AreNearTheBestMadeByHand) {
  std::set<std::string> problems;
  for (const auto& row : data::quick.rows("automatic_monitors_choices")) {
    problems.insert(row.text("problem"));
    const std::string which = row.text("problem") + " " + row.text("order");
    // Measured: at most 1.07 times the least work by hand and 1.5 times the fewest steps; choosing of 0.05 to
    // 0.38 of the sweeps of some hundred periods.
    EXPECT_LT(row.number("choosing_share"), 0.6) << which;
    // The poles of Lennard-Jones' potential cost 1.6 times what a power of r does, and fixed steps three
    // times.
    const bool by_poles = row.text("problem") == "lennard_jones";
    if (by_poles) {
      EXPECT_EQ(row.text("choice"), "poles") << which;
    }
    EXPECT_LT(row.number("chosen_work_ratio"), by_poles ? 2.0 : 1.5) << which;
    EXPECT_LT(row.number("chosen_ratio"), 2.5) << which;
    EXPECT_LT(row.number("chosen_work_ratio"), 1.1 * row.number("none_work_ratio")) << which;
  }
  EXPECT_EQ(problems.size(), 5u);
}

TEST(AutomaticMonitors, HaveTheErrorsOfTheirTargets) {
  const auto table = data::quick.rows("automatic_monitors");
  for (const auto& row : table) {
    if (row.text("problem") == "lennard_jones" && row.number("order") == 4.0) continue;
    const double order = row.number("order"), position = order == 4 ? 1e-4 : order == 8 ? 1e-7 : 1e-10;
    if (row.text("target") == "position")
      EXPECT_LE(row.number("position_error"), position);
    else
      EXPECT_LE(row.number("energy_error"), 0.1 * position);
  }
  EXPECT_EQ(table.size(), 30u);
}

TEST(AutomaticMonitors, DoNotDriftOverTenThousandPeriods) {
  const auto table = data::quick.rows("automatic_monitors_drift");
  ASSERT_EQ(table.size(), 5u);
  for (const auto& row : table) {
    const std::string problem = row.text("problem");
    EXPECT_EQ(row.text("outcome"), "ok") << problem;
    EXPECT_EQ(row.number("horizons"), 1000.0);
    // Changes of what rounding alone does, or of a small part of the error, and none that goes on.
    const double error = row.number("energy_error");
    EXPECT_LT(error, 1e-4) << problem;
    EXPECT_LT(std::abs(row.number("slope_times_horizon")), std::max(1e-3 * error, row.number("rounding")))
        << problem;
    EXPECT_TRUE(std::abs(row.number("corrected_t")) < 3.0 ||
                std::abs(row.number("slope_times_horizon")) < 0.01 * row.number("rounding"))
        << problem;
    // The naive control loses 0.4 in this time; here the last tenth is as good as the first.
    EXPECT_NEAR(row.number("last_tenth") / row.number("first_tenth"), 1.0, 0.05) << problem;
  }
}

}  // namespace automatic_monitors_test
