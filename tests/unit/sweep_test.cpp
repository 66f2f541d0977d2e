#include "avi/optim/sweep.hpp"

#include <gtest/gtest.h>

using avi::VectorX;

namespace sweep_test {

TEST(Sweep, ChangesAndSumsAsSeparatePassesDo) {
  for (Eigen::Index n : {1, 7, 8, 9, 50, 1000}) {
    const VectorX a = VectorX::LinSpaced(n, -1.3, 2.7), b = VectorX::LinSpaced(n, 0.1, 9.3);
    VectorX c(n);
    const auto sums = avi::sweep<2>(n, [a = a.data(), b = b.data(), c = c.data()](auto at, auto& sum) {
      const auto product = at(a) * at(b);
      at.set(c, at(a) + 0.5 * at(b));
      sum[0] += product;
      sum[1] += at(a) * at(a);
    });
    EXPECT_EQ(c, a + 0.5 * b);
    EXPECT_EQ(sums[0], avi::dot(a, b)) << n;  // to the last bit: the same order of addition
    EXPECT_EQ(sums[1], avi::dot(a, a)) << n;
  }
}

}  // namespace sweep_test
