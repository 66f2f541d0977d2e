#include "avi/avi.hpp"
#include "common/problems/chain.hpp"
#include "distance.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using avi::Kepler, avi::Outcome, avi::State, avi::Vector;

namespace collocation_steps_test {

TEST(CollocationSteps, IsOneMethodForEveryKindOfDimension) {
  // The same masses, with the dimension known to the compiler or not, gradients supplied or recorded.
  const auto fixed = avi::FigureEight::problem();
  const avi::NBody<avi::dynamic> free(fixed.masses());
  State<6> a = avi::FigureEight::start();
  State<avi::dynamic> b{.q = a.q, .p = a.p};
  auto one = avi::collocation(avi::poincare(fixed, a), 12);
  auto other = avi::collocation(avi::poincare(free, b), 12);
  auto automatic = avi::collocation(avi::poincare(avi::Automatic{fixed}, a), 12);
  State<6> c = a;
  ASSERT_EQ(avi::integrate(one, a, 0.1, {.steps = 50}).outcome, Outcome::ok);
  ASSERT_EQ(avi::integrate(other, b, 0.1, {.steps = 50}).outcome, Outcome::ok);
  ASSERT_EQ(avi::integrate(automatic, c, 0.1, {.steps = 50}).outcome, Outcome::ok);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(a.q[i], b.q[i], 2e-13);
    EXPECT_NEAR(a.q[i], c.q[i], 2e-13);
    EXPECT_NEAR(a.p[i], b.p[i], 2e-13);
  }
  EXPECT_NEAR(a.t, b.t, 1e-14);
}

TEST(CollocationSteps, TakesManyDegreesOfFreedom) {
  for (const int masses : {1, 9, 64}) {
    auto z = experiment::Chain::plucked(masses);
    auto method = avi::collocation(avi::poincare(experiment::Chain{}, z), 8);
    const double energy = experiment::Chain{}(z.q, z.p);
    ASSERT_EQ(avi::integrate(method, z, 0.2, {.time = 20.0}).outcome, Outcome::ok);
    EXPECT_NEAR(experiment::Chain{}(z.q, z.p), energy, 2e-9 * (1.0 + energy)) << masses;
  }
}

/// H = p^2/2 + (1 + t)^2 q^2/2.
const auto stiffening = [](const auto& q, const auto& t, const auto& p) {
  return 0.5 * p[0] * p[0] + 0.5 * (1.0 + t) * (1.0 + t) * q[0] * q[0];
};
/// g = 1/(1 + t).
const auto slower = [](const auto&, const auto& t, const auto&) { return 1.0 / (1.0 + t); };

TEST(CollocationSteps, TakesTimeAsACoordinate) {
  const State<1> start{.q = {1.0}, .p = {0.3}, .t = 0.25};
  const auto run = [&](const auto& problem, int order, double h) {
    auto method = avi::collocation(problem, order);
    auto z = avi::extended(problem, start);
    EXPECT_EQ(avi::integrate_to(method, z, h, 3.0).outcome, Outcome::ok);
    EXPECT_EQ(z.t, z.q[1]);
    EXPECT_NEAR(z.t, 3.0, 2e-15);
    return z;
  };
  const auto plain = run(avi::time_dependent(stiffening, start), 16, 0.2);
  const auto slowed = run(avi::time_dependent(stiffening, start, slower), 12, 0.3);
  EXPECT_NEAR(plain.q[0], slowed.q[0], 1e-13);
  EXPECT_NEAR(plain.p[0], slowed.p[0], 1e-13);
}

// In crossed fields a charge that is let go in the origin runs along a cycloid. That start was once taken for
// the end of a step that there had not been, and the first step for solved after one sweep.
TEST(CollocationSteps, MayStartWhereAllIsZero) {
  const auto crossed = [](const auto& q, const auto& p) {
    const auto u = p[0] + 0.5 * q[1], v = p[1] - 0.5 * q[0];
    return 0.5 * (u * u + v * v) - q[0];
  };
  for (const int order : {8, 16}) {
    State<2> z{.q = {0.0, 0.0}, .p = {0.0, 0.0}};
    auto method = avi::collocation(avi::poincare(crossed, z), order);
    for (int k = 0; k < 4; ++k)
      ASSERT_TRUE(method.step(z, 0.5).ok());
    EXPECT_NEAR(z.q[0], 1.0 - std::cos(2.0), order == 8 ? 1e-7 : 1e-14);
    EXPECT_NEAR(z.q[1], std::sin(2.0) - 2.0, order == 8 ? 1e-7 : 1e-14);
  }
}

