#include "common/methods/search.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace search_test {

using experiment::matched_step;

TEST(MatchedStep, FollowsTheOrder) {
  int tries = 0;
  const auto error = [&](double h) { return ++tries, 0.3 * std::pow(h, 4.0); };
  EXPECT_NEAR(matched_step(error, 3e-9, 0.7, {.order = 4.0}), 0.01, 1e-12);
  EXPECT_EQ(tries, 2);
}

// The error of a run close to its limit of stability: no power of h.
TEST(MatchedStep, FindsTheTargetOnACliff) {
  const auto error = [](double h) {
    return h > 0.5 ? HUGE_VAL : 1e-3 * std::pow(h, 4.0) + 1e8 * std::exp(-2.0 * M_PI / h);
  };
  for (double start : {0.02, 0.2, 3.0}) {
    const double h = matched_step(error, 1e-4, start, {.order = 4.0, .longest = 2.0, .too_coarse = 1e3});
    EXPECT_LT(std::abs(std::log(error(h) / 1e-4)), 0.02) << start;
  }
}

TEST(MatchedStep, GivesUpWhereTheErrorIsNoNumber) {
  EXPECT_TRUE(std::isnan(matched_step([](double) { return std::nan(""); }, 1.0, 1.0, {.order = 4.0})));
}

}  // namespace search_test
