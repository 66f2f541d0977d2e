#include "src/choice/budget.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace budget_test {

using avi::Outcome, avi::SolvePhase, avi::SolveProgress, avi::detail::Budget;

TEST(Budget, EndsWhereAllSweepsOrStepsAreSpent) {
  const avi::SolveOptions options{.sweeps = 100, .steps = 10};
  Budget budget(options);
  EXPECT_EQ(budget.met(0.0, 9, 99), Outcome::ok);
  EXPECT_EQ(budget.met(0.0, 9, 100), Outcome::step_limit);
  EXPECT_EQ(budget.met(0.0, 10, 0), Outcome::step_limit);
  budget.sweeps = 60;  // of the runs before
  EXPECT_EQ(budget.met(0.0, 9, 39), Outcome::ok);
  EXPECT_EQ(budget.met(0.0, 9, 40), Outcome::step_limit);
  budget.share = 0.75;
  EXPECT_EQ(budget.met(0.0, 9, 14), Outcome::ok);
  EXPECT_EQ(budget.met(0.0, 9, 15), Outcome::step_limit);
  EXPECT_FALSE(budget.cancelled());
}

TEST(Budget, EndsWhenItsTimeIsOver) {
  avi::SolveOptions options{.seconds = 0.0};
  EXPECT_EQ(Budget(options).met(0.0, 1, 1), Outcome::time_limit);
  options.seconds = 1000.0;
  Budget budget(options);
  for (int k = 0; k < 1000; ++k)
    EXPECT_EQ(budget.met(0.0, 1, 1), Outcome::ok);
  budget.share = 1e-9;
  // The clock is not looked at after each of many short steps, but soon.
  int calls = 1;
  Outcome outcome = Outcome::ok;
  while ((outcome = budget.met(0.0, 1, 1)) == Outcome::ok && calls < 1000)
    ++calls;
  EXPECT_EQ(outcome, Outcome::time_limit);
  EXPECT_LE(calls, 64);
  options.seconds = 0.01;
  Budget moment(options);
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  EXPECT_GE(moment.seconds(), 0.015);
  EXPECT_EQ(moment.met(0.0, 1, 1), Outcome::time_limit);
}

TEST(Budget, TellsHowFarTheRunHasCome) {
  std::vector<SolveProgress> seen;
  const avi::SolveOptions options{.progress = [&](const SolveProgress& now) {
    seen.push_back(now);
    return seen.size() < 3;
  }};
  Budget budget(options);
  budget.start = 2.0, budget.end = -2.0;
  budget.sweeps = 100;
  EXPECT_EQ(budget.met(1.0, 5, 50), Outcome::ok);
  ASSERT_EQ(seen.size(), 1u) << "at once";
  EXPECT_EQ(seen[0].phase, SolvePhase::choosing);
  EXPECT_EQ(seen[0].t, 1.0);
  EXPECT_EQ(seen[0].fraction, 0.25);
  EXPECT_EQ(seen[0].steps, 5);
  EXPECT_EQ(seen[0].sweeps, 150);
  // Of a new phase at once again, else twenty times a second.
  budget.phase = SolvePhase::running;
  EXPECT_EQ(budget.met(-3.0, 5, 50), Outcome::ok);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[1].phase, SolvePhase::running);
  EXPECT_EQ(seen[1].fraction, 1.0) << "beyond the end";
  const double before = budget.seconds();
  Outcome outcome = Outcome::ok;
  while (outcome == Outcome::ok && budget.seconds() < before + 10.0)
    outcome = budget.met(0.0, 5, 50);
  EXPECT_EQ(outcome, Outcome::stopped) << "as the third call asked";
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_GE(seen[2].seconds, seen[1].seconds + 0.05);
  EXPECT_TRUE(budget.cancelled());
  EXPECT_EQ(budget.met(0.0, 5, 50), Outcome::stopped);
  EXPECT_EQ(seen.size(), 3u) << "who has said so is not asked again";
}

}  // namespace budget_test
