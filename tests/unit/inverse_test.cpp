#include "avi/core/inverse.hpp"

#include <gtest/gtest.h>

#include <random>

namespace inverse_test {

/// Of random matrices of n rows, with the size known to the compiler or not.
template <int n>
void expect_inverses() {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  for (int k = 0; k < 20; ++k) {
    avi::Matrix<double, n> a;
    avi::Matrix<double, avi::dynamic> b(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        b(i, j) = a(i, j) = entry(random) + (i == j ? 2.0 : 0.0);
    const avi::Matrix<double, n> inverse = avi::inverse(a);
    EXPECT_LT((a * inverse - avi::Matrix<double, n>::Identity()).norm(), 2.6e-15)
        << n << ", measured 1.3e-15";
    EXPECT_LE((inverse - avi::inverse(b)).norm(), n == 2 ? 4.7e-16 : 0.0) << n << ", measured 2.3e-16 and 0";
  }
}

TEST(Inverse, GivesTheIdentityWhenMultiplied) {
  expect_inverses<1>();
  expect_inverses<2>();
  expect_inverses<3>();
  expect_inverses<4>();
  expect_inverses<7>();
}

TEST(Inverse, PivotsWhereTheDiagonalVanishes) {
  avi::Matrix<double, 2> a, exact;
  a << 0.0, 2.0, 4.0, 0.0;
  exact << 0.0, 0.25, 0.5, 0.0;
  EXPECT_EQ(avi::inverse(a), exact);
}

TEST(Inverse, IsNotFiniteWhereThereIsNone) {
  EXPECT_FALSE(avi::inverse(avi::Matrix<double, 2>{{1.0, 2.0}, {2.0, 4.0}}).allFinite());
}

}  // namespace inverse_test
