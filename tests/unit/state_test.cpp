#include "avi/core/state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace state_test {

TEST(State, IsFiniteWhereEveryEntryIs) {
  const double big = std::numeric_limits<double>::max(), inf = std::numeric_limits<double>::infinity();
  const auto finite = [](double q, double p, double t) {
    return avi::State<2>{.q = {q, q}, .p = {p, p}, .t = t}.finite();
  };
  EXPECT_TRUE(finite(1.0, 2.0, 3.0));
  EXPECT_TRUE(finite(big, big, 0.0)) << "the sum is not, the entries are";
  EXPECT_FALSE(finite(inf, 0.0, 0.0));
  EXPECT_FALSE(finite(0.0, NAN, 0.0));
  EXPECT_FALSE(finite(0.0, 0.0, -inf));
  EXPECT_FALSE(finite(inf, -inf, 0.0));
}

}  // namespace state_test
