#include "avi/avi.hpp"
#include "bregman/printed/extended_splitting.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "common/rules/bregman_cloning.hpp"
#include "common/rules/bregman_runge_kutta.hpp"
#include "difference.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using avi::BregmanFamily, avi::VectorX, experiment::CorrelatedQuartic;

namespace bregman_test {

TEST(BregmanFamily, CoefficientsAreThePrintedOnes) {
  for (double t : {0.5, 1.0, 3.0}) {
    const double p = 4.0, q = 0.5, C = 0.3;
    const auto a = BregmanFamily::adaptive(p, q, C);
    EXPECT_DOUBLE_EQ(a.kinetic(t), p * p / q * std::pow(t, -p - q / p));
    EXPECT_DOUBLE_EQ(a.potential(t), C * p * p / q * std::pow(t, 2 * p - q / p));
    EXPECT_DOUBLE_EQ(a.monitor(t), p / q * std::pow(t, 1 - q / p));
    const auto d = BregmanFamily::direct(p, C);
    EXPECT_DOUBLE_EQ(d.kinetic(t), p / std::pow(t, p + 1));
    EXPECT_DOUBLE_EQ(d.potential(t), C * p * std::pow(t, 2 * p - 1));
    EXPECT_DOUBLE_EQ(d.monitor(t), 1.0);
  }
}

TEST(BregmanFamily, RatesAreDerivatives) {
  const auto family = BregmanFamily::adaptive(6.0, 1.5, 0.2);
  const double t = 1.7;
  const auto slope = [&](auto member) {
    return difference([&](double x) { return (family.*member)(t + x); }, 1e-4);
  };
  EXPECT_NEAR(slope(&BregmanFamily::kinetic) / family.kinetic_rate(t), 1.0, 1e-10);
  EXPECT_NEAR(slope(&BregmanFamily::potential) / family.potential_rate(t), 1.0, 1e-10);
  EXPECT_NEAR(slope(&BregmanFamily::monitor) / family.monitor_rate(t), 1.0, 1e-10);
}

TEST(BregmanFamily, ExactClockSolvesTheClockEquation) {
  const auto family = BregmanFamily::adaptive(4.0, 0.5);
  double t = 1.3;
  const double expected = family.exact_clock(t, 0.1);
  for (int k = 0; k < 1000; ++k) {  // classical Runge-Kutta
    const double h = 1e-4, a = family.monitor(t), b = family.monitor(t + 0.5 * h * a),
                 c = family.monitor(t + 0.5 * h * b), e = family.monitor(t + h * c);
    t += h / 6.0 * (a + 2.0 * b + 2.0 * c + e);
  }
  EXPECT_NEAR(t, expected, 1e-12);
}

TEST(BregmanFamily, AdaptiveIsTheBregmanSystemOfOrderPSquaredOverPRing) {
  // In tau = t^(p_ring/p) the coefficients are those of the Direct system of order P = p^2/p_ring.
  const auto adaptive = BregmanFamily::adaptive(4.0, 0.5, 0.3);
  const auto direct = BregmanFamily::direct(adaptive.order(), 0.3);
  EXPECT_EQ(adaptive.order(), 32.0);
  for (double tau : {0.9, 1.0, 1.2}) {
    const double t = std::pow(tau, 1.0 / adaptive.s());
    EXPECT_NEAR(adaptive.kinetic(t) / direct.kinetic(tau), 1.0, 1e-13);
    EXPECT_NEAR(adaptive.potential(t) / direct.potential(tau), 1.0, 1e-13);
    EXPECT_NEAR(adaptive.monitor(t) * adaptive.s() * std::pow(t, adaptive.s() - 1.0), 1.0, 1e-13);
  }
}

TEST(ExtendedPhaseSpace, StartLiesOnTheZeroLevelAndFlowsKeepTheirTerms) {
  const CorrelatedQuartic f(5, 0.9);
  const auto family = BregmanFamily::adaptive(4.0, 1.0);
  auto z = avi::bregman_start(family, f, VectorX::Constant(5, 1.5));
  EXPECT_NEAR(avi::bregman_energy(family, f, z), 0.0, 1e-14 * std::abs(z.r_t));
  const auto clock = [&] { return family.monitor(z.t) * z.r_t; };
  const double before = clock();
  experiment::clock_flow(family, 0.1, z);
  EXPECT_NEAR(clock() / before, 1.0, 1e-14);
  EXPECT_NEAR(std::pow(z.t, family.s()), 1.1, 1e-14);
}

TEST(ExtendedPhaseSpace, ThreeFlowsConvergeToTheDynamicsWithOrderTwo) {
  // The extended energy vanishes along the exact solution; the error of one integration is O(h^2).
  const CorrelatedQuartic f(5, 0.9);
  const auto family = BregmanFamily::adaptive(2.0, 1.0);
  double error[3];
  for (int i = 0; i < 3; ++i) {
    auto z = avi::bregman_start(family, f, VectorX::Constant(5, 1.5));
    const int steps = 200 << i;
    for (int k = 0; k < steps; ++k)
      experiment::three_flow_step(family, f, 0.2 / steps, z);
    error[i] = std::abs(avi::bregman_energy(family, f, z));
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.05);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.05);
}

