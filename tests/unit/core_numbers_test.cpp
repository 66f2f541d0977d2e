#include "avi/core/fixed_order.hpp"
#include "avi/core/power.hpp"
#include "avi/core/state.hpp"
#include "avi/core/summation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

TEST(FixedOrder, AddsEightPartialSumsAsATree) {
  for (const int n : {0, 1, 7, 8, 9, 16, 27}) {
    avi::VectorX a(n), b(n);
    double lanes[8] = {};
    for (int i = 0; i < n; ++i) {
      a[i] = 1.0 / (i + 3.0);
      b[i] = std::sqrt(i + 2.0);
      lanes[i % 8] += a[i] * b[i];
    }
    const double tree =
        ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
    EXPECT_EQ(avi::dot(a, b), tree) << n;
    EXPECT_EQ(avi::norm(a), std::sqrt(avi::dot(a, a)));
  }
}

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

}  // namespace
