#include "avi/diagnostics/order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace order_test {

std::vector<double> halvings(double first, int count) {
  std::vector<double> h;
  for (int i = 0; i < count; ++i)
    h.push_back(std::ldexp(first, -i));
  return h;
}

TEST(FitOrder, FindsThePowerOfAPowerLaw) {
  for (const double order : {0.4, 1.0, 4.0, 12.0}) {
    const auto h = halvings(0.1, 6);
    std::vector<double> error;
    for (double step : h)
      error.push_back(3.0 * std::pow(step, order));
    const auto fit = avi::fit_order(h, error);
    EXPECT_NEAR(fit.order, order, 1e-12);
    EXPECT_EQ(fit.points, 6);
  }
}

TEST(FitOrder, DropsThePlateauWithAndWithoutAFloor) {
  const auto h = halvings(0.1, 12);
  std::vector<double> error;
  for (double step : h)
    error.push_back(std::pow(step, 4) + 1e-11);
  for (double floor : {0.0, 1e-10}) {
    const auto fit = avi::fit_order(h, error, {.floor = floor});
    EXPECT_GE(fit.points, 5);
    EXPECT_LE(fit.points, 8);
    EXPECT_NEAR(fit.order, 4.0, 0.2) << "floor " << floor;
  }
}

TEST(FitOrder, SaysNaNWhenTooFewPointsAreLeft) {
  const auto h = halvings(0.1, 5);
  const std::vector<double> error{1e-2, 1e-5, 1e-15, 1e-15, 1e-15};
  const auto fit = avi::fit_order(h, error, {.floor = 1e-14});
  EXPECT_EQ(fit.points, 2);
  EXPECT_TRUE(std::isnan(fit.order));
}

TEST(FitOrder, PassesOverBreakdownAtLargeSteps) {
  const auto h = halvings(1.0, 5);
  const double nan = std::nan("");
  const auto fit = avi::fit_order(h, std::vector<double>{nan, 0.4, 0.1, 0.025, 0.00625});
  EXPECT_EQ(fit.points, 4);
  EXPECT_NEAR(fit.order, 2.0, 1e-12);
}

TEST(FitOrder, FitsTheSmallestStepsWhenAsked) {
  const auto h = halvings(1.0, 8);
  std::vector<double> error;
  for (double step : h)
    error.push_back(step * step * (1.0 + 5.0 * step));
  EXPECT_GT(avi::fit_order(h, error).order, 2.3);
  EXPECT_NEAR(avi::fit_order(h, error, {.at_most = 3}).order, 2.0, 0.15);
}

// Halvings of h, so that slopes are differences of binary logarithms.
TEST(FitOrder, EndsWhereTheSlopeFallsBelowHalfTheSteepest) {
  const auto points = [](std::vector<double> logarithms, avi::OrderOptions options = {}) {
    for (double& value : logarithms)
      value = std::exp2(value);
    return avi::fit_order(halvings(1.0, static_cast<int>(logarithms.size())), logarithms, options).points;
  };
  EXPECT_EQ(points({0.0, -4.0, -8.0, -10.1, -12.2}), 5) << "slopes 4, 4, 2.1, 2.1";
  EXPECT_EQ(points({0.0, -4.0, -8.0, -9.9, -14.0}), 3) << "1.9 ends it";
  EXPECT_EQ(points({0.0, -2.0, -6.0, -7.9}), 3) << "the steepest so far";
  EXPECT_EQ(points({0.0, 1.0, -3.0}), 1) << "no order where the error grows";
  EXPECT_EQ(points({0.0, 0.0, -4.0}), 1) << "or stays";
  EXPECT_EQ(points({0.0, -4.0, -8.0}, {.floor = 0x1p-8}), 2) << "at the floor is round-off";
  EXPECT_EQ(points({0.0, -4.0, -8.0}, {.floor = 0x1p-9}), 3);
}

TEST(FitOrder, TakesSlopesWhateverTheRatioOfSteps) {
  const std::vector<double> h{1.0, 0.5, 0.01, 0.009};
  std::vector<double> error;
  for (const double step : h)
    error.push_back(7.0 * std::pow(step, 4));
  const auto fit = avi::fit_order(h, error);
  EXPECT_EQ(fit.points, 4);
  EXPECT_NEAR(fit.order, 4.0, 1e-12);
  EXPECT_EQ(avi::fit_order(h, std::vector{1.0, 0.1, 0.0, 1e-9}, {.floor = -1.0}).points, 2) << "0 is none";
}

TEST(FitOrder, TakesAsFewPointsAsItIsTold) {
  const std::vector<double> h{0.2, 0.1}, error{1.0, 0.5};
  EXPECT_TRUE(std::isnan(avi::fit_order(h, error).order)) << "three, unless told";
  EXPECT_NEAR(avi::fit_order(h, error, {.at_least = 2}).order, 1.0, 1e-14);
  EXPECT_THROW(avi::fit_order(h, error, {.at_least = 1}), std::invalid_argument);
  const std::vector<double> three{0.4, 0.2, 0.1};
  EXPECT_NEAR(avi::fit_order(three, three).order, 1.0, 1e-14);
  const std::vector<double> back{-0.4, -0.2, -0.1};
  EXPECT_NEAR(avi::fit_order(back, three).order, 1.0, 1e-14) << "of |h|";
  EXPECT_EQ(avi::fit_order(three, three, {.at_most = 3}).points, 3);
}

TEST(FitOrder, RefusesBadInput) {
  for (const double h : {0.0, std::nan(""), HUGE_VAL, -HUGE_VAL})
    EXPECT_THROW(avi::fit_order(std::vector{0.1, h}, std::vector{1.0, 1.0}), std::invalid_argument) << h;
  EXPECT_THROW(avi::fit_order(std::vector{0.1, 0.2}, std::vector{1.0}), std::invalid_argument);
  const std::vector<double> three{1.0, 0.5, 0.2};
  for (const int most : {0, -1})
    EXPECT_THROW(avi::fit_order(three, three, {.at_most = most}), std::invalid_argument) << most;
  EXPECT_THROW(avi::fit_order(std::vector{0.1, 0.1, 0.1}, three), std::invalid_argument);
  EXPECT_THROW(avi::fit_order(std::vector{0.2, 0.1, -0.1}, three), std::invalid_argument);
}

}  // namespace order_test
