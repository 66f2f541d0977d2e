#include "avi/bregman/bregman_htvi.hpp"
#include "avi/bregman/bregman_runge_kutta.hpp"
#include "avi/optim/run_updates.hpp"
#include "avi/problems/correlated_quartic.hpp"
#include "bregman/printed/extended_splitting.hpp"
#include "difference.hpp"
#include "refusal.hpp"

#include "refusal.hpp"

#include <gtest/gtest.h>

using avi::BregmanFamily;
using avi::CorrelatedQuartic;
using avi::ExtendedPoint;
using avi::VectorX;

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

TEST(Bregman, RefusesBadInput) {
  const CorrelatedQuartic f(2);
  const VectorX x0 = f.start();
  EXPECT_THROW(BregmanFamily::direct(0.0), std::invalid_argument);
  EXPECT_THROW(BregmanFamily::direct(-1.0), std::invalid_argument);
  EXPECT_THROW(BregmanFamily::direct(std::nan("")), std::invalid_argument);
  EXPECT_THROW(BregmanFamily::direct(2.0, 0.0), std::invalid_argument);
  EXPECT_THROW(BregmanFamily::adaptive(2.0, 0.0), std::invalid_argument);
  EXPECT_THROW(BregmanFamily::adaptive(2.0, -1.0), std::invalid_argument);
  EXPECT_THROW(BregmanFamily::adaptive(2.0, 2.1), std::invalid_argument);
  EXPECT_NO_THROW(BregmanFamily::adaptive(2.0, 2.0));
  EXPECT_EQ(refusal([] { BregmanFamily::adaptive(2.0, 3.0); }),
            "Parameter p_ring is 3; it must be positive and at most p.");
  const auto family = BregmanFamily::direct(2.0);
  const double infinity = std::numeric_limits<double>::infinity();
  for (double h : {0.0, -1.0, infinity, std::nan("")})
    EXPECT_THROW(avi::run_updates(f, avi::BregmanHtvi{.family = family, .h = h}, x0), std::invalid_argument);
  for (double t : {0.0, -1.0, infinity, std::nan("")})
    EXPECT_THROW(avi::run_updates(f, avi::BregmanHtvi{.family = family, .from = {.t = t}}, x0),
                 std::invalid_argument);
  EXPECT_THROW(avi::run_updates(f, avi::BregmanHtvi{.family = {.p = -1.0}}, x0), std::invalid_argument);
  using Pair = avi::BregmanEmbedded<avi::DormandPrince>;
  EXPECT_THROW(avi::run_updates(f, Pair{.family = family, .control = {.rtol = 0.0}}, x0),
               std::invalid_argument);
  EXPECT_THROW(avi::run_updates(f, Pair{.family = family, .control = {.atol = -1.0}}, x0),
               std::invalid_argument);
  EXPECT_THROW(avi::run_updates(f, Pair{.family = family, .first_step = 0.0}, x0), std::invalid_argument);
}

}  // namespace bregman_test
