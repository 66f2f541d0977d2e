#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

// One orbit with its steps: as many for each monitor, and closed but for the one of equal steps in time.

namespace orbit_steps_test {

TEST(OrbitSteps, CloseTheOrbitInAsManySteps) {
  std::map<std::string, double> error;
  for (const auto& row : data::quick.rows("orbit_steps_summary")) {
    EXPECT_EQ(row.number("steps"), 36.0);
    error[row.text("monitor")] = row.number("energy_error");
  }
  // Measured 8.5e-2, 4.1e-9, 7.9e-11 and 9.0e-8.
  EXPECT_GT(error.at("none"), 0.04);
  EXPECT_LT(error.at("r"), 9e-9);
  EXPECT_LT(error.at("r^1.5"), 1.6e-10);
  EXPECT_LT(error.at("r^2"), 1.8e-7);
  std::map<std::string, double> last;  // distance of the last point from the pericentre
  for (const auto& row : data::quick.rows("orbit_steps"))
    last[row.text("monitor")] = std::hypot(row.number("q_1") - 0.1, row.number("q_2"));
  EXPECT_LT(last.at("r^1.5"), 6e-4);  // h comes from a sum of fine steps
  EXPECT_GT(last.at("none"), 0.1);
}

}  // namespace orbit_steps_test
