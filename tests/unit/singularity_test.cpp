#include "avi/problems/kepler.hpp"
#include "avi/solve.hpp"

#include <gtest/gtest.h>

#include <string>

namespace singularity_test {

using avi::State;

void expect_says(const auto& energy, const auto& start, const std::string& sentence) {
  const auto orbit = avi::solve(energy, start, start.t + 30.0, 1e-8);
  EXPECT_FALSE(orbit.ok());
  EXPECT_NE(orbit.run.message.find(sentence), std::string::npos) << orbit.run.message;
}

TEST(Singularity, IsWhereTheRunSays) {
  // From rest at 1 a body falls in the time pi / (2 sqrt 2).
  expect_says(avi::Kepler(), State<2>{.q = {1.0, 0.0}, .p = {0.0, 0.0}, .t = 5.0},
              "Runs fail at t = 6.11072 with every step");
  // No number beyond q = 2, which is reached with a finite velocity: after 0.33465, by a quadrature.
  const auto edge = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + q[0] * q[0]) + sqrt(2.0 - q[0]);
  };
  expect_says(edge, State<1>{.q = {1.0}, .p = {3.1}, .t = 5.0}, "from t = 5.3346");
}

// Where q grows beyond all bounds, 1 / (1 - t) here, no step is refused: what is told is where the motion is
// fastest.
TEST(Singularity, IsWhereTheMotionHasNoBound) {
  const auto away = [](const auto& q, const auto& p) { return q[0] * q[0] * p[0]; };
  expect_says(away, State<1>{.q = {1.0}, .p = {1.0}, .t = 5.0}, "near t = 6.00");
}

}  // namespace singularity_test
