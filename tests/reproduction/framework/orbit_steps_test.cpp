#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

// One orbit with its steps: as many for each monitor, and closed but for the one of equal steps in time.

namespace orbit_steps_test {

TEST(OrbitSteps, CloseTheOrbitInAsManySteps) {
  const auto& summary = data::quick("orbit_steps_summary");
  std::map<std::string, double> error;
  for (std::size_t i = 0; i < summary.rows.size(); ++i) {
    EXPECT_EQ(summary.number(i, "steps"), 36.0);
    error[summary.text(i, "monitor")] = summary.number(i, "energy_error");
  }
  // Measured 8.5e-2, 4.1e-9, 7.9e-11 and 9.0e-8.
  EXPECT_GT(error.at("none"), 0.04);
  EXPECT_LT(error.at("r"), 9e-9);
  EXPECT_LT(error.at("r^1.5"), 1.6e-10);
  EXPECT_LT(error.at("r^2"), 1.8e-7);
  const auto& table = data::quick("orbit_steps");
  std::map<std::string, double> last;  // distance of the last point from the pericentre
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    last[table.text(i, "monitor")] = std::hypot(table.number(i, "q_1") - 0.1, table.number(i, "q_2"));
  EXPECT_LT(last.at("r^1.5"), 6e-4);  // h comes from a sum of fine steps
  EXPECT_GT(last.at("none"), 0.1);
}

}  // namespace orbit_steps_test
