#include "avi/core/state.hpp"

#include "refusal.hpp"

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

TEST(State, EqualsWhatHasTheSameNumbers) {
  const avi::State<2> z{.q = {1.0, 2.0}, .p = {3.0, 4.0}, .t = 5.0};
  EXPECT_TRUE(z == z);
  for (int part = 0; part < 3; ++part) {
    avi::State<2> other = z;
    (part == 0 ? other.q[1] : part == 1 ? other.p[1] : other.t) += 1.0;
    EXPECT_FALSE(z == other) << part;
  }
}

TEST(State, IsRefusedWhereItsDimensionIsNone) {
  const auto said = [](int q, int p) {
    const avi::State<avi::dynamic> z{.q = avi::VectorX::Zero(q), .p = avi::VectorX::Zero(p)};
    return refusal([&] { avi::require_dimension(z); });
  };
  EXPECT_EQ(said(1, 1), "accepted");
  EXPECT_EQ(said(0, 0), "Dimension of q at the start is 0; it must be at least 1.");
  EXPECT_EQ(said(2, 3), "Dimension of p at the start is 3; it must be that of q, 2.");
}

}  // namespace state_test
