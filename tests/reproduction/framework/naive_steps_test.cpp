#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

// A thousand orbits with variable steps: what drifts and what does not.

namespace naive_steps_test {

TEST(NaiveSteps, DriftAndTheTransformedProblemDoesNot) {
  std::map<std::string, std::map<int, double>> error;  // by method and whole decades of periods
  for (const auto& row : data::quick.rows("naive_steps")) {
    const double decade = std::log10(row.number("periods"));
    if (std::abs(decade - std::round(decade)) < 1e-6)
      error[row.text("method")][static_cast<int>(std::lround(decade))] = row.number("energy_error");
  }
  // Measured: 1.342e-5 and 1.342e-5; 1.8e-4, 8.4e-3 and 7.4e-2; 1.1e-4, 3.2e-3 and 2.8e-2.
  EXPECT_LT(error["collocation"][3], 1.02 * error["collocation"][0]);
  EXPECT_LT(error["collocation"][3], 2.7e-5);
  for (const char* control : {"naive", "error_controlled"}) {
    EXPECT_GT(error[control][2], 10.0 * error[control][0]) << control;
    EXPECT_GT(error[control][3], 4.0 * error[control][2]) << control;
    EXPECT_GT(error[control][3], 0.014) << control;
  }
}

}  // namespace naive_steps_test
