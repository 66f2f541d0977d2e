#include "avi/avi.hpp"
#include "common/methods/runge_kutta_4.hpp"

#include <gtest/gtest.h>

#include <cmath>

using avi::dynamic, avi::State, avi::VectorX;

namespace branch_test {

/// A body between a spring and a wall that begins at q = 1: smooth enough for orders up to 4. To the left of
/// it the wall's formula has no value.
const auto soft_wall = [](const auto& q, const auto& p) {
  using std::max, std::sqrt, std::log1p;
  const auto depth = q[0] - 1.0, root = sqrt(depth), over = max(depth, 0.0);
  const auto wall =
      avi::select(depth > 0.0, root * root * over * over * over * over + 0.0 * log1p(depth), 0.0);
  return 0.5 * (p[0] * p[0] + q[0] * q[0]) + 40.0 * wall;
};
/// The same as one would write it for doubles.
struct Branch {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const auto depth = q[0] - 1.0;
    auto energy = 0.5 * (p[0] * p[0] + q[0] * q[0]);
    if (depth > 0.0) energy += 40.0 * (depth * depth * depth * depth * depth);
    return energy;
  }
};

template <class Method, int n>
State<n> after(Method method, State<n> z, double h = 0.01, long steps = 500) {
  EXPECT_EQ(avi::integrate(method, z, h, {.steps = steps}).outcome, avi::Outcome::ok);
  return z;
}

TEST(Branch, IsAcceptedByEveryMethod) {
  const State<1> z{.q = {0.5}, .p = {1.2}};
  const State<dynamic> x{.q = VectorX{{0.5}}, .p = VectorX{{1.2}}};
  // A method for doubles alone may branch as they do.
  const auto reference = after(experiment::RungeKutta4<1, Branch>(Branch{}), z, 1e-3, 5000);
  const auto taylor = after(avi::htvi<4>(avi::poincare<1>(soft_wall, z)), z);
  const auto packs = after(avi::collocation(avi::poincare<1>(soft_wall, z), 6), z);
  const auto recorded = after(avi::collocation(avi::poincare<dynamic>(soft_wall, x), 6), x);
  EXPECT_NEAR(taylor.q[0], reference.q[0], 1e-6);
  EXPECT_NEAR(packs.q[0], reference.q[0], 1e-6);
  EXPECT_NEAR(recorded.q[0], packs.q[0], 1e-12);
  EXPECT_NEAR(soft_wall(packs.q, packs.p), Branch{}(z.q, z.p), 1e-7);
}

TEST(Branch, IsAcceptedByMinimise) {
  const auto f = [](const auto& x) {
    using avi::select;
    const auto d = x[0] - 2.0;
    return select(x[0] < 2.0, d * d, 3.0 * d * d) + (x[1] + x[0]) * (x[1] + x[0]);
  };
  const auto found = avi::minimise(f, VectorX{{5.0, 1.0}});
  EXPECT_EQ(found.outcome, avi::Outcome::ok);
  EXPECT_NEAR(found.last.x[0], 2.0, 1e-5);
  EXPECT_NEAR(found.last.x[1], -2.0, 1e-5);
}

}  // namespace branch_test
