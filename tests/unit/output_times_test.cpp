#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/solve.hpp"
#include "systems.hpp"
#include "unit/cayley.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace output_times_test {

using avi::Kepler, avi::solve, systems::at, systems::spring;

constexpr double rounding = std::numeric_limits<double>::epsilon();

// Measured: 28 units, of which the clock rounds 32 at the end.
TEST(OutputTimes, AreThoseOfARunByHandInMoreDigits) {
  const double h = 0.1;
  for (const double sense : {1.0, -1.0}) {
    std::vector<double> times;
    for (int k = 0; k <= 300; ++k)
      times.push_back(sense * 0.00123 * k * k);
    const auto orbit = solve(spring, at(1.0, 0.0), times, 1e-13, {.order = 4, .monitor = "fixed", .h = h});
    ASSERT_EQ(orbit.states.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto hand = by_hand({1.0L, 0.0L}, h, times[i]);
      EXPECT_EQ(orbit.states[i].t, times[i]);
      EXPECT_LE(std::abs(static_cast<double>(orbit.states[i].q[0] - hand.real())), 100.0 * rounding) << i;
      EXPECT_LE(std::abs(static_cast<double>(orbit.states[i].p[0] - hand.imag())), 100.0 * rounding) << i;
    }
  }
}

// Any number in one step or none, the start, the end and equal ones.
TEST(OutputTimes, MayBeManyOrFewOrEqual) {
  const std::vector<double> times{0.0, 0.0, 1e-300, 1e-9, 0.5, 0.5000001, 0.5000002, 7.0, 7.0, 20.0, 20.0};
  const auto orbit = solve(spring, at(1.0, 0.0), times, 1e-9);
  ASSERT_EQ(orbit.states.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(orbit.states[i].t, times[i]);
    EXPECT_NEAR(orbit.states[i].q[0], std::cos(times[i]), 2e-9);
  }
  EXPECT_EQ(orbit.states.back(), orbit.state);
  EXPECT_EQ(orbit.states.front(), at(1.0, 0.0));
  const auto start = solve(spring, at(1.0, 0.0), std::vector<double>{0.0, 0.0}, 1e-9);
  ASSERT_EQ(start.states.size(), 2u);
  EXPECT_EQ(start.states[1], start.state);
}

TEST(OutputTimes, DoNotChangeTheRunAndNotOneAnother) {
  const auto z = Kepler::pericentre(0.8);
  const double end = 20.0;
  const auto all = solve(Kepler(), z, std::vector<double>{1.0, 1.1, 6.2, 6.3, 13.0, end}, 1e-10);
  const auto one = solve(Kepler(), z, std::vector<double>{6.3, end}, 1e-10);
  const auto none = solve(Kepler(), z, end, 1e-10);
  EXPECT_EQ(all.states[3], one.states[0]);
  EXPECT_EQ(all.state, one.state);
  EXPECT_EQ(one.run.steps, none.run.steps);
  EXPECT_LE((all.state.q - none.state.q).norm(), 1e-14);
}

TEST(OutputTimes, GoBack) {
  const auto there = solve(avi::HenonHeiles(), avi::State<2>{.q = {0.0, 0.3}, .p = {0.45, 0.0}}, 30.0, 1e-12);
  const auto back = solve(avi::HenonHeiles(), there.state, std::vector<double>{30.0, 10.0, 0.0}, 1e-12);
  ASSERT_EQ(back.states.size(), 3u);
  const auto between =
      solve(avi::HenonHeiles(), avi::State<2>{.q = {0.0, 0.3}, .p = {0.45, 0.0}}, 10.0, 1e-12);
  EXPECT_LE((back.states[1].q - between.state.q).norm(), 1e-11);
  EXPECT_NEAR(back.state.q[1], 0.3, 1e-12);
  EXPECT_NEAR(back.state.p[0], 0.45, 1e-12);
}

// A choice, a run, and one step for each time: not twelve. Measured: 0.91 steps.
TEST(OutputTimes, CostAboutAStepEach) {
  const auto z = Kepler::pericentre(0.8);
  std::vector<double> times;
  for (int k = 1; k <= 1000; ++k)
    times.push_back(0.1 * k);
  const auto with = solve(Kepler(), z, times, 1e-10), without = solve(Kepler(), z, 100.0, 1e-10);
  const double step = static_cast<double>(without.run.evaluations) / static_cast<double>(without.run.steps);
  EXPECT_LE(static_cast<double>(with.run.evaluations - without.run.evaluations) / 1000.0, 2.0 * step);
}

TEST(OutputTimes, AreRefusedOutOfOrder) {
  const auto z = at(1.0, 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& times :
       std::vector<std::vector<double>>{{},
                                        {1.0, 0.5},
                                        {-1.0, 1.0},
                                        {1.0, nan},
                                        {-1.0, -0.5},
                                        {1.0, std::numeric_limits<double>::infinity()}})
    EXPECT_THROW((void)solve(spring, z, times, 1e-6), std::invalid_argument);
}

// The sentence is of the run that is delivered, though others met the bound before it.
TEST(OutputTimes, EndAtABoundWithTheStepsThatWereTaken) {
  for (const long most : {100, 300, 700}) {
    const auto found =
        avi::solve(avi::Kepler(), avi::Kepler::pericentre(0.5), std::vector<double>{200.0, 1000.0}, 1e-9,
                   {.steps = most, .monitor = "fixed"});
    ASSERT_EQ(found.run.outcome, avi::Outcome::step_limit);
    EXPECT_NE(found.run.message.find("after " + std::to_string(found.run.steps) + " steps"),
              std::string::npos)
        << found.run.message;
  }
}

// H falls to a singularity at t = 1.2533: the states before it are delivered, with the sentence of the
// failure.
TEST(OutputTimes, BeforeASingularityAreDelivered) {
  const auto time_of = [](double q) { return std::sqrt(M_PI / 2.0) * std::erf(std::sqrt(-std::log(q))); };
  const auto found =
      solve(systems::logarithm, at(1.0, 0.0), std::vector<double>{time_of(0.8), time_of(0.4), 2.0}, 1e-10,
            {.seconds = 10.0, .dense = true});
  EXPECT_FALSE(found.ok());
  EXPECT_FALSE(found.kept());
  EXPECT_NE(found.run.outcome, avi::Outcome::time_limit);
  EXPECT_NE(found.run.message.find("singularity"), std::string::npos) << found.run.message;
  ASSERT_EQ(found.states.size(), 2u) << found.report();
  EXPECT_NEAR(found.states[0].q[0], 0.8, 1e-8);
  EXPECT_NEAR(found.states[1].q[0], 0.4, 1e-8);
  EXPECT_NEAR(found(time_of(0.6)).q[0], 0.6, 1e-8);
}

}  // namespace output_times_test
