#include "avi/diagnostics/order.hpp"

#include <gtest/gtest.h>

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

TEST(FitOrder, RefusesBadInput) {
  const std::vector<double> h{0.1, 0.0}, error{1.0, 1.0};
  EXPECT_THROW(avi::fit_order(h, error), std::invalid_argument);
  EXPECT_THROW(avi::fit_order(h, std::vector<double>{1.0}), std::invalid_argument);
}

}  // namespace order_test
