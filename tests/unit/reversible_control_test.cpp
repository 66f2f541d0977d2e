#include "avi/avi.hpp"
#include "common/methods/adaptive_verlet.hpp"
#include "common/methods/hairer_soderlind.hpp"
#include "difference.hpp"
#include "distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace c = avi::compositions;
using avi::Kepler, avi::State, experiment::PowerOfRadius;

namespace reversible_control_test {

const experiment::AdaptiveVerlet adaptive_verlet(Kepler{}, PowerOfRadius{1.5});
const experiment::HairerSoderlind controlled(avi::splitting(avi::Separable<Kepler>{}, c::strang),
                                             PowerOfRadius{1.5});

TEST(PowerOfRadius, HasTheRateOfItsReciprocalAlongTheOrbit) {
  EXPECT_EQ(PowerOfRadius{}.alpha, 1.5);
  for (const double alpha : {1.5, 0.7}) {
    const PowerOfRadius g{alpha};
    const auto density = [&](double t) {
      const auto z = Kepler::exact(0.5, 1.0 + t);
      return 1.0 / g(z.q, z.p);
    };
    const auto z = Kepler::exact(0.5, 1.0);
    EXPECT_NEAR(g(z.q, z.p), std::pow(z.q.norm(), alpha), 1e-15);
    // d/dtau = g d/dt.
    EXPECT_NEAR(g.density_rate(z.q, z.p), g(z.q, z.p) * difference(density, 1e-3), 1e-9);
  }
}

// Time tells the density: a step takes h / rho of it.
TEST(HairerSoderlind, IntegratesItsDensity) {
  const double h = 0.1;
  const PowerOfRadius g;
  auto method = controlled;
  const State<2> first = Kepler::exact(0.5, 1.0);
  State<2> second = first;
  ASSERT_EQ(method.step(second, h).outcome, avi::Outcome::ok);
  State<2> third = second;
  ASSERT_EQ(method.step(third, h).outcome, avi::Outcome::ok);
  const double rho = 1.0 / g(first.q, first.p) + 0.5 * h * g.density_rate(first.q, first.p);
  EXPECT_NEAR(second.t - first.t, h / rho, 1e-15);
  EXPECT_NEAR(third.t - second.t, h / (rho + h * g.density_rate(second.q, second.p)), 1e-15);
}

TEST(AdaptiveVerlet, TakesTheStepsOfItsEquations) {
  const double h = 0.1;
  const PowerOfRadius g;
  auto method = adaptive_verlet;
  State<2> z = Kepler::exact(0.5, 1.0), w = z;
  double rho = 1.0 / g(z.q, z.p);
  for (int k = 0; k < 3; ++k) {
    ASSERT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
    w.p -= 0.5 * h / rho * Kepler::potential_gradient(w.q);
    w.q += 0.5 * h / rho * w.p;
    const double next = 2.0 / g(w.q, w.p) - rho;
    w.q += 0.5 * h / next * w.p;
    w.p -= 0.5 * h / next * Kepler::potential_gradient(w.q);
    w.t += 0.5 * h * (1.0 / rho + 1.0 / next);
    rho = next;
    EXPECT_LT(distance(z, w), 1e-14) << k;
  }
}

TEST(ReversibleControl, StartsAnewWhereTheStateIsChangedFromOutside) {
  const auto check = [](const auto& method) {
    const State<2> there = Kepler::exact(0.5, 1.0);
    auto used = method;
    State<2> z = there;
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(used.step(z, 0.1).outcome, avi::Outcome::ok);
    State<2> turned = z, later = z;  // each differs from z in one respect
    turned.q = there.q;
    later.t += 1.0;
    for (const State<2>& at : {turned, later}) {
      auto old = used, fresh = method;
      State<2> a = at, b = at;
      ASSERT_EQ(old.step(a, 0.1).outcome, avi::Outcome::ok);
      ASSERT_EQ(fresh.step(b, 0.1).outcome, avi::Outcome::ok);
      EXPECT_EQ(distance(a, b), 0.0);
    }
  };
  check(adaptive_verlet);
  check(controlled);
}

// Nor does a step that failed elsewhere change what is known of the last good state.
TEST(ReversibleControl, OutlivesAStepThatFails) {
  const auto check = [](const auto& method) {
    auto used = method;
    State<2> z = Kepler::pericentre(0.5);
    ASSERT_EQ(used.step(z, 0.05).outcome, avi::Outcome::ok);
    auto other = used;
    State<2> far{.q = {1e-3, 0.0}, .p = {40.0, 0.0}, .t = z.t}, a = z, b = z;
    ASSERT_EQ(used.step(far, 5.0).outcome, avi::Outcome::diverged);
    ASSERT_EQ(used.step(a, 0.05).outcome, avi::Outcome::ok);
    ASSERT_EQ(other.step(b, 0.05).outcome, avi::Outcome::ok);
    EXPECT_EQ(distance(a, b), 0.0);
  };
  check(adaptive_verlet);
  check(controlled);
}

// Its error is uneven from step size to step size, as its density alternates.
TEST(AdaptiveVerlet, HasOrderFourWhereComposed) {
  std::vector<double> h, error;
  for (int k = 0; k < 5; ++k) {
    auto z = Kepler::pericentre(0.5);
    avi::Composition method(adaptive_verlet, c::suzuki4);
    h.push_back(std::ldexp(0.1, -k));
    EXPECT_EQ(avi::integrate(method, z, h.back(), {.time = 6.0}).outcome, avi::Outcome::ok);
    error.push_back((z.q - Kepler::exact(0.5, z.t).q).norm());
  }
  EXPECT_NEAR(avi::fit_order(h, error, {.floor = 5e-13}).order, 4.0, 0.25);
}

TEST(ReversibleControl, KeepsTheEnergyWithoutDriftAndTheStepNearItsMonitor) {
  const auto check = [](auto method) {
    auto z = Kepler::pericentre(0.9);
    const double h = 0.02;
    double early = 0.0, late = 0.0, last = 0.0, least = 1e9, most = 0.0;
    EXPECT_TRUE(avi::integrate(method, z, h, {.time = 200.0 * M_PI}, [&](const State<2>& s, long) {
                  double& worst = s.t < 20.0 * M_PI ? early : late;
                  worst = std::max(worst, std::abs(Kepler{}(s.q, s.p) + 0.5));
                  const double ratio = (s.t - last) / (h * std::pow(s.q.norm(), 1.5));
                  least = std::min(least, ratio);
                  most = std::max(most, ratio);
                  last = s.t;
                }).ok());
    EXPECT_LT(late, 1.2 * early);
    EXPECT_LT(early, 2e-2);
    EXPECT_GT(least, 0.8);
    EXPECT_LT(most, 1.25);
  };
  check(adaptive_verlet);
  check(controlled);
}

TEST(ReversibleControl, SaysSoWhenTheStepIsTooLarge) {
  auto z = Kepler::pericentre(0.9);
  auto method = adaptive_verlet;
  const auto run = avi::integrate(method, z, 3.0, {.time = 100.0, .steps = 1000});
  EXPECT_EQ(run.outcome, avi::Outcome::diverged);
}

/// H = p^2 / 2 in one dimension.
struct Free {
  static constexpr int dimension = 1;
  using Vec = avi::Vector<double, 1>;
  static Vec potential_gradient(const Vec&) { return Vec(0.0); }
};

TEST(ReversibleControl, RefusesADensityOfZero) {
  // 1/g falls from 1 to 0 in this step of 2: by rho_1 = 2/g(1) - 1/g(0), and by 1/g(0) + h/2 G = 1 - 1.
  const auto expect = [](auto method, avi::Outcome outcome) {
    State<1> z{.q = Free::Vec(1.0), .p = Free::Vec(1.0)};
    EXPECT_EQ(method.step(z, 2.0).outcome, outcome);
    EXPECT_TRUE(z.q[0] == 1.0 && z.p[0] == 1.0 && z.t == 0.0);
  };
  const auto verlet = [](auto monitor) { return experiment::AdaptiveVerlet(Free{}, monitor); };
  expect(verlet([](const auto& q, const auto&) { return q[0]; }), avi::Outcome::diverged);
  expect(experiment::HairerSoderlind(avi::splitting(avi::Separable<Free>{}, c::strang), PowerOfRadius{1.0}),
         avi::Outcome::diverged);
  for (const double g : {-1.0, -0.0, std::numeric_limits<double>::infinity()})
    expect(verlet([=](const auto&, const auto&) { return g; }), avi::Outcome::bad_monitor);
}

}  // namespace reversible_control_test
