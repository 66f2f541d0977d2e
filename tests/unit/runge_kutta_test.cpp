#include "avi/integrators/runge_kutta.hpp"

#include <gtest/gtest.h>

#include <utility>

using avi::VectorX;

namespace runge_kutta_test {

/// Sums over the tableau that the order conditions fix, for orders up to 5 as far as the quadrature
/// conditions sum b c^(k-1) = 1/k and the first tree conditions go.
template <class T>
void expect_order(const std::array<double, T::stages>& b, int order) {
  constexpr auto s = static_cast<std::size_t>(T::stages);
  std::array<double, s> c{}, ac{}, ac2{}, aac{};
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j)
      c[i] += T::a[i][j];
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j)
      ac[i] += T::a[i][j] * c[j], ac2[i] += T::a[i][j] * c[j] * c[j];
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j)
      aac[i] += T::a[i][j] * ac[j];
  const auto sum = [&](auto term) {
    double total = 0.0;
    for (std::size_t i = 0; i < s; ++i)
      total += b[i] * term(i);
    return total;
  };
  for (int k = 1; k <= order; ++k)
    EXPECT_NEAR(sum([&](std::size_t i) { return std::pow(c[i], k - 1); }), 1.0 / k, 1e-14)
        << T::stages << " stages, " << k;
  if (order >= 3) {
    EXPECT_NEAR(sum([&](std::size_t i) { return ac[i]; }), 1.0 / 6.0, 1e-14) << T::stages << " stages";
  }
  if (order >= 4) {
    EXPECT_NEAR(sum([&](std::size_t i) { return c[i] * ac[i]; }), 1.0 / 8.0, 1e-14) << T::stages << " stages";
    EXPECT_NEAR(sum([&](std::size_t i) { return ac2[i]; }), 1.0 / 12.0, 1e-14) << T::stages << " stages";
    EXPECT_NEAR(sum([&](std::size_t i) { return aac[i]; }), 1.0 / 24.0, 1e-14) << T::stages << " stages";
  }
  if (order >= 5) {
    EXPECT_NEAR(sum([&](std::size_t i) { return c[i] * c[i] * ac[i]; }), 1.0 / 10.0, 1e-14)
        << T::stages << " stages";
    EXPECT_NEAR(sum([&](std::size_t i) { return ac[i] * ac[i]; }), 1.0 / 20.0, 1e-14)
        << T::stages << " stages";
  }
}

TEST(Tableaus, SatisfyTheOrderConditions) {
  using namespace avi;
  expect_order<ClassicalRungeKutta>(ClassicalRungeKutta::b, ClassicalRungeKutta::order);
  expect_order<BogackiShampine>(BogackiShampine::b, BogackiShampine::order);
  expect_order<BogackiShampine>(BogackiShampine::embedded, BogackiShampine::embedded_order);
  expect_order<DormandPrince>(DormandPrince::b, DormandPrince::order);
  expect_order<DormandPrince>(DormandPrince::embedded, DormandPrince::embedded_order);
}

/// Volterra-Lotka: nonlinear, so that no order is reached by linearity.
void rabbits(const VectorX& z, VectorX& dz) {
  dz[0] = z[0] * (1.0 - z[1]);
  dz[1] = z[1] * (z[0] - 1.0);
}

template <class T>
VectorX fixed_steps(int steps) {
  VectorX z = Eigen::Vector2d(0.6, 1.4);
  avi::RungeKuttaStages<T> stages(2);
  for (int k = 0; k < steps; ++k) {
    rabbits(z, stages.k[0]);
    stages.advance(rabbits, z, 2.0 / steps);
    z = stages.end;
  }
  return z;
}

template <class T>
double measured_order() {
  const VectorX reference = fixed_steps<avi::DormandPrince>(2000);
  return std::log2((fixed_steps<T>(40) - reference).norm() / (fixed_steps<T>(80) - reference).norm());
}

TEST(RungeKutta, ConvergesWithItsOrder) {
  EXPECT_NEAR(measured_order<avi::BogackiShampine>(), 3.0, 0.1);
  EXPECT_NEAR(measured_order<avi::ClassicalRungeKutta>(), 4.0, 0.1);
  EXPECT_NEAR(measured_order<avi::DormandPrince>(), 5.0, 0.15);
}

/// Error at t = 2 and number of steps of an adaptive run at tolerance `tol`.
template <class T>
std::pair<double, int> adaptive(double tol) {
  const avi::StepControl control{.rtol = tol, .atol = tol};
  VectorX z = Eigen::Vector2d(0.6, 1.4);
  avi::RungeKuttaStages<T> stages(2);
  double t = 0.0, h = 1e-3;
  int steps = 0;
  for (; t < 2.0 && steps < 100000; ++steps) {
    rabbits(z, stages.k[0]);
    h = std::min(h, 2.0 - t);
    const double taken = avi::controlled_step(stages, rabbits, z, h, control);
    EXPECT_GT(taken, 0.0);
    t += taken;
    z = stages.end;
  }
  return {(z - fixed_steps<avi::DormandPrince>(2000)).norm(), steps};
}

TEST(EmbeddedRungeKutta, ErrorFollowsTheTolerance) {
  for (double tol : {1e-4, 1e-6, 1e-8}) {
    const auto [error5, steps5] = adaptive<avi::DormandPrince>(tol);
    const auto [error3, steps3] = adaptive<avi::BogackiShampine>(tol);
    EXPECT_LT(error5, 20.0 * tol);
    EXPECT_LT(error3, 20.0 * tol);
    EXPECT_LT(steps5, steps3);
  }
}

TEST(EmbeddedRungeKutta, GivesUpOnWhatCannotBeStepped) {
  avi::RungeKuttaStages<avi::DormandPrince> stages(1);
  const auto broken = [](const VectorX&, VectorX& dz) { dz[0] = std::nan(""); };
  double h = 0.1;
  VectorX z = VectorX::Ones(1);
  broken(z, stages.k[0]);
  EXPECT_EQ(avi::controlled_step(stages, broken, z, h, avi::StepControl{}), 0.0);
}

}  // namespace runge_kutta_test
