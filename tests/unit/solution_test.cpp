#include "avi/automatic/solution.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/problems/pendulum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace solution_test {

using avi::Kepler;
using avi::State;

/// Asked for from 1e-4 to 1e-11; how often the energy error came out within a factor of 3, and whether it
/// ever was more than ten times too large without a word.
struct Tally {
  int near = 0, all = 0;
  template <class H, int n>
  void run(const H& hamiltonian, const State<n>& start, double end) {
    for (int k = 4; k <= 11; ++k) {
      const double tolerance = std::pow(10.0, -k);
      const auto solution = integrate(hamiltonian, start, end, tolerance);
      EXPECT_EQ(solution.run.outcome, avi::Outcome::ok) << solution.report();
      EXPECT_NEAR(solution.state.t, end, 1e-12 * end);
      const double ratio = solution.energy_error / tolerance;
      near += ratio < 3.0 && ratio > 1.0 / 3.0;
      ++all;
      if (ratio > 10.0) {
        EXPECT_NE(solution.report().find("more than ten times"), std::string::npos);
      }
    }
  }
};

TEST(Solution, HasTheEnergyErrorAskedFor) {
  Tally tally;
  tally.run(Kepler(), Kepler::pericentre(0.6), 60.0);
  tally.run(Kepler(), Kepler::pericentre(0.9), 60.0);
  tally.run(avi::FigureEight::problem(), avi::FigureEight::start(), 25.0);
  tally.run(avi::HenonHeiles(), State<2>{.q = {0.0, 0.3}, .p = {0.45, 0.0}}, 60.0);
  EXPECT_GE(tally.near, 26) << "of " << tally.all;
}

TEST(Solution, HasTheOrderThatTakesTheLeastWork) {
  using avi::detail::order_for;
  EXPECT_EQ(order_for(1e-2), 4);
  EXPECT_EQ(order_for(3e-6), 8);
  EXPECT_EQ(order_for(3e-10), 16);
}

// A fall on a slope into a wall, which the pilot does not see.
TEST(Solution, RepeatsTheRunWithTheStepThatTheOrderSays) {
  const auto wall = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.02 * q[0] + exp(-6.0 * q[0]);
  };
  const State<1> start{.q = avi::Vector<double, 1>(20.0), .p = avi::Vector<double, 1>(0.0)};
  for (const auto& [tolerance, order, runs] : {std::tuple{1e-4, 4, 3u}, {1e-6, 8, 3u}, {1e-8, 8, 4u}}) {
    const auto solution = integrate(wall, start, 100.0, tolerance);
    EXPECT_EQ(solution.run.outcome, avi::Outcome::ok) << solution.report();
    EXPECT_EQ(solution.choice.order, order);
    EXPECT_LE(solution.energy_error, 3.0 * tolerance);
    std::vector<avi::Trial> repeated;
    for (const avi::Trial& trial : solution.choice.trials)
      if (trial.outcome == avi::Outcome::stopped) repeated.push_back(trial);
    EXPECT_EQ(repeated.size(), runs) << tolerance;
    repeated.push_back({.monitor = "", .h = solution.choice.h});
    long sweeps = 0;
    for (std::size_t k = 0; k + 1 < repeated.size(); ++k) {
      const double error = repeated[k].energy_error / tolerance, aim = std::pow(0.6 / error, 1.0 / order);
      EXPECT_GT(error, 3.0) << "at the step where that is seen";
      EXPECT_NEAR(repeated[k + 1].h / repeated[k].h, std::max(0.5, aim), 1e-12) << "by a half at most";
      sweeps += repeated[k].sweeps;
    }
    EXPECT_LT(sweeps, solution.choice.sweeps) << "what the runs took counts as what the choice cost";
    EXPECT_GT(sweeps, solution.choice.sweeps / 2);
  }
}

TEST(Solution, IsKeptUpToTenTimesTheTolerance) {
  auto solution = integrate(Kepler(), Kepler::pericentre(0.5), 1.0, 0x1p-20);
  for (const auto& [error, kept] : {std::pair{10.0 * 0x1p-20, true}, {10.1 * 0x1p-20, false}}) {
    solution.energy_error = error;
    EXPECT_EQ(solution.kept(), kept);
    EXPECT_EQ(solution.report().find("more than ten times") == std::string::npos, kept);
  }
  EXPECT_NE(solution.report().find(" steps, "), std::string::npos);
  EXPECT_EQ(integrate(Kepler(), Kepler::pericentre(0.5), 0.0, 1e-6).report().find(" steps, "),
            std::string::npos);
}

TEST(Solution, IsWhereTheOrbitIs) {
  const double period = 2.0 * M_PI;
  const auto solution = integrate(Kepler(), Kepler::pericentre(0.9), 10.5 * period, 1e-12);
  EXPECT_NEAR(solution.state.q[0], -1.9, 1e-10);
  EXPECT_NEAR(solution.state.q[1], 0.0, 1e-9);
}

TEST(Solution, OfNoTimeIsTheStart) {
  const auto solution = integrate(Kepler(), Kepler::pericentre(0.5), 0.0, 1e-6);
  EXPECT_EQ(solution.state.q, Kepler::pericentre(0.5).q);
  EXPECT_EQ(solution.run.steps, 0);
}

TEST(Solution, StaysAtAnEquilibrium) {
  const State<1> rest{.q = avi::Vector<double, 1>(0.0), .p = avi::Vector<double, 1>(0.0)};
  const auto solution = integrate(avi::Pendulum(), rest, 3.0, 1e-6);
  EXPECT_EQ(solution.run.outcome, avi::Outcome::ok) << solution.report();
  EXPECT_EQ(solution.state.q, rest.q);
  EXPECT_NEAR(solution.state.t, 3.0, 1e-14);
}

TEST(Solution, NamesACollision) {
  State<2> z = Kepler::pericentre(0.0);
  z.p.setZero();  // falls into the centre at t = pi / sqrt(8)
  const auto solution = integrate(Kepler(), z, 10.0, 1e-8);
  EXPECT_TRUE(solution.run.outcome != avi::Outcome::ok || !solution.kept());
  EXPECT_FALSE(solution.report().empty());
}

TEST(Solution, RefusesWhatCannotBe) {
  const auto start = Kepler::pericentre(0.5);
  EXPECT_THROW((void)integrate(Kepler(), start, -1.0, 1e-6), std::invalid_argument);
  EXPECT_THROW((void)integrate(Kepler(), start, 1.0, 0.0), std::invalid_argument);
  EXPECT_THROW((void)integrate(Kepler(), start, 1.0, 0.5), std::invalid_argument);
  auto timeless = start;
  timeless.t = std::nan("");
  EXPECT_THROW((void)integrate(Kepler(), timeless, 1.0, 1e-6), std::invalid_argument);
  auto centre = start;
  centre.q.setZero();
  EXPECT_THROW((void)integrate(Kepler(), centre, 1.0, 1e-6), std::invalid_argument);
}

}  // namespace solution_test
