#include "common/problems/correlated_quartic.hpp"

#include "difference.hpp"

#include <gtest/gtest.h>

using avi::VectorX, experiment::CorrelatedQuartic;

namespace correlated_quartic_test {

VectorX wave(Eigen::Index n) {
  VectorX x(n);
  for (Eigen::Index i = 0; i < n; ++i)
    x[i] = 1.0 + std::sin(1.7 * static_cast<double>(i) + 0.3);
  return x;
}

Eigen::MatrixXd correlation(Eigen::Index n, double rho) {
  Eigen::MatrixXd sigma(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      sigma(i, j) = std::pow(rho, std::abs(i - j));
  return sigma;
}

TEST(CorrelatedQuartic, RecurrencesAreTheDenseProduct) {
  for (double rho : {0.9, -0.5, 0.0, 0.999}) {
    for (Eigen::Index n : {1, 2, 50, 301}) {
      const VectorX y = wave(n);
      VectorX z(n);
      experiment::multiply_by_correlation(rho, y, z);
      const VectorX dense = correlation(n, rho) * y;
      EXPECT_LT((z - dense).cwiseAbs().maxCoeff(),
                1e-15 * static_cast<double>(n + 10) * (1.0 + dense.norm()));
    }
  }
}

TEST(CorrelatedQuartic, GradientIsThatOfTheValue) {
  const CorrelatedQuartic f(50, 0.9);
  const VectorX x = wave(50);
  VectorX g(50);
  const double value = f(x, g);
  EXPECT_EQ(value, f.value(x));
  const VectorX y = x.array() - 1.0;
  EXPECT_NEAR(value, std::pow(y.dot(correlation(50, 0.9) * y), 2), 1e-12 * value);
  EXPECT_LT(gradient_defect([&](const VectorX& at) { return f.value(at); }, x, g, 1e-3), 1e-8 * g.norm());
}

TEST(CorrelatedQuartic, KnowsItsMinimum) {
  const CorrelatedQuartic f(50, 0.9);
  VectorX g(50);
  EXPECT_EQ(f(f.minimiser(), g), CorrelatedQuartic::minimum);
  EXPECT_EQ(g.norm(), 0.0);
  EXPECT_GT(f.value(wave(50)), 0.0);
}

TEST(CorrelatedQuartic, IsThatOfThePaperUnlessToldOtherwise) {
  const CorrelatedQuartic f;
  EXPECT_EQ(f.start(), VectorX::Constant(50, 5.0));
  const double form = 16.0 * correlation(50, 0.9).sum();
  EXPECT_NEAR(f.value(f.start()), form * form, 1e-12 * form * form);
}

}  // namespace correlated_quartic_test
