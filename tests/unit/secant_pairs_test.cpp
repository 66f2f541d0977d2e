#include "avi/optim/secant_pairs.hpp"

#include <Eigen/LU>

#include <gtest/gtest.h>

using avi::VectorX;

namespace {

/// The BFGS inverse, formed: H+ = (I - rho s y^T) H (I - rho y s^T) + rho s s^T.
TEST(SecantPairs, GiveTheDirectionOfTheFormedMatrix) {
  constexpr Eigen::Index n = 11;
  constexpr int m = 4;
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      a(i, j) += 1.0 / static_cast<double>(i + j + 1);
  avi::SecantPairs pairs(m, n);
  VectorX g = VectorX::LinSpaced(n, -1.0, 2.0), d(n);
  pairs.direction(g, d);
  EXPECT_EQ(d, VectorX(-g));
  std::vector<std::pair<VectorX, VectorX>> stored;
  for (int k = 0; k < 7; ++k) {  // more than there is room for
    VectorX s(n);
    for (Eigen::Index i = 0; i < n; ++i)
      s[i] = std::sin(1.0 + static_cast<double>(i * (k + 1)));
    const VectorX y = a * s;
    Eigen::Map<VectorX>(pairs.next_s(), n) = s;
    Eigen::Map<VectorX>(pairs.next_y(), n) = y;
    pairs.commit(s.dot(y), y.squaredNorm());
    stored.emplace_back(s, y);
    if (stored.size() > m) stored.erase(stored.begin());
    Eigen::MatrixXd h = Eigen::MatrixXd::Identity(n, n) * (s.dot(y) / y.squaredNorm());
    for (const auto& [si, yi] : stored) {
      const double rho = 1.0 / si.dot(yi);
      const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n) - rho * si * yi.transpose();
      h = left * h * left.transpose() + rho * si * si.transpose();
    }
    pairs.direction(g, d);
    EXPECT_EQ(pairs.size(), std::min(k + 1, m));
    EXPECT_LT((d + h * g).norm(), 1e-12 * d.norm()) << k;
    pairs.direction(y, d);
    EXPECT_LT((d + s).norm(), 1e-12 * s.norm()) << "secant equation, pair " << k;
  }
  pairs.clear();
  pairs.direction(g, d);
  EXPECT_EQ(d, VectorX(-g));
}

}  // namespace
