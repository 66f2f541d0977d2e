#include "avi/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace node_of_vibration_test {

constexpr int n = 32;

/// A ring of masses with springs of the kind of Fermi, Pasta, Ulam and Tsingou.
const auto ring = [](const auto& q, const auto& p) {
  auto energy = 0.5 * p[0] * p[0];
  for (int i = 1; i < n; ++i)
    energy += 0.5 * p[i] * p[i];
  for (int i = 0; i < n; ++i) {
    const auto gap = q[(i + 1) % n] - q[i];
    energy += 0.5 * gap * gap + 0.25 * gap * gap * gap * gap;
  }
  return energy;
};

avi::State<avi::dynamic> wave(double phase) {
  avi::State<avi::dynamic> z{.q = avi::VectorX::Zero(n), .p = avi::VectorX::Zero(n)};
  for (int i = 0; i < n; ++i)
    z.q[i] = std::sin(2.0 * M_PI * (i + 1) / n + phase);
  return z;
}

// Two masses stay where they are but for rounding, which is no error of theirs.
TEST(NodeOfVibration, CountsAsTheOthersDo) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const auto node = avi::solve(ring, wave(0.0), 100.0, tolerance);
    const auto none = avi::solve(ring, wave(0.1), 100.0, tolerance);
    EXPECT_TRUE(node.kept()) << node.report();
    EXPECT_TRUE(none.kept()) << none.report();
    EXPECT_LT(node.run.steps, 10 * none.run.steps);
    EXPECT_LT(std::abs(node.state.q[15]), 1e-13);
  }
}

}  // namespace node_of_vibration_test
