#include "avi/core/inverse.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

TEST(Inverse, GivesTheIdentityWhenMultiplied) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  avi::Matrix<double, 6> a;
  avi::Matrix<double, avi::dynamic> b(6, 6);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      b(i, j) = a(i, j) = entry(random);
  EXPECT_LT((a * avi::inverse(a) - avi::Matrix<double, 6>::Identity()).norm(), 1e-13);
  EXPECT_EQ((avi::inverse(a) - avi::inverse(b)).norm(), 0.0) << "one code path for both kinds of size";
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

}  // namespace