TEST(Bregman, HasThePapersDefaults) {
  const BregmanFamily family;
  EXPECT_EQ((std::vector{family.p, family.p_ring, family.C}), (std::vector{2.0, 2.0, 0.0625}));
  EXPECT_EQ(BregmanFamily::direct(3.0).C, 0.0625);
  EXPECT_EQ(BregmanFamily::adaptive(3.0, 1.0).C, 0.0625);
  const avi::BregmanStart from;
  EXPECT_EQ((std::vector{from.t, from.momentum}), (std::vector{1.0, 1.0}));
  for (const double h :
       {avi::BregmanHtvi{}.h, avi::BregmanHeavyBall{}.h, experiment::BregmanCloning{}.h,
        avi::BregmanSplitting{}.h, experiment::BregmanRungeKutta<avi::ClassicalRungeKutta>{}.h})
    EXPECT_EQ(h, 1e-3);
  EXPECT_EQ(experiment::BregmanEmbedded<avi::DormandPrince>{}.first_step, 1e-6);
  EXPECT_EQ(avi::BregmanRestarted{}.P, 2.0);
}

TEST(BregmanCloning, MergesTheFlowsOfTripleJumps) {
  using experiment::CloneComposition;
  const auto sum_of_powers = [](const std::vector<double>& lengths, int k) {
    double sum = 0.0;
    for (const double length : lengths)
      sum += std::pow(length, k);
    return sum;
  };
  std::size_t m = 1;
  for (const auto& [composition, name] : {std::pair{CloneComposition::strang, "clone_strang"},
                                          {CloneComposition::yoshida4, "clone_y4"},
                                          {CloneComposition::yoshida6, "clone_y6"}}) {
    EXPECT_EQ(experiment::clone_name(composition), name);
    const auto [a, b] = experiment::merged_stages(composition);
    ASSERT_EQ(a.size(), m);
    ASSERT_EQ(b.size(), m + 1);
    EXPECT_NEAR(sum_of_powers(a, 1), 1.0, 1e-14);
    // The conditions of orders 4 and 6 that lengths of one step alone have to satisfy.
    if (m > 1) {
      EXPECT_NEAR(sum_of_powers(a, 3), 0.0, 1e-14);
    }
    if (m > 3) {
      EXPECT_NEAR(sum_of_powers(a, 5), 0.0, 1e-13);
    }
    EXPECT_EQ(b.front(), 0.5 * a.front());
    EXPECT_EQ(b.back(), 0.5 * a.back());
    for (std::size_t i = 1; i < m; ++i)
      EXPECT_EQ(b[i], 0.5 * (a[i - 1] + a[i]));
    m *= 3;
  }
  const auto yoshida = experiment::merged_stages(CloneComposition::yoshida4).a;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(yoshida[i], avi::compositions::yoshida4.c[i], 1e-15);
}

