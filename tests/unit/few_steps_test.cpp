#include "avi/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace few_steps_test {

using avi::State;

// Near the small body of a restricted problem steps of order 16 do not fall by their order yet: the energy
// says so, and what two runs differ by is believed as far as it falls.
TEST(FewSteps, AreBelievedAsFarAsEnergyErrorsFall) {
  const auto restricted = [](const auto& q, const auto& p) {
    const double mass = 1e-3;
    const auto x = q[0] + mass, y = q[0] - (1.0 - mass);
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + q[1] * p[0] - q[0] * p[1] -
           (1.0 - mass) / sqrt(x * x + q[1] * q[1]) - mass / sqrt(y * y + q[1] * q[1]);
  };
  for (int k = 0; k < 20; ++k) {
    const State<2> start{.q = {0.5 - 0.001, 0.866}, .p = {-0.866 + 0.004 * k, 0.5}};
    const auto reference = avi::solve(restricted, start, 40.0, 1e-12);
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      const auto orbit = avi::solve(restricted, start, 40.0, tolerance, {.order = 16, .monitor = "fixed"});
      if (!orbit.kept() || !reference.kept()) continue;
      EXPECT_LE((orbit.state.q - reference.state.q).norm(), 20.0 * tolerance) << k << " " << orbit.report();
    }
  }
}

}  // namespace few_steps_test
