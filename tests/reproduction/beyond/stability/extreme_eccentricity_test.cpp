#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

// What the largest usable steps say, and that every run that is not good says so.

namespace extreme_eccentricity_test {

const std::set<std::string> failures{"energy",     "phase",       "step_limit", "not_converged",
                                     "non_finite", "bad_monitor", "diverged"};

TEST(ExtremeEccentricity, EveryRunIsGoodOrNamed) {
  const auto& table = data::quick("extreme_eccentricity");
  ASSERT_GT(table.rows.size(), 30U);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (std::isnan(table.number(i, "h"))) {
      EXPECT_TRUE(failures.contains(table.text(i, "beyond"))) << i;
      continue;
    }
    EXPECT_LE(table.number(i, "energy_error"), 1e-2) << i;
    EXPECT_LE(std::abs(table.number(i, "phase_error")), 0.1) << i;
    EXPECT_TRUE(failures.contains(table.text(i, "beyond"))) << i;
  }
}

/// Steps per orbit of a method and monitor at 1 - e = closeness; NaN where there are none.
double steps(const std::string& method, const std::string& monitor, double closeness,
             const std::string& precision = "double") {
  for (const auto& row : data::quick.rows(
           "extreme_eccentricity",
           {{"method", method}, {"monitor", monitor}, {"bounded", "0"}, {"precision", precision}}))
    if (std::abs(row.number("closeness") / closeness - 1.0) < 1e-9) return row.number("steps_per_orbit");
  return std::nan("");
}

/// Elliptic integral: equal steps in the integral of r^-1.5 dt.
double K(double closeness) { return std::log(4.0 / std::sqrt(0.5 * closeness)); }

TEST(ExtremeEccentricity, CostGrowsAsPredicted) {
  const auto growth = [&](const char* method, const char* monitor, double from, double to) {
    return std::log(steps(method, monitor, to) / steps(method, monitor, from)) / std::log(to / from);
  };
  // Measured -0.615, -0.097, -0.505 and 0.001; the largest step is known to 2 %, hence a power over one
  // decade to 0.01. Beyond 1 - e = 1e-5 order 8 with r^1.5 is limited by more than its order.
  EXPECT_NEAR(growth("stationary8", "r", 1e-3, 1e-4), -0.625, 0.02);
  EXPECT_NEAR(growth("stationary8", "r^1.5", 1e-1, 1e-4) - std::log(K(1e-4) / K(1e-1)) / std::log(1e-3),
              -0.125, 0.05);
  EXPECT_NEAR(growth("hairer_soderlind", "r^1.5", 1e-1, 1e-4) - std::log(K(1e-4) / K(1e-1)) / std::log(1e-3),
              -0.5, 0.02);
  EXPECT_NEAR(growth("log_hamiltonian", "1/V", 1e-1, 1e-7), 0.0, 0.01);
  // Collocation of order 16: -0.561; -0.049, which the convergence of the sweeps, not the order, begins.
  EXPECT_NEAR(growth("collocation16", "r", 1e-4, 1e-7), -0.5 - 1.0 / 16.0, 0.02);
  EXPECT_NEAR(growth("collocation16", "r^1.5", 1e-4, 1e-7) - std::log(K(1e-7) / K(1e-4)) / std::log(1e-3),
              -1.0 / 16.0, 0.03);
}

TEST(ExtremeEccentricity, RoundingAtTheApocentreIsAmplifiedAtThePericentre) {
  // Rounding moves the conserved g (H + p^t); a change made at the apocentre is (2 / (1 - e))^1.5 times as
  // large an energy at the pericentre. In single precision that is 1e-7 x 90 = 1e-5 at 1 - e = 0.1, and 9e-3
  // at 1e-3, nearly all that is allowed.
  EXPECT_NEAR(steps("stationary8", "r^1.5", 0.1, "single") / steps("stationary8", "r^1.5", 0.1), 1.0, 0.05);
  EXPECT_TRUE(std::isnan(steps("stationary8", "r^1.5", 1e-3, "single")));
  EXPECT_GT(steps("stationary8", "r^1.5", 1e-7), 0.0);
  // The logarithmic Hamiltonian conserves log(T + p^t) - log U, which has no such ratio.
  EXPECT_GT(steps("log_hamiltonian", "1/V", 1e-7, "single"), 0.0);
}

TEST(ExtremeEccentricity, OnACircleAdaptivityCostsNothing) {
  EXPECT_LT(steps("stationary8", "r^1.5", 1.0), 1.1 * steps("stationary8", "none", 1.0));
  EXPECT_LT(steps("stationary8", "r^2", 1.0), 1.1 * steps("stationary8", "none", 1.0));
}

}  // namespace extreme_eccentricity_test
