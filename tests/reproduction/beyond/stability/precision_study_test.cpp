#include "common/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

// The shortened study: energy over forty periods, positions after three.

using experiment::Table;

namespace {

Table data(const std::string& stem) {
  return Table::read(std::string(AVI_CHECK_DIR) + "/quick/" + stem + ".tsv");
}

double energy_error(double e, const std::string& summation) {
  const Table table = data("precision_study_fits");
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (std::abs(table.number(i, "eccentricity") - e) < 1e-9 && table.text(i, "summation") == summation)
      return table.number(i, "energy_error");
  ADD_FAILURE() << "no row " << e << ' ' << summation;
  return std::nan("");
}

TEST(PrecisionStudy, CompensationKeepsTheEnergyAtRoundOff) {
  EXPECT_LT(energy_error(0.9, "compensated"), 8e-14) << "measured 3.9e-14";
  EXPECT_LT(energy_error(0.99, "compensated"), 9.1e-13) << "measured 4.5e-13";
  EXPECT_GT(energy_error(0.9, "plain"), 2.0 * energy_error(0.9, "compensated"));
  EXPECT_GT(energy_error(0.99, "plain"), 2.0 * energy_error(0.99, "compensated"));
}

/// Rounding that favours a sign would give 1, as it does where sweeps end at a change of 1e-16. Nine starts
/// over 1000 periods tell the power to about 0.05; over 10 000 it is 0.55.
TEST(PrecisionStudy, EnergyOfCollocationGrowsAsTheRootOfTime) {
  const Table table = data("precision_study_fits");
  int rows = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "method") == "collocation16" &&
        std::abs(table.number(i, "eccentricity") - 0.9) < 1e-9) {
      ++rows;
      EXPECT_LT(table.number(i, "exponent"), 0.7) << "measured 0.55 to 0.62";
      EXPECT_LT(table.number(i, "exponent_far"), 0.7) << "measured 0.55 to 0.62";
      EXPECT_LT(table.number(i, "energy_error_far"), 3e-14);
    }
  EXPECT_EQ(rows, 1);
}

TEST(PrecisionStudy, EveryFormatReachesItsFloor) {
  const Table table = data("precision_study");
  const auto least = [&](const std::string& format, const std::string& summation) {
    double best = 1.0;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      if (table.text(i, "format") == format && table.text(i, "summation") == summation)
        best = std::min(best, table.number(i, "position_error"));
    return best;
  };
  EXPECT_LT(least("float", "plain"), 3e-5);
  EXPECT_LT(least("double", "plain"), 2.2e-13);
  EXPECT_LT(least("long double", "plain"), 1e-14);
  EXPECT_GT(least("float", "plain"), 1e3 * least("double", "plain"));
}

}  // namespace
