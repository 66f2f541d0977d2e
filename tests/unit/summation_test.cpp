#include "avi/core/summation.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace summation_test {

TEST(Summation, KeepsWhatRoundingCutsOff) {
  double kept = 1.0, low = 0.0, plain = 1.0, unused = 0.0;
  for (int i = 0; i < 1000; ++i) {
    avi::add<avi::Summation::compensated>(kept, low, 1e-17);
    avi::add<avi::Summation::plain>(plain, unused, 1e-17);
  }
  EXPECT_NEAR(kept - 1.0 + low, 1e-14, 1e-18);
  EXPECT_EQ(kept, 1.0 + 45.0 * std::numeric_limits<double>::epsilon()) << "1e-14 is 45.04 ulp";
  EXPECT_EQ(plain, 1.0);
  EXPECT_EQ(unused, 0.0);
}

}  // namespace summation_test
