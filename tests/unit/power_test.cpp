#include "avi/core/power.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace power_test {

TEST(Power, IsPow) {
  for (const double x : {0.3, 1.0, 2.7, 1e5})
    for (double exponent = -9.0; exponent <= 9.0; exponent += 0.25)
      EXPECT_NEAR(avi::power(x, exponent) / std::pow(x, exponent), 1.0, 4e-15) << x << '^' << exponent;
  EXPECT_EQ(avi::power(3.0, 0.0), 1.0);
  EXPECT_EQ(avi::power(4.0, 1.5), 8.0);
  EXPECT_EQ(avi::power(2.0, 8.0), 256.0);
  EXPECT_EQ(avi::power(2.0, -8.0), 1.0 / 256.0);
  int otherwise = 0;  // how often std::pow rounds otherwise than products
  for (double x = 1.01; x < 2.0; x += 0.01) {
    const double square = x * x, fourth = square * square;
    EXPECT_EQ(avi::power(x, 8.0), fourth * fourth) << "by multiplication up to 8";
    EXPECT_EQ(avi::power(x, 8.5), std::pow(x, 8.5)) << "and no further";
    otherwise += avi::power(x, 8.0) != std::pow(x, 8.0);
  }
  EXPECT_GT(otherwise, 20);
  EXPECT_EQ(avi::power(2.0L, 0.5), std::sqrt(2.0L)) << "other scalars by their own pow";
}

TEST(Power, IsWithinTheErrorThatItStates) {
  double worst = 0.0, worst_negative = 0.0;
  for (double x = 0.01; x < 100.0; x *= 1.00213)
    for (double exponent = -8.0; exponent <= 8.0; exponent += 0.5) {
      const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(exponent));
      const double ours = avi::power(x, exponent), ulp = std::nextafter(ours, 1e300) - ours;
      double& most = exponent < 0.0 ? worst_negative : worst;
      most = std::max(most, std::abs(static_cast<double>(ours - exact)) / ulp);
    }
  EXPECT_LT(worst, 6.0);
  EXPECT_LT(worst_negative, 7.0);
  EXPECT_GT(worst_negative, 3.0);
  EXPECT_EQ(avi::power(1e39, -8.0), 0.0);
}

TEST(AccuratePower, IsTheNearestNumber) {
  // long double has eleven bits more: a half and its own error of an ulp.
  double x = 0.7;
  for (int k = 0; k < 20'000; ++k, x += 1.37e-4)
    for (const int n : {1, 2, 3, 7, 10, 64}) {
      const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(n));
      const double ours = avi::accurate_power(x, n), ulp = std::nextafter(ours, 1e300) - ours;
      ASSERT_LE(std::abs(static_cast<double>(ours - exact)), 0.51 * ulp) << x << '^' << n;
    }
  for (const double exponent : {0.0, -3.0, 0.25, 65.0, 2.5})
    EXPECT_EQ(avi::accurate_power(1.7, exponent), std::pow(1.7, exponent));
  EXPECT_EQ(avi::accurate_power(1e100, 4.0), HUGE_VAL);
  EXPECT_TRUE(std::isnan(avi::accurate_power(NAN, 4.0)));
}

}  // namespace power_test
