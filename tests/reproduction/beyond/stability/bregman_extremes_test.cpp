#include "avi/bregman/bregman_htvi.hpp"
#include "avi/optim/run_updates.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

// The measured limits of Bregman dynamics, within about twice the deviations that were seen.

using avi::Outcome, avi::VectorX, experiment::Table;

namespace bregman_extremes_test {

TEST(Overflow, EachFormEndsWhereItsLargestCoefficientDoes) {
  std::map<std::pair<double, double>, std::map<std::string, double>> end;
  for (const auto& row : data::quick.rows("bregman_extremes_overflow")) {
    const double measured = row.number("log10_t_end"), expected = row.number("log10_t_expected");
    if (std::isfinite(expected)) {
      EXPECT_NEAR(measured / expected, 1.0, 1e-3) << row.text("form") << ' ' << row.text("p");
    } else {
      EXPECT_GT(measured, 300.0) << "p <= 2s has no end";
    }
    end[{row.number("p"), row.number("p_ring")}][row.text("form")] = measured;
  }
  EXPECT_GE(end.size(), 15u);
  for (auto& [orders, of] : end) {
    // Half the exponent, twice the logarithm of time; the clock in log t adds what t^(2s) and the step leave.
    EXPECT_NEAR(of["momentum"] / of["printed"], 2.0, 0.06) << orders.first;
    EXPECT_GT(of["heavy_ball"], of["momentum"]) << orders.first;
  }
}

TEST(Overflow, TheFormsAgreeWhereverBothAreFinite) {
  double momentum = 0.0, heavy_ball = 0.0;
  for (const auto& row : data::quick.rows("bregman_extremes_overflow")) {
    EXPECT_GT(row.number("steps_compared"), 1900.0) << "the whole way to the printed form's end";
    double& worst = row.text("form") == "momentum" ? momentum : heavy_ball;
    worst = std::max(worst, row.number("distance_from_printed"));
  }
  EXPECT_LT(momentum, 2e-12);    // seen: 7e-13
  EXPECT_LT(heavy_ball, 2e-12);  // seen: 8e-13
}

TEST(Limit, LinearTheoryHoldsForEveryMethod) {
  std::set<std::string> methods;
  for (const auto& row : data::quick.rows("bregman_extremes_limits")) {
    const std::string method = row.text("method");
    methods.insert(method);
    // Runge-Kutta 4 damps below its limit, so that a growing end of a run starts from less.
    const double above = method == "runge_kutta_4" ? 0.05 : 0.004;
    EXPECT_GT(row.number("ratio"), 0.998) << method << ' ' << row.text("p");
    EXPECT_LT(row.number("ratio"), 1.0 + above) << method << ' ' << row.text("p");
    // One notch beyond: a name and a reason.
    EXPECT_EQ(row.text("beyond_outcome"), "diverged") << method << ' ' << row.text("p");
    EXPECT_NE(row.text("beyond_message").find("left every bound"), std::string::npos);
  }
  EXPECT_EQ(methods.size(), 7u);
}

TEST(Runs, NoneIsSilentlyWrong) {
  std::map<std::string, int> verdicts;
  for (const auto& row : data::quick.rows("bregman_extremes")) {
    ++verdicts[row.text("verdict")];
    EXPECT_NE(row.text("verdict"), "silent")
        << row.text("scene") << ' ' << row.text("method") << ' ' << row.text("fault");
  }
  EXPECT_EQ(verdicts.size(), 3u);
  EXPECT_GT(verdicts["correct"], 40);
  EXPECT_GT(verdicts["named"], 500);
  EXPECT_GT(verdicts["told"], 20);
}

TEST(Runs, AnObjectiveThatSwallowsNanConvergesNowhere) {
  // Returns 0 with gradient 0 for NaN input, where the stopping test would hold.
  const auto swallowing = [calls = 0](const VectorX& x, VectorX& g) mutable {
    g = x;
    if (++calls == 3) g.setConstant(std::nan(""));
    if (!x.allFinite()) return g.setZero(x.size()), 0.0;
    return 0.5 * avi::dot(x, x);
  };
  const auto f = [&](const VectorX& x, VectorX& g) {
    static auto once = swallowing;
    return once(x, g);
  };
  const auto run = avi::run_updates(
      f, avi::BregmanHeavyBall{.family = avi::BregmanFamily::direct(2.0), .h = 0.1}, VectorX::Ones(3));
  EXPECT_EQ(run.outcome, Outcome::non_finite) << run.message;
  EXPECT_TRUE(run.last.x.allFinite());
}

TEST(HeavyBall, GivesThePublishedCounts) {
  // They are made with the momentum form; these three do not hang on the last bit.
  const experiment::CorrelatedQuartic f;
  const auto count = [&](double p, double p_ring, double h) {
    return avi::run_updates(
               f, avi::BregmanHeavyBall{.family = avi::BregmanFamily::adaptive(p, p_ring), .h = h}, f.start())
        .iterations;
  };
  EXPECT_EQ(count(10.0, 10.0, 4e-4), 13872 - 1);
  EXPECT_EQ(count(4.0, 1.0, 2.4e-4), 9361 - 1);
}

TEST(HeavyBall, StopsWithANameAtItsEndAndKeepsTheLastGoodPoint) {
  // Flat enough for its step to reach 1e308; t^50 overflows long before.
  const auto f = [](const VectorX& x, VectorX& g) {
    g = 1e-307 * x;
    return 0.5e-307 * avi::dot(x, x);
  };
  const avi::BregmanHeavyBall method{.family = avi::BregmanFamily::direct(50.0), .h = 900.0};
  const auto run = avi::run_updates(f, method, VectorX::Ones(2), {.delta = 0.0, .iterations = 10'000});
  EXPECT_EQ(run.outcome, Outcome::non_finite);
  EXPECT_TRUE(run.last.x.allFinite());
  EXPECT_GT(run.iterations, 1900);
  EXPECT_LT(run.iterations, 2100);
}

TEST(HeavyBall, StartsAtAnyTime) {
  // At t = 1e100 the momentum form's t^4 has overflowed; the log clock runs, and slowly descends.
  const experiment::CorrelatedQuartic f;
  const avi::BregmanFamily family = avi::BregmanFamily::adaptive(4.0, 1.0);
  const avi::BregmanStart from{.t = 1e100, .momentum = 0.0};
  const double h = 9e-180;
  const avi::Stopping stopping{.delta = 0.0, .iterations = 200};
  const auto light =
      avi::run_updates(f, avi::BregmanHeavyBall{.family = family, .h = h, .from = from}, f.start(), stopping);
  EXPECT_EQ(light.outcome, Outcome::step_limit) << light.message;
  EXPECT_LT(light.last.value, 1.52e8);
  const auto momentum =
      avi::run_updates(f, avi::BregmanHtvi{.family = family, .h = h, .from = from}, f.start(), stopping);
  EXPECT_TRUE(momentum.outcome == Outcome::diverged || momentum.outcome == Outcome::non_finite);
}

}  // namespace bregman_extremes_test
