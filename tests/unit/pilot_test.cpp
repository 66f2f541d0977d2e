#include "avi/problems/kepler.hpp"
#include "beyond/speed/automatic_monitors/pilot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pilot_test {

using avi::Kepler;
using avi::Outcome;
using experiment::Orbit;
using experiment::Pilot;
using experiment::Trial;

/// Fixed steps of order 4 along two periods of an ellipse, as a pilot tries them.
struct Pilots {
  Orbit orbit{Kepler(), Kepler::pericentre(0.5)};
  static constexpr double end = 4.0 * M_PI, any = 1e300;

  [[nodiscard]] Pilot pilot(double tolerance) const {
    const avi::Formula fixed = avi::Formula::of_phase<2>([](const auto&, const auto&) { return 1.0; });
    return {{orbit, 4, tolerance, 1.0, end}, "fixed", fixed, 1.0, end, any, 0.5};
  }
  [[nodiscard]] double error(double h) const { return pilot(1e-3).trial(h, 10'000, any).energy_error; }
};
const Pilots pilots;

TEST(Pilot, ShortensABadStepToThreeTenthsAtMost) {
  Pilot pilot = pilots.pilot(1e-12);
  EXPECT_EQ(pilot.next(), 0.5) << "what was supposed";
  ASSERT_GT(pilot.trial(0.1, 10'000, Pilots::any).energy_error, 1e-8);
  EXPECT_EQ(pilot.next(), 0.3 * 0.1);
}

TEST(Pilot, AimsBelowTheToleranceByThePowerOfTheOrder) {
  const double h = 0.05, error = pilots.error(h);
  for (const double tolerance : {0.2 * error, 5.0 * error}) {
    Pilot pilot = pilots.pilot(tolerance);
    pilot.trial(h, 10'000, Pilots::any);
    EXPECT_NEAR(pilot.next(), h * std::pow(tolerance / 1.7 / error, 0.25), 1e-12);
    EXPECT_EQ(pilot.good(), tolerance < error ? 0.0 : h);
    EXPECT_FALSE(pilot.done());
  }
}

TEST(Pilot, TriesTheGeometricMeanOfAGoodStepAndOneThatFails) {
  Pilot pilot = pilots.pilot(1e-3);
  EXPECT_EQ(pilot.trial(0.01, 10'000, Pilots::any).outcome, Outcome::ok);
  EXPECT_EQ(pilot.trial(0.02, 10, Pilots::any).outcome, Outcome::step_limit);
  EXPECT_NEAR(pilot.next(), std::sqrt(0.01 * 0.02), 1e-16);
  EXPECT_TRUE(std::isinf(pilot.cost())) << "it was given up";
}

TEST(Pilot, GoesBeyondAGoodStepByAFiftiethAtLeast) {
  const double h = 0.05;
  Pilot pilot = pilots.pilot(1.01 * pilots.error(h));
  pilot.trial(h, 10'000, Pilots::any);
  pilot.trial(1.5 * h, 10'000, Pilots::any);
  EXPECT_EQ(pilot.next(), 1.02 * h);
  EXPECT_TRUE(pilot.done()) << "the error is hardly below the tolerance";
  EXPECT_EQ(pilot.good(), h);
}

TEST(Pilot, SaysWhatTheStepAimedAtCosts) {
  // At a sweep of 1: what the trial took, for the steps of the length aimed at.
  const double h = 0.05;
  Pilot pilot = pilots.pilot(5.0 * pilots.error(h));
  EXPECT_FALSE(pilot.passed());
  EXPECT_NEAR(pilot.steps(), Pilots::end / 0.5, 1e-12) << "of the step supposed";
  const Trial trial = pilot.trial(h, 10'000, Pilots::any);
  EXPECT_TRUE(pilot.passed());
  EXPECT_NEAR(pilot.steps(), Pilots::end / pilot.next(), 1e-9);
  EXPECT_NEAR(pilot.cost(), static_cast<double>(trial.sweeps) * h / pilot.next(), 1e-9);
  EXPECT_GT(trial.steps, Pilots::end / h - 1.0);
}

TEST(Pilot, GrowsAStepByFiveHalvesAtMost) {
  Pilot pilot = pilots.pilot(0.5);
  ASSERT_LT(pilot.trial(0.002, 100'000, Pilots::any).energy_error, 1e-6);
  EXPECT_EQ(pilot.next(), 2.5 * 0.002);
}

TEST(Pilot, EndsATrialWhoseErrorShowsThatItIsTooDear) {
  const double h = 0.05, error = pilots.error(h);
  Pilot pilot = pilots.pilot(1e-3 * error);
  // A cost of half of the usual one, of eight sweeps a step, allows 2^-4 of the tolerance as the error.
  const Trial trial = pilot.trial(h, 10'000, 0.5 * 8.0 * Pilots::end / h);
  EXPECT_EQ(trial.outcome, Outcome::stopped);
  EXPECT_LT(trial.steps, 3);
  EXPECT_TRUE(std::isinf(trial.energy_error));
  EXPECT_TRUE(std::isinf(pilot.cost()));
  EXPECT_FALSE(pilot.passed());
  // The error that ends it lies between 2^4 and 3^4 times the tolerance.
  for (const auto& [share, outcome] : {std::pair{2.0, Outcome::stopped}, {3.0, Outcome::ok}}) {
    Pilot other = pilots.pilot(error / 40.0);
    EXPECT_EQ(other.trial(h, 10'000, share * 8.0 * Pilots::end / h).outcome, outcome) << share;
  }
}

TEST(Pilot, TakesTheOrderThatItHasSeen) {
  const double h = 0.05, small = pilots.error(0.5 * h), large = pilots.error(h), tolerance = 0.9 * large;
  Pilot pilot = pilots.pilot(tolerance);
  pilot.trial(0.5 * h, 10'000, Pilots::any);
  pilot.trial(h, 10'000, Pilots::any);
  const double order = std::log2(large / small);
  EXPECT_NEAR(pilot.next(), 0.5 * h * std::pow(tolerance / 1.7 / small, 1.0 / order), 1e-12);
  EXPECT_FALSE(pilot.done());
}

}  // namespace pilot_test
