#include "avi/integrators/runge_kutta.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
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
  /// One over the sum is this from an order on.
  const auto expect = [&](int from, double inverse, auto term) {
    if (order >= from) {
      EXPECT_NEAR(sum(term), 1.0 / inverse, 1e-14) << T::stages << " stages, 1/" << inverse;
    }
  };
  for (int k = 1; k <= order; ++k)
    expect(k, k, [&](std::size_t i) { return std::pow(c[i], k - 1); });
  expect(3, 6.0, [&](std::size_t i) { return ac[i]; });
  expect(4, 8.0, [&](std::size_t i) { return c[i] * ac[i]; });
  expect(4, 12.0, [&](std::size_t i) { return ac2[i]; });
  expect(4, 24.0, [&](std::size_t i) { return aac[i]; });
  expect(5, 10.0, [&](std::size_t i) { return c[i] * c[i] * ac[i]; });
  expect(5, 20.0, [&](std::size_t i) { return ac[i] * ac[i]; });
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

/// The other solution of a pair.
template <avi::EmbeddedTableau T>
struct Embedded : T {
  static constexpr int order = T::embedded_order;
  static constexpr auto b = T::embedded;
};

struct WeightsAlone {
  static constexpr int embedded_order = 2;
  static constexpr std::array<double, 1> embedded{1.0};
};
static_assert(avi::EmbeddedTableau<avi::DormandPrince> && !avi::EmbeddedTableau<avi::ClassicalRungeKutta> &&
              !avi::EmbeddedTableau<WeightsAlone>);

template <class T>
void expect_measured_order(int order, double off = 0.035) {
  EXPECT_EQ(T::order, order);
  EXPECT_NEAR(measured_order<T>(), order, off);
}

TEST(RungeKutta, ConvergesWithItsOrderAndNoFaster) {
  expect_measured_order<avi::ClassicalRungeKutta>(4);
  expect_measured_order<avi::BogackiShampine>(3);
  expect_measured_order<Embedded<avi::BogackiShampine>>(2);
  expect_measured_order<avi::DormandPrince>(5, 0.15);
  expect_measured_order<Embedded<avi::DormandPrince>>(4);
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

/// The next size after a step of Bogacki and Shampine's pair along z' = rate z from 1, in each of two
/// components of which the second rests, and the size taken.
std::pair<double, double> along_exponential(double rate, double h, const avi::StepControl& control) {
  avi::RungeKuttaStages<avi::BogackiShampine> stages(2);
  const auto field = [=](const VectorX& z, VectorX& dz) { dz << rate * z[0], 0.0; };
  const VectorX z = VectorX::Ones(2);
  field(z, stages.k[0]);
  const double taken = avi::controlled_step(stages, field, z, h, control);
  return {h, taken};
}
/// What the pair's solutions differ by there, (x^3 + x^4)/48 at x = rate h, in units of the tolerance.
double error_of(double x, const avi::StepControl& control) {
  const double size = std::max(1.0, std::abs(1.0 + x + x * x / 2.0 + x * x * x / 6.0));
  return std::abs(x * x * x + x * x * x * x) / 48.0 / (control.atol + control.rtol * size) / std::sqrt(2.0);
}

TEST(StepControl, TakesTheSizeThatTheErrorAllows) {
  const avi::StepControl usual;
  EXPECT_EQ(usual.rtol, 1e-3);
  EXPECT_EQ(usual.atol, 1e-6);
  const auto factor = [](double error) { return 0.9 * std::pow(error, -1.0 / 3.0); };
  for (const avi::StepControl& control : {usual, {.rtol = 1e-9, .atol = 0.001}})
    for (const double rate : {1.0, -1.0}) {
      const auto [next, taken] = along_exponential(rate, 0.1, control);
      EXPECT_EQ(taken, 0.1);
      EXPECT_NEAR(next, 0.1 * factor(error_of(0.1 * rate, control)), 1e-12);
    }
  // At once too large, then a third of it.
  const auto [next, taken] = along_exponential(1.0, 1.2, usual);
  EXPECT_NEAR(taken, 1.2 * factor(error_of(1.2, usual)), 1e-12);
  EXPECT_NEAR(next, taken * factor(error_of(taken, usual)), 1e-12);
}

TEST(StepControl, KeepsTheRatioOfStepsWithinItsLimits) {
  EXPECT_EQ(along_exponential(0.0, 0.1, {}).first, 0.5) << "there is no error";
  EXPECT_DOUBLE_EQ(along_exponential(1.0, 0.001, {}).first, 0.005);
  EXPECT_DOUBLE_EQ(along_exponential(1.0, 0.001, {.grow = 3.0}).first, 0.003);
  // The error allows 0.19 of this size, and then more than the fifth of it.
  const auto [next, taken] = along_exponential(-1.0, 2.1, {});
  EXPECT_DOUBLE_EQ(taken, 0.2 * 2.1);
  EXPECT_EQ(next, taken) << "no growth after a rejection";
  EXPECT_LT(error_of(-taken, {}), 0.7);
}

TEST(StepControl, RefusesWhatIsOutOfRange) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const avi::StepControl& bad : {avi::StepControl{.rtol = 0.0},
                                      {.atol = 0.0},
                                      {.safety = 0.0},
                                      {.safety = 1.0},
                                      {.shrink = 0.0},
                                      {.shrink = 1.0},
                                      {.grow = 1.0},
                                      {.grow = infinity},
                                      {.rejections = 0}})
    EXPECT_THROW(bad.validate(), std::invalid_argument);
  EXPECT_NO_THROW((avi::StepControl{1e-12, 1e-12, 0.999, 0.999, 1.001, 1}.validate()));
  EXPECT_NO_THROW((avi::StepControl{.safety = 0.001, .shrink = 0.001}.validate()));
}

TEST(StepControl, IsLookedAtBeforeAStep) {
  EXPECT_THROW(along_exponential(1.0, 0.1, {.rtol = -1.0, .atol = -1.0}), std::invalid_argument);
  EXPECT_THROW(along_exponential(1.0, 0.1, {.rejections = -5}), std::invalid_argument);
  EXPECT_THROW(along_exponential(1.0, 0.0, {}), std::invalid_argument) << "no step of no size";
  EXPECT_THROW(along_exponential(1.0, std::nan(""), {}), std::invalid_argument);
  EXPECT_EQ(along_exponential(1.0, -0.1, {}).second, -0.1);
}

TEST(EmbeddedRungeKutta, GivesUpOnWhatCannotBeStepped) {
  avi::RungeKuttaStages<avi::DormandPrince> stages(1);
  int calls = 0;
  const auto broken = [&](const VectorX&, VectorX& dz) {
    ++calls;
    dz[0] = std::nan("");
  };
  double h = 0.1;
  VectorX z = VectorX::Ones(1);
  stages.k[0][0] = 1.0;
  EXPECT_EQ(avi::controlled_step(stages, broken, z, h, avi::StepControl{}), 0.0);
  EXPECT_EQ(calls, 101 * 6) << "the first trial and a hundred more";
  EXPECT_NEAR(h / (0.1 * std::pow(0.2, 101)), 1.0, 1e-12);
}

}  // namespace runge_kutta_test