/// f = x_0 + x_1, whose dynamics with p = 2 is known: with A = r_0 + C/2 at t_0 = 1, every entry of r is
/// A - C t^4 / 2 and of x it is x(0) + A (1 - t^-2) - C (t^2 - 1) / 2, whatever clock t follows.
double slope(const VectorX& x, VectorX& gradient) {
  gradient = VectorX::Ones(2);
  return x.sum();
}
template <class Method>
double error_on_slope(Method method, double s, int steps) {
  const double C = method.family.C, A = 1.0 + 0.5 * C, t = std::pow(2.0, 1.0 / s);  // t^s goes from 1 to 2
  method.h = 1.0 / steps;
  const auto run =
      avi::run_updates(slope, method, VectorX::Constant(2, 5.0), {.delta = 0.0, .iterations = steps});
  EXPECT_EQ(run.last.value, run.last.x.sum());
  EXPECT_EQ(run.last.x[0], run.last.x[1]);
  return std::abs(run.last.x[0] - (5.0 + A * (1.0 - 1.0 / (t * t)) - 0.5 * C * (t * t - 1.0)));
}

TEST(Bregman, MethodsFollowTheExactDynamicsWithTheirOrders) {
  for (const auto& family : {BregmanFamily::direct(2.0, 0.7), BregmanFamily::adaptive(2.0, 1.0, 0.7)}) {
    const auto expect_order = [&](auto method, int steps, double order, double off = 0.03) {
      method.family = family;
      const double coarse = error_on_slope(method, family.s(), steps),
                   fine = error_on_slope(method, family.s(), 2 * steps);
      EXPECT_LT(fine, 0.03);
      EXPECT_NEAR(std::log2(coarse / fine), order, off) << coarse << " " << fine;
    };
    using experiment::CloneComposition;
    expect_order(avi::BregmanHtvi{}, 200, 1.0);
    expect_order(avi::BregmanHeavyBall{}, 200, 1.0);
    expect_order(avi::BregmanSplitting{}, 50, 2.0);
    expect_order(experiment::BregmanCloning{}, 50, 2.0);
    expect_order(experiment::BregmanCloning{.family{}, .composition = CloneComposition::yoshida4}, 50, 4.0);
    expect_order(experiment::BregmanCloning{.family{}, .composition = CloneComposition::yoshida6}, 25, 6.0,
                 0.08);
    // Measured 0.35 and 0.16 off, with errors near rounding.
    expect_order(experiment::BregmanRungeKutta<avi::ClassicalRungeKutta>{}, 100, 4.0, 0.6);
    expect_order(experiment::BregmanRungeKutta<avi::DormandPrince>{}, 40, 5.0, 0.32);
    expect_order(experiment::BregmanRungeKutta<avi::BogackiShampine>{}, 50, 3.0);
  }
}

TEST(Bregman, EmbeddedPairsKeepTheTolerance) {
  const experiment::BregmanEmbedded<avi::DormandPrince> method{
      .family = BregmanFamily::direct(2.0, 0.7), .control = {.rtol = 1e-9, .atol = 1e-9}, .first_step = 0.01};
  avi::Counted objective(slope, 2);
  avi::Iterate now{.x = VectorX::Constant(2, 5.0), .gradient = VectorX::Zero(2)};
  now.evaluate(objective);
  auto state = method.start(now);
  for (int k = 0; k < 40; ++k) {
    ASSERT_EQ(method.update(state, now, objective), avi::Outcome::ok);
    EXPECT_TRUE(now.evaluated) << "at the last stage";
    EXPECT_EQ(now.value, now.x.sum());
  }
  const double t = state.z[4], A = 1.35;
  EXPECT_GT(t, 2.0);
  EXPECT_NEAR(state.z[3], A - 0.35 * std::pow(t, 4), 1e-7 * std::pow(t, 4));
  EXPECT_NEAR(now.x[0], 5.0 + A * (1.0 - 1.0 / (t * t)) - 0.35 * (t * t - 1.0), 1e-7 * t * t);
  EXPECT_EQ(objective.gradients % 6, 1) << "six a trial, one at the start";
  // What cannot be stepped is not stepped.
  const auto broken = [](const VectorX&, VectorX& gradient) {
    gradient = VectorX::Constant(2, std::nan(""));
    return 0.0;
  };
  const VectorX before = now.x;
  EXPECT_EQ(method.update(state, now, broken), avi::Outcome::not_converged);
  EXPECT_EQ(now.x, before);
}

TEST(BregmanFamily, NamesTheRangeOfItsParameter) {
  EXPECT_NO_THROW(BregmanFamily::adaptive(2.0, 2.0));
  EXPECT_EQ(refusal([] { BregmanFamily::adaptive(2.0, 3.0); }),
            "Parameter p_ring is 3; it must be positive and at most p.");
}

}  // namespace bregman_test
