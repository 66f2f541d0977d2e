#include "beyond/speed/automatic_monitors/drift_verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using experiment::DriftVerdict;
using experiment::ErrorSeries;

namespace drift_verdict_test {

constexpr double end = 1000.0;

/// Errors up to a time: noise about `curve`, the same up to `end` in a longer run.
template <class Curve>
ErrorSeries follow(const Curve& curve, double to) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 1.0);
  ErrorSeries series;
  for (double t = 0.5; t < to; t += 0.5) {
    series.times.push_back(t);
    series.errors.push_back(curve(t) + noise(random));
  }
  return series;
}

template <class Curve>
DriftVerdict judge(const Curve& curve, double rounding = 0.0) {
  const ErrorSeries first = follow(curve, end);
  return experiment::judge_drift(avi::fit_drift(first.times, first.errors, 20), end, rounding,
                                 [&] { return follow(curve, 2.0 * end); });
}

TEST(DriftVerdict, NeedsNoSecondRunWhereNothingGrows) {
  const DriftVerdict verdict = judge([](double) { return 0.0; });
  EXPECT_TRUE(verdict.none);
  EXPECT_FALSE(verdict.twice);
}

TEST(DriftVerdict, LetsTheSecondRunDecideWhatTheFirstOneHasSeen) {
  // What comes to rest looks like a drift in the first run and in both together.
  const DriftVerdict swing = judge([](double t) { return 3e-3 * std::min(t, end); });
  EXPECT_TRUE(swing.twice);
  EXPECT_TRUE(swing.none) << avi::corrected_t(swing.again);
  const DriftVerdict drift = judge([](double t) { return 3e-3 * t; });
  EXPECT_TRUE(drift.twice);
  EXPECT_FALSE(drift.none);
  EXPECT_NEAR(drift.again.slope, 3e-3, 5e-4);
}

TEST(DriftVerdict, LeavesAChangeBelowRoundingAlone) {
  const DriftVerdict verdict = judge([](double t) { return 3e-3 * t; }, 4.0);
  EXPECT_TRUE(verdict.none);
  EXPECT_FALSE(verdict.twice);
}

}  // namespace drift_verdict_test
