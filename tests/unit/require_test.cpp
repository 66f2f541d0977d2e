#include "avi/core/require.hpp"

#include "refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace require_test {

TEST(Require, NamesTheValueToItsLastBitAndTheRange) {
  EXPECT_EQ(refusal([] { avi::require_positive("Step", -(0.1 + 0.2)); }),
            "Step is -0.30000000000000004; it must be finite and positive.");
  EXPECT_EQ(refusal([] { avi::require(false, "Order", 3, "even"); }), "Order is 3; it must be even.");
}

TEST(Require, HoldsForNoNaN) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double value : {nan, infinity, -infinity, 0.0, -1.0}) {
    EXPECT_THROW(avi::require_positive("Step", value), std::invalid_argument) << value;
    if (value != 0.0 && value != -1.0) {
      EXPECT_THROW(avi::require_finite("Time", value), std::invalid_argument) << value;
    }
  }
  EXPECT_EQ(avi::require_positive("Step", 0.5), 0.5);
  EXPECT_EQ(avi::require_finite("Time", -1.0), -1.0);
}

}  // namespace require_test
