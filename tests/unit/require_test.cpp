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

TEST(Require, WritesNoMoreDigitsThanTellANumberFromAllOthers) {
  using avi::detail::joined;
  EXPECT_EQ(joined({0.1, " ", 0.0, " ", -0.0, " ", 3e6, " ", 1e300, " ", std::nan(""), " ", -HUGE_VAL}),
            "0.1 0 -0 3000000 1e+300 nan -inf");
  for (const double number : {0.1 + 0.2, 1.0 / 3.0, 2.2250738585072014e-308, 1e15 + 0.125, -M_PI * 1e-9})
    EXPECT_EQ(std::stod(joined({number})), number);
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
