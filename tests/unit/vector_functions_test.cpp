#include "avi/autodiff/pack.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

// Against the functions of long double, which the library computes to 64 bits.

using avi::Pack;

namespace vector_functions_test {

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

/// One after the other of two functions of x and of x + apart, from x on, in packs of every width.
void expect_the_same_bits(const auto& one, const auto& other, double x, double apart,
                          std::uint64_t expected) {
  const auto bits = [&](auto at) {
    std::uint64_t sum = 0;
    for (int i = 0; i < 2000; ++i, at += decltype(at)(0.37)) {
      sum = 31 * sum + std::bit_cast<std::uint64_t>(one(at)[1]);
      sum = 31 * sum + std::bit_cast<std::uint64_t>(other(at + apart)[1]);
    }
    return sum;
  };
  EXPECT_EQ(bits(Pack<2>(x)), expected);
  EXPECT_EQ(bits(Pack<16>(x)), expected);
}

// From g++ and clang++, with and without vector units.
TEST(Functions, HaveTheSameBitsInPacksOfEveryWidth) {
  expect_the_same_bits([](const auto& x) { return sin(x); }, [](const auto& x) { return cos(x); }, -40.0, 0.0,
                       11435245501632831496u);
  expect_the_same_bits([](const auto& x) { return exp(x); }, [](const auto& x) { return log(x); }, -400.0,
                       401.0, 18414034011676480847u);
}

/// The error of a function at x in one number of a pack, in units in the last place.
template <class F>
double error_of(F f, double x) {
  Pack<8> all(1.25);
  all.set(5, x);
  return units(f(all)[5], f(static_cast<long double>(x)));
}
const auto exponential = [](auto x) {
  using std::exp;
  return exp(x);
};
const auto logarithm = [](auto x) {
  using std::log;
  return log(x);
};

/// The largest error at x = at(a) for many a at random, and at some edges.
template <class F, class At>
double worst_error(F f, At at, std::initializer_list<double> edges) {
  std::mt19937_64 random(2);
  double worst = 0.0;
  for (const double range : {1e-9, 0.3, 2.0, 30.0, 708.0}) {
    std::uniform_real_distribution<double> numbers(-range, range);
    for (int i = 0; i < 40'000; ++i)
      worst = std::fmax(worst, error_of(f, at(numbers(random))));
  }
  for (const double edge : edges)
    worst = std::fmax(worst, error_of(f, edge));
  return worst;
}

TEST(Exponential, IsRightToAUnitInTheLastPlace) {
  const double ln2 = std::log(2.0);
  const double worst = worst_error(exponential, [](double a) { return a; },
                                   {-708.0, 709.0, ln2 / 2.0, -ln2 / 2.0, 0.0, -0.0, 5e-324});
  EXPECT_LT(worst, 0.95);  // 0.89 was measured, with four million points in each range
  EXPECT_GT(worst, 0.5);
}

TEST(Logarithm, IsRightToAUnitInTheLastPlace) {
  const double worst = worst_error(logarithm, [](double a) { return std::exp(a); },
                                   {0x1p-1022, 0x1.fffffffffffffp1023, std::sqrt(0.5), std::sqrt(2.0), 2.0});
  EXPECT_LT(worst, 0.95);  // 0.84
  EXPECT_GT(worst, 0.5);
  EXPECT_EQ(log(Pack<2>(1.0))[1], 0.0);
}

TEST(Exponential, BeyondItsBoundsIsThatOfTheLibrary) {
  Pack<4> x(1.0);
  x.set(1, -740.0);  // not a normal number
  x.set(2, 709.9);
  x.set(3, NAN);
  EXPECT_EQ(exp(x)[0], std::exp(1.0));
  EXPECT_EQ(exp(x)[1], std::exp(-740.0));
  EXPECT_EQ(exp(x)[2], INFINITY);
  EXPECT_TRUE(std::isnan(exp(x)[3]));
  EXPECT_EQ(exp(Pack<4>(-INFINITY))[3], 0.0);
}

TEST(Logarithm, BeyondItsBoundsIsThatOfTheLibrary) {
  Pack<4> x(2.0);
  x.set(1, 1e-310);
  x.set(2, 0.0);
  x.set(3, -1.0);
  EXPECT_EQ(log(x)[0], std::log(2.0));
  EXPECT_EQ(log(x)[1], std::log(1e-310));
  EXPECT_EQ(log(x)[2], -INFINITY);
  EXPECT_TRUE(std::isnan(log(x)[3]));
  EXPECT_EQ(log(Pack<4>(INFINITY))[3], INFINITY);
  EXPECT_TRUE(std::isnan(log(Pack<4>(NAN))[3]));
}

}  // namespace vector_functions_test
