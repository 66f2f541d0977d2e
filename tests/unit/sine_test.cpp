#include "avi/autodiff/pack.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

// Against the sines of long double, which the library computes to 64 bits.

using avi::Pack;

namespace sine_test {

/// Distance from what it should be, in units in the last place of that.
double units(double found, long double exact) {
  const double nearest = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(nearest, INFINITY) - nearest;
  return static_cast<double>(std::abs(static_cast<long double>(found) - exact)) / unit;
}

/// The larger error of sine and cosine, in units in the last place, with x in one number of a pack.
double error(double x) {
  Pack<8> all(0.25);
  all.set(5, x);
  const auto exactly = static_cast<long double>(x);
  return std::fmax(units(sin(all)[5], std::sin(exactly)), units(cos(all)[5], std::cos(exactly)));
}

TEST(Sine, IsRightToAUnitInTheLastPlace) {
  std::mt19937_64 random(1);
  double worst = 0.0;
  for (const double range : {0.5, 4.0, 100.0, 1e4, 8e5}) {
    std::uniform_real_distribution<double> angles(-range, range);
    for (int i = 0; i < 40'000; ++i)
      worst = std::fmax(worst, error(angles(random)));
  }
  EXPECT_LT(worst, 0.85);  // 0.79 was measured, with two million points each
  EXPECT_GT(worst, 0.5);   // it has been measured
}

TEST(Sine, LosesNothingNearMultiplesOfAQuarterTurn) {
  double worst = 0.0;
  for (long k = 0; k < 509'000; k += k < 10'000 ? 1 : 37) {
    const auto multiple = static_cast<double>(static_cast<long double>(k) * (M_PIl / 2.0L));
    for (const double x : {multiple, std::nextafter(multiple, 0.0), std::nextafter(multiple, 1e9), -multiple})
      worst = std::fmax(worst, error(x));
  }
  EXPECT_LT(worst, 0.85);  // 0.80 was measured
}

TEST(Sine, OfSmallNumbersZerosAndWhatIsNotANumber) {
  for (const double x : {0.0, -0.0, 5e-324, -1e-310, 1e-200, 3e-9}) {
    EXPECT_EQ(sin(Pack<4>(x))[2], x);
    EXPECT_EQ(std::signbit(sin(Pack<4>(x))[2]), std::signbit(x));
    EXPECT_EQ(cos(Pack<4>(x))[2], 1.0);
  }
  Pack<4> x(1.0);
  x.set(1, NAN);
  x.set(2, INFINITY);
  x.set(3, -1e22);  // beyond the range, where the library does it
  EXPECT_NEAR(sin(x)[0], std::sin(1.0), 2e-16);
  for (const int i : {1, 2}) {
    EXPECT_TRUE(std::isnan(sin(x)[i]));
    EXPECT_TRUE(std::isnan(cos(x)[i]));
  }
  EXPECT_EQ(sin(x)[3], std::sin(-1e22));
  EXPECT_EQ(cos(x)[3], std::cos(-1e22));
  for (const double edge : {7.9e5, 8e5, 8.1e5})
    EXPECT_LE(error(edge), 0.85) << edge;
}

TEST(Sine, HasTheSameBitsInPacksOfEveryWidth) {
  std::uint64_t bits[2] = {0, 0};
  const auto take = [&]<int w>(Pack<w> x, std::uint64_t& sum) {
    for (int i = 0; i < 2000; ++i, x += Pack<w>(0.37)) {
      sum = 31 * sum + std::bit_cast<std::uint64_t>(sin(x)[1]);
      sum = 31 * sum + std::bit_cast<std::uint64_t>(cos(x)[1]);
    }
  };
  take(Pack<2>(-40.0), bits[0]);
  take(Pack<16>(-40.0), bits[1]);
  EXPECT_EQ(bits[0], bits[1]);
  // From g++ and clang++, with and without vector units.
  EXPECT_EQ(bits[0], 11435245501632831496u);
}

}  // namespace sine_test
