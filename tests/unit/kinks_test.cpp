#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate_to.hpp"
#include "avi/solve.hpp"
#include "avi/transform/poincare.hpp"
#include "scratch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

/// @file
/// Steps that end at the kinks of H.

namespace kinks_test {

using avi::solve, avi::State;

const auto ramp = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + abs(q[0]); };
const State<1> resting{.q = {1.0}, .p = {0.0}};

/// Free fall to and fro, from rest at 1.
double fallen(double t) {
  const double quarter = std::sqrt(2.0), x = std::fmod(std::abs(t), 4.0 * quarter);
  if (x < quarter) return 1.0 - 0.5 * x * x;
  if (x < 3.0 * quarter) return 0.5 * (x - 2.0 * quarter) * (x - 2.0 * quarter) - 1.0;
  return 1.0 - 0.5 * (x - 4.0 * quarter) * (x - 4.0 * quarter);
}

// At 1e-7 it was refused after five million sweeps, with steps of 4e-5.
TEST(Kinks, CostSomeStepsEach) {
  for (const double end : {55.0, -55.0})
    for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
      const auto orbit = solve(ramp, resting, end, tolerance);
      EXPECT_TRUE(orbit.kept()) << orbit.report();
      EXPECT_NEAR(orbit.state.q[0], fallen(end), 3e-12);             // measured 1.1e-12
      EXPECT_LT(orbit.run.evaluations + orbit.choice.sweeps, 3000);  // measured at most 1527
    }
}

// A spring that is harder on one side: half of a period of each.
TEST(Kinks, LeaveTheOrder) {
  const auto spring = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.5 * select(q[0] < 0.0, 9.0 * q[0] * q[0], q[0] * q[0]);
  };
  const double period = M_PI * (1.0 + 1.0 / 3.0);
  for (const double periods : {1.0, 100.0}) {
    const auto orbit = solve(spring, State<1>{.q = {0.5}, .p = {0.0}}, periods * period, 1e-11);
    EXPECT_TRUE(orbit.kept()) << orbit.report();
    EXPECT_NEAR(orbit.state.q[0], 0.5, 2e-15);  // measured 7e-16
    EXPECT_NEAR(orbit.state.p[0], 0.0, 5e-14);  // measured 2.3e-14
  }
}

// Times, events and the curve know them, too. Measured: at most 5.4e-15.
TEST(Kinks, AreOnTheWay) {
  std::vector<double> times;
  for (int i = 0; i <= 100; ++i)
    times.push_back(0.3 * i);
  const auto zero = [](const auto& q, const auto&) { return q[0]; };
  const auto orbit = solve(ramp, resting, times, 1e-10, {.dense = true, .events = {avi::when(zero)}});
  EXPECT_TRUE(orbit.kept()) << orbit.report();
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(orbit.states[i].q[0], fallen(times[i]), 1.2e-14);
  ASSERT_EQ(orbit.events.size(), 11u);
  for (std::size_t k = 0; k < orbit.events.size(); ++k)
    EXPECT_NEAR(orbit.events[k].state.t, std::sqrt(2.0) * (2.0 * static_cast<double>(k) + 1.0), 1.2e-14);
  for (double t = 0.05; t < 30.0; t += 0.17)
    EXPECT_NEAR(orbit(t).q[0], fallen(t), 1.2e-14);
}

// Two balls between soft walls that meet each other. Steps beside that know nothing of kinks err by the
// square of their length, 2.1e-5; by 2.2e-7 where they are a tenth as long.
TEST(Kinks, MayBeSeveral) {
  const auto balls = [](const auto& q, const auto& p) {
    const auto push = [](const auto& depth) {
      using std::max;
      const auto d = max(depth, 0.0 * depth);
      return 50.0 * d * d;
    };
    return 0.5 * p.squaredNorm() + push(-1.0 - q[0]) + push(q[0] - q[1] + 0.2) + push(q[1] - 1.0);
  };
  const State<2> start{.q = {-0.5, 0.6}, .p = {1.0, -0.7}};
  const auto apart = [](const State<2>& a, const State<2>& b) {
    return (a.q - b.q).norm() + (a.p - b.p).norm();
  };
  auto method = avi::collocation(avi::poincare(balls, start), 4);
  State<2> beside = start;
  EXPECT_TRUE(avi::integrate_to(method, beside, 2e-4, 20.0).ok());
  const State<2> truth = solve(balls, start, 20.0, 1e-12).state;
  EXPECT_LT(apart(beside, truth), 4.2e-5);
  for (const double tolerance : {1e-4, 1e-8}) {
    const auto orbit = solve(balls, start, 20.0, tolerance);
    EXPECT_TRUE(orbit.kept()) << orbit.report();
    EXPECT_LT(apart(orbit.state, truth), 2e-3 * tolerance);  // measured 3.2e-8 and 7.9e-12
  }
}

// A run that is interrupted goes on with the same bits.
TEST(Kinks, AreKnownToACheckpoint) {
  const Scratch folder;
  const std::string file = folder / "run";
  const auto whole = solve(ramp, resting, 300.0, 1e-8, {.check = false, .checkpoint = file});
  avi::SolveOptions bounded{.check = false, .checkpoint = file};
  bounded.steps = whole.run.steps / 2;
  const auto half = solve(ramp, resting, 300.0, 1e-8, bounded);
  EXPECT_FALSE(half.ok());
  const auto rest = avi::resume<1>(ramp, file, {.check = false});
  EXPECT_EQ(rest.state, whole.state);
}

}  // namespace kinks_test
