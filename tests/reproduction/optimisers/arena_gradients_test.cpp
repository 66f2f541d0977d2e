#include "optimisers/optimiser_arena/problems/problem.hpp"

#include "src/minimise/slope_check.hpp"

#include <gtest/gtest.h>

using avi::VectorX;

namespace arena_gradients_test {

TEST(ArenaGradients, AreThoseOfTheValues) {
  const auto problems = arena::all_problems(false, true);
  EXPECT_GE(problems.size(), 60u);
  for (const auto& problem : problems) {
    const Eigen::Index n = problem.x0.size();
    VectorX d(n), g(n), unused(n), x(n);
    avi::mixed_direction(problem.x0, d);
    d *= 0.1;
    x = problem.x0 + d;  // off the start, where entries may vanish or agree
    problem.f(x, g);
    const auto by_values =
        avi::slope_by_values([&](double h) { return problem.f(VectorX(x + h * d), unused); }, 1e-3);
    const double slope = avi::dot(g, d);
    EXPECT_NEAR(by_values.slope, slope, 1e-4 * std::abs(slope) + 2.0 * by_values.uncertainty) << problem.name;
    EXPECT_LT(by_values.uncertainty, 0.02 * std::abs(slope))
        << problem.name << ": the differences say nothing";
  }
}

}  // namespace arena_gradients_test