TEST(CollocationSteps, NamesWhatEndsAStep) {
  const auto start = Kepler::pericentre(0.5);
  const auto problem = avi::poincare(Kepler{}, start);
  for (const int order : {-2, 0, 3, 7, 18})
    EXPECT_THROW((void)avi::collocation(problem, order), std::invalid_argument) << order;
  EXPECT_THROW((void)avi::collocation<8>(problem, 10), std::invalid_argument);
  EXPECT_THROW((void)avi::collocation<32>(problem, 34), std::invalid_argument);
  for (const double tolerance : {0.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW((void)avi::collocation(problem, 4, {.tolerance = tolerance}), std::invalid_argument);
  EXPECT_THROW((void)avi::collocation(problem, 4, {.max_sweeps = 0}), std::invalid_argument);
  EXPECT_NO_THROW((void)avi::collocation(problem, 4, {.max_sweeps = 1}));
  EXPECT_EQ(
      refusal([&] { (void)avi::collocation(problem, 18); }),
      "Order of collocation is 18; it must be even and in [2, 16]; collocation<32>(problem, order) goes "
      "up to 32.");
  EXPECT_EQ(refusal([&] { (void)avi::collocation<32>(problem, 34); }),
            "Order of collocation is 34; it must be even and in [2, 32].");

  const auto unchanged = [](auto method, State<2> z, double h, Outcome outcome) {
    const State<2> before = z;
    EXPECT_EQ(method.step(z, h).outcome, outcome) << avi::name(method.step(z, h).outcome);
    if (before.finite()) {
      EXPECT_EQ(distance(z, before), 0.0);
    }
  };
  unchanged(avi::collocation(problem, 8, {.max_sweeps = 2}), start, 0.3, Outcome::not_converged);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity}) {
    State<2> z = start;
    z.q[0] = bad;
    unchanged(avi::collocation(problem, 8), z, 0.1, Outcome::non_finite);
    z = start;
    z.p[1] = bad;
    unchanged(avi::collocation(problem, 8), z, 0.1, Outcome::non_finite);
    unchanged(avi::collocation(problem, 8), start, bad, Outcome::non_finite);
  }
  State<2> centre = start;
  centre.q.setZero();
  unchanged(avi::collocation(problem, 8), centre, 0.1, Outcome::non_finite);
  auto chain = avi::collocation(avi::poincare(experiment::Chain{}, experiment::Chain::plucked(3)), 4);
  for (const auto& [q, p, wrong] : {std::array{2, 2, 2}, {3, 2, 2}, {4, 3, 4}}) {
    State<avi::dynamic> z{.q = Vector<double, avi::dynamic>::Ones(q),
                          .p = Vector<double, avi::dynamic>::Ones(p)};
    EXPECT_EQ(refusal([&] { (void)chain.step(z, 0.1); }),
              "Dimension of the state is " + std::to_string(wrong) +
                  "; it must be that of the problem, 3, for q and p alike.");
  }
}

// How soon a step counts as solved decides cost and accuracy, which other tests bound loosely.
TEST(CollocationSteps, EndsItsSweepsAtRoundOff) {
  const auto start = Kepler::pericentre(0.6);
  const double energy = Kepler{}(start.q, start.p);
  const struct {  // sweeps and error as measured
    int order;
    double h, tolerance;
    long sweeps;
    double error;
  } runs[] = {{4, 0.02, 1e-16, 950, 3.2e-10},  {8, 0.2, 1e-16, 1519, 2.4e-13},
              {16, 0.4, 1e-16, 1527, 8.9e-16}, {16, 0.1, 1e-16, 657, 2.3e-15},
              {8, 0.2, 1e-99, 1840, 2.4e-13},  {16, 0.4, 1e-99, 1856, 2.9e-15}};
  for (const auto& [order, h, tolerance, sweeps, error] : runs) {
    auto method =
        avi::collocation(avi::poincare(Kepler{}, start, avi::Gamma{0.75}), order, {.tolerance = tolerance});
    State<2> z = start;
    double worst = 0.0;
    const avi::Run run = avi::integrate(method, z, h, {.steps = 200}, [&](const State<2>& now, long) {
      worst = std::max(worst, std::abs(Kepler{}(now.q, now.p) - energy));
    });
    ASSERT_EQ(run.outcome, Outcome::ok);
    EXPECT_LE(run.evaluations - run.steps, 1.01 * sweeps) << "order " << order << ", h = " << h;
    EXPECT_LE(worst, 2.0 * error) << "order " << order << ", h = " << h;
  }
}

TEST(CollocationSteps, GoesOnAfterAFailedStep) {
  const auto start = Kepler::pericentre(0.9);
  auto method = avi::collocation(avi::poincare(Kepler{}, start, avi::Gamma{0.75}), 16);
  State<2> z = start, fresh = start;
  ASSERT_EQ(method.step(z, 0.5).outcome, Outcome::ok);
  const State<2> kept = z;
  ASSERT_NE(method.step(z, 50.0).outcome, Outcome::ok);
  EXPECT_EQ(distance(z, kept), 0.0);
  ASSERT_EQ(method.step(z, 0.5).outcome, Outcome::ok);
  auto another = avi::collocation(method.problem(), 16);
  ASSERT_EQ(avi::integrate(another, fresh, 0.5, {.steps = 2}).outcome, Outcome::ok);
  EXPECT_LT(distance(z, fresh), 1e-14);
}

}  // namespace collocation_steps_test
