#include "avi/diagnostics/drift.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <random>

namespace drift_test {

TEST(FitDrift, MatchesAHandComputedLine) {
  // Residuals of (0, 1, 2, 3) -> (0, 2, 1, 3): slope 0.8, residual sum of squares 1.8.
  const std::vector<double> t{0.0, 1.0, 2.0, 3.0}, x{0.0, 2.0, 1.0, 3.0};
  const auto fit = avi::fit_drift(t, x);
  EXPECT_NEAR(fit.slope, 0.8, 1e-14);
  EXPECT_NEAR(fit.standard_error, std::sqrt(1.8 / 2.0 / 5.0), 1e-14);
  EXPECT_NEAR(fit.t_statistic, 0.8 / std::sqrt(0.18), 1e-13);
  EXPECT_NEAR(fit.correlation, -0.75, 1e-14);  // residuals -0.3, 0.9, -0.9, 0.3
  EXPECT_EQ(avi::corrected_t(fit), fit.t_statistic);
}

TEST(FitDrift, AveragesOverBlocks) {
  // Seven points in blocks of 2, 2 and 3: means at t = 0.5, 2.5, 5 of the values 1, 3 and 4.
  const std::vector<double> t{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, x{0.0, 2.0, 3.0, 3.0, 6.0, 0.0, 6.0};
  const auto fit = avi::fit_drift(t, x, 3);
  const auto means = avi::fit_drift(std::vector{0.5, 2.5, 5.0}, std::vector{1.0, 3.0, 4.0});
  EXPECT_EQ(fit.points, 3);
  EXPECT_NEAR(fit.slope, means.slope, 1e-14);
  EXPECT_NEAR(fit.standard_error, means.standard_error, 1e-14);
}

TEST(FitDrift, TakesTimesOfAnyUnit) {
  for (const double unit : {1e-9, 1e9}) {
    const std::vector<double> t{0.0, unit, 2.0 * unit, 3.0 * unit}, x{0.0, 2.0, 1.0, 3.0};
    const auto fit = avi::fit_drift(t, x);
    EXPECT_NEAR(fit.slope * unit, 0.8, 1e-14);
    EXPECT_NEAR(fit.standard_error * unit, std::sqrt(0.18), 1e-14);
  }
}

TEST(FitDrift, KnowsNothingOfResidualsThatAreZero) {
  const std::vector<double> t{0.0, 1.0, 2.0}, x{1.0, 3.0, 5.0};
  const auto fit = avi::fit_drift(t, x);
  EXPECT_EQ(fit.slope, 2.0);
  EXPECT_EQ(fit.standard_error, 0.0);
  EXPECT_EQ(fit.correlation, 0.0);
}

TEST(FitDrift, CountsCorrelatedPointsForLess) {
  // Of a correlation of 0.6 a quarter: half of the statistic.
  EXPECT_NEAR(avi::corrected_t({.t_statistic = 6.0, .correlation = 0.6}), 3.0, 1e-14);
  // Series without a drift of which each point keeps 0.7 of the last one.
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  int plain = 0, corrected = 0;
  for (int series = 0; series < 400; ++series) {
    std::vector<double> t, x;
    double value = noise(random);
    for (int i = 0; i < 40; ++i) {
      value = 0.7 * value + noise(random);
      t.push_back(i);
      x.push_back(value);
    }
    const auto fit = avi::fit_drift(t, x);
    plain += std::abs(fit.t_statistic) > 3.0;
    corrected += std::abs(avi::corrected_t(fit)) > 3.0;
  }
  EXPECT_GT(plain, 40);
  EXPECT_LT(corrected, 0.3 * plain);
}

TEST(FitDrift, TellsNoiseFromDrift) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 1e-6);
  std::vector<double> t, still, drifting;
  for (int i = 0; i < 20000; ++i) {
    t.push_back(i);
    const double oscillation = 1e-5 * std::sin(0.7 * i) + noise(random);
    still.push_back(oscillation);
    drifting.push_back(oscillation + 1e-11 * i);
  }
  EXPECT_LT(std::abs(avi::fit_drift(t, still, 50).t_statistic), 3.0);
  const auto fit = avi::fit_drift(t, drifting, 50);
  EXPECT_GT(fit.t_statistic, 6.0);
  EXPECT_NEAR(fit.slope, 1e-11, 3.0 * fit.standard_error);
  EXPECT_EQ(fit.points, 50);
}

TEST(FitDrift, SeesNoDriftWhereNothingMoves) {
  const auto fit = avi::fit_drift(std::vector{0.0, 1.0, 2.0}, std::vector{0.0, 0.0, 0.0});
  EXPECT_EQ(fit.t_statistic, 0.0);
  EXPECT_EQ(avi::corrected_t(fit), 0.0);
  EXPECT_EQ(fit.points, 3);
  EXPECT_EQ(avi::DriftFit{}.points, 0) << "of no series";
}

TEST(FitDrift, IsTheSameInUnitsOfAnySize) {
  const auto fit = [](double time, double value, int blocks) {
    std::vector<double> times, values;
    for (int i = 0; i < 100; ++i) {
      times.push_back(time * i);
      values.push_back(value * (2.0 * i + std::sin(1.7 * i)));
    }
    return avi::fit_drift(times, values, blocks);
  };
  for (const int blocks : {0, 10}) {
    const auto plain = fit(1.0, 1.0, blocks);
    EXPECT_NEAR(plain.slope, 2.0, 0.02);
    for (const double time : {1e-170, 1e-30, 1e30, 1e154, 1e290})
      for (const double value : {1e-12, 1.0, 1e100}) {
        const auto scaled = fit(time, value, blocks);
        EXPECT_NEAR(scaled.slope * time / value, plain.slope, 1e-12) << time << ' ' << value;
        EXPECT_NEAR(scaled.t_statistic, plain.t_statistic, 1e-9 * plain.t_statistic) << time << ' ' << value;
        EXPECT_NEAR(scaled.correlation, plain.correlation, 1e-9) << time << ' ' << value;
      }
  }
}

TEST(FitDrift, RefusesBadInput) {
  const std::vector<double> two{0.0, 1.0}, same{1.0, 1.0, 1.0}, three{0.0, 1.0, 2.0};
  EXPECT_THROW(avi::fit_drift(two, two), std::invalid_argument);
  EXPECT_THROW(avi::fit_drift(three, two), std::invalid_argument);
  EXPECT_THROW(avi::fit_drift(same, three), std::invalid_argument);
  // Their mean is not one of them.
  for (const double t : {0.1, 0.7, 1e9 + 0.3, 1e-200}) {
    for (const std::size_t n : {3u, 6u, 7u, 100u}) {
      const std::vector<double> times(n, t);
      std::vector<double> values(n);
      for (std::size_t i = 0; i < n; ++i)
        values[i] = static_cast<double>(i % 5);
      for (const int blocks : {0, 3})
        EXPECT_THROW(avi::fit_drift(times, values, blocks), std::invalid_argument) << t << ' ' << n;
    }
    const std::vector<double> near{t, t * (1.0 + 1e-12), t * (1.0 + 2e-12)};
    EXPECT_NO_THROW(avi::fit_drift(near, three)) << t;
  }
  for (const int blocks : {-1, 1, 2, 4})
    EXPECT_THROW(avi::fit_drift(three, three, blocks), std::invalid_argument) << blocks;
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double> times = three;
    times[i] = std::nan("");
    EXPECT_EQ(refusal([&] { (void)avi::fit_drift(times, three); }),
              "Time of a point is nan; it must be finite.");
  }
}

}  // namespace drift_test
