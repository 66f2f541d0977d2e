#include "avi/autodiff/pack.hpp"
#include "avi/core/vector.hpp"
#include "unit/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

using avi::Pack, avi::Vector;

namespace pack_test {

constexpr int with_exponentials = 0, with_sines = 1;

template <int w>
Pack<w> ramp(double first, double step) {
  Pack<w> x;
  for (int i = 0; i < w; ++i)
    x.set(i, first + i * step);
  return x;
}

template <class Check>
void for_each_formula(Check check) {
  std::apply([&](const auto&... f) { (check(f), ...); }, elementary);
}

template <int w>
void every_number_goes_its_own_way() {
  const Pack<w> x = ramp<w>(0.7, 0.11), y = ramp<w>(1.3, -0.01);
  int count = 0;
  for_each_formula([&](const auto& f) {
    const Pack<w> z = f(x, y);
    const auto gradient = [&f](const auto& v) { return f(v[0], v[1]); };
    const auto g = avi::value_and_gradient(gradient, Vector<Pack<w>, 2>(x, y)).gradient();
    for (int i = 0; i < w; ++i) {
      const auto g_i = avi::value_and_gradient(gradient, Vector<double, 2>(x[i], y[i])).gradient();
      // Sines and exponentials are not those of the library.
      const bool other = count == with_sines || count == with_exponentials;
      const double exact = f(x[i], y[i]), away = other ? 4e-16 * (1.0 + std::abs(exact)) : 0.0;
      EXPECT_NEAR(z[i], exact, away) << "formula " << count << ", number " << i << " of " << w;
      for (int k = 0; k < 2; ++k)
        EXPECT_NEAR(g[k][i], g_i[k], 4e-16 * (1.0 + std::abs(g_i[k]))) << "formula " << count;
    }
    ++count;
  });
}

TEST(Pack, DoesWithEachNumberWhatADoubleDoes) {
  every_number_goes_its_own_way<2>();
  every_number_goes_its_own_way<4>();
  every_number_goes_its_own_way<8>();
  every_number_goes_its_own_way<16>();
  every_number_goes_its_own_way<32>();
}

TEST(Pack, PowersWithQuartersOfAnIntegerAreRootsAndProducts) {
  const Pack<8> x = ramp<8>(0.05, 0.9);
  for (int quarters = -36; quarters <= 36; ++quarters) {
    const double exponent = 0.25 * quarters;
    const Pack<8> y = pow(x, exponent);
    for (int i = 0; i < 8; ++i) {
      const double exact = std::pow(x[i], exponent);
      EXPECT_NEAR(y[i], exact, 1e-15 * exact) << x[i] << "^" << exponent;
    }
  }
}

TEST(Pack, IsAScalarOfVectors) {
  const auto inverse_distance = [](const auto& q) { return pow(q.dot(q), -0.5) + 0.5 * q.squaredNorm(); };
  const Pack<4> x = ramp<4>(1.0, 0.5), y = ramp<4>(2.0, -0.25);
  const Vector<Pack<4>, 2> q(x, y), shifted = 0.5 * q + q * y;
  const auto g = avi::value_and_gradient(inverse_distance, q).gradient();
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(shifted[0][i], 0.5 * x[i] + x[i] * y[i]);
    const double cube = std::pow(x[i] * x[i] + y[i] * y[i], -1.5);
    EXPECT_NEAR(g[0][i], x[i] - x[i] * cube, 1e-15);
    EXPECT_NEAR(g[1][i], y[i] - y[i] * cube, 1e-15);
  }
  Vector<Pack<8>, avi::dynamic> many(5);  // memory with the alignment of a double's vector
  for (int i = 0; i < 5; ++i)
    many[i] = ramp<8>(i, 0.125);
  EXPECT_EQ(avi::sum(Pack<8>(many.dot(many))), [&] {
    Pack<8> s = many[0] * many[0];
    for (int i = 1; i < 5; ++i)
      s += many[i] * many[i];
    return avi::sum(s);
  }());
}

TEST(Pack, SumsAndLargestSeeEveryNumber) {
  for (int i = 0; i < 8; ++i) {
    Pack<8> x(1.0);
    x.set(i, 9.0);
    EXPECT_EQ(avi::sum(x), 16.0);
    EXPECT_EQ(avi::largest(x), 9.0);
    EXPECT_EQ(avi::largest(-x), 9.0);
    EXPECT_EQ(avi::sum(max_abs(x, Pack<8>(-2.0))), 9.0 + 7 * 2.0);
    x.set(i, std::nan(""));
    EXPECT_TRUE(std::isnan(avi::largest(x)));
    EXPECT_TRUE(std::isnan(avi::sum(x)));
    EXPECT_TRUE(std::isnan(avi::largest(max_abs(x, Pack<8>(-2.0)))));
    EXPECT_TRUE(std::isnan(avi::largest(max_abs(Pack<8>(-2.0), x))));
    EXPECT_FALSE(std::isnan(x.each([](double v) { return std::isnan(v) ? 0.0 : v; })[i]));
  }
}

}  // namespace pack_test
