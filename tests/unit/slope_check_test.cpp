#include "src/minimise/slope_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace slope_check_test {

using avi::VectorX;

TEST(SlopeCheck, SlopesByValuesAreAsUncertainAsTheySay) {
  for (const double h : {1e-1, 1e-3, 1e-5, 1e-7}) {
    const auto found = avi::slope_by_values([](double s) { return std::exp(std::sin(s + 0.3)); }, h);
    const double slope = std::cos(0.3) * std::exp(std::sin(0.3));
    EXPECT_LT(std::abs(found.slope - slope), found.uncertainty) << h;
    EXPECT_LT(found.uncertainty, std::max(1.5 * h * h, 1e-13 / h)) << h;
    EXPECT_TRUE(found.agrees_with(slope, 0.0)) << h;
    EXPECT_TRUE(found.agrees_with(1.1 * slope, 0.11 * slope)) << h;
    EXPECT_FALSE(found.agrees_with(1.1 * slope, 0.055 * slope)) << h;
    EXPECT_TRUE(found.agrees_with(std::nan(""), 0.0)) << "says nothing about the gradient";
  }
}

TEST(SlopeCheck, RoundingOfXHidesASlopeAtTheMinimumOfSmoothFunctionsOnly) {
  const double resolution = 0x1p-52;
  const auto lost = [&](auto phi, double slope) {
    return avi::lost_in_rounding(phi, phi(0.0), slope, resolution);
  };
  const auto smooth = [](double s) { return 1e20 * s * s; };
  EXPECT_TRUE(lost(smooth, -1.5e5));  // eight units of the resolution change its slope by 3.6e5
  EXPECT_FALSE(lost(smooth, -4e5));
  EXPECT_TRUE(lost([](double s) { return -std::cos(1e10 * s); }, -1e4));
  EXPECT_FALSE(lost([](double s) { return std::cos(1e10 * s); }, -1e4)) << "a maximum";
  EXPECT_FALSE(lost([](double s) { return 1e20 * std::abs(s); }, -1e4)) << "a kink";
  EXPECT_FALSE(lost([](double s) { return s > 1e-16 ? 1e20 : 0.0; }, -1e4)) << "a jump";
  EXPECT_FALSE(lost([](double) { return 1e20; }, -1e-4)) << "flat";
  EXPECT_FALSE(lost([](double s) { return 0.5 * s * s; }, 1.0)) << "another slope";
  // A thousand units are several periods.
  EXPECT_TRUE(lost([](double s) { return -std::cos(0x1p49 * s); }, -1e14));
  EXPECT_FALSE(lost([](double s) { return std::cos(0x1p49 * s); }, -1e14)) << "a maximum";
}

TEST(SlopeCheck, EveryEntryTakesPartByItsSize) {
  for (const double scale : {1e-200, 1e-3, 1.0, 1e6}) {
    VectorX x(100), d(100);
    for (int i = 0; i < 100; ++i)
      x[i] = scale * (i % 3 == 0 ? 0.0 : i % 3 == 1 ? -1.0 : 0.2);
    avi::mixed_direction(x, d);
    double lightest = 2.0, heaviest = 0.0;
    int ahead = 0;
    for (int i = 0; i < 100; ++i) {
      const double weight = std::abs(d[i]) / (scale * (i % 3 == 0 ? 0.01 : i % 3 == 1 ? 1.0 : 0.2));
      lightest = std::min(lightest, weight);
      heaviest = std::max(heaviest, weight);
      ahead += d[i] > 0.0;
    }
    EXPECT_GE(lightest, 0.5 - 1e-15);
    EXPECT_LT(lightest, 0.6) << "100 weights fill their range";
    EXPECT_LE(heaviest, 1.5 + 1e-15);
    EXPECT_GT(heaviest, 1.4);
    EXPECT_NEAR(ahead, 50, 20);
  }
  VectorX d(2);
  avi::mixed_direction(VectorX::Zero(2), d);
  EXPECT_GE(d.cwiseAbs().minCoeff(), 0.5) << "at the origin, size 1";
}

}  // namespace slope_check_test
