#include "avi/core/power.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

TEST(Power, IsPow) {
  for (const double x : {0.3, 1.0, 2.7, 1e5})
    for (double exponent = -9.0; exponent <= 9.0; exponent += 0.25)
      EXPECT_NEAR(avi::power(x, exponent) / std::pow(x, exponent), 1.0, 4e-15) << x << '^' << exponent;
  EXPECT_EQ(avi::power(3.0, 0.0), 1.0);
  EXPECT_EQ(avi::power(4.0, 1.5), 8.0);
  EXPECT_EQ(avi::power(2.0, 8.0), 256.0);
  EXPECT_EQ(avi::power(2.0, -8.0), 1.0 / 256.0);
  EXPECT_EQ(avi::power(2.0L, 0.5), std::sqrt(2.0L)) << "other scalars by their own pow";
}

}  // namespace
