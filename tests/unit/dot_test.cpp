#include "avi/core/dot.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dot_test {

TEST(Dot, AddsEightPartialSumsAsATree) {
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

}  // namespace dot_test
