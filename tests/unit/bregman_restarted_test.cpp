#include "avi/bregman/bregman_restarted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace bregman_restarted_test {

using avi::VectorX;

/// sum c_i (cosh(x_i - 200) - 1) with c = 1, 4, 9, ...: a valley that is narrow beside the size of x, so that
/// the first step leaves it.
double valley(const VectorX& x, VectorX& gradient) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double c = static_cast<double>((i + 1) * (i + 1));
    gradient[i] = c * std::sinh(x[i] - 200.0);
    sum += c * (std::cosh(x[i] - 200.0) - 1.0);
  }
  return sum;
}

// The iteration of the class's docstring, written down vector by vector.
TEST(BregmanRestarted, IsTheIterationThatItsDocumentationStates) {
  constexpr double P = 3.0;
  const avi::BregmanRestarted method{.P = P};
  VectorX y = VectorX::LinSpaced(6, 200.5, 199.0), x = y, g(6), g0, y0, dy0, dg0, anchor = y;
  avi::Counted objective(valley, 6);
  avi::Iterate now{.x = y, .gradient = VectorX::Zero(6)};
  now.evaluate(objective);
  auto state = method.start(now);
  double L = state.L, best = now.value, last_L = L, k = 0.0;
  EXPECT_GT(L, 0.0);
  int measured = 0, restarts = 0, doublings = 0;
  for (int iteration = 0, since = 0; iteration < 200 && now.gradient.norm() > 1e-6; ++iteration) {
    double f = valley(y, g);
    if (!(f <= best + 1e-10 * std::abs(best))) {  // back to the last restart with twice the curvature
      ++doublings;
      L *= 2.0, k = 0.0, since = 0;
      x = y = anchor;
      f = valley(y, g);
    }
    if (since > 0) {
      const VectorX dy = y - y0, dg = g - g0;
      const double previous = L;
      L = std::max(0.7 * L, dg.norm() / dy.norm());
      if (since > 1) {
        const double c = (dy + g0 / last_L).dot(dy0) / dy0.squaredNorm();
        L = std::max(L, (dg - c * dg0).norm() / (dy - c * dy0).norm());
      }
      measured += L > 0.7 * previous;
      dy0 = dy, dg0 = dg;
    }
    last_L = L, y0 = y, g0 = g;
    const VectorX next = y - g / L;
    if (g.dot(next - x) > 0.0) {
      ++restarts;
      k = 0.0;
      if (f < best) best = f, anchor = y;
    } else {
      k += 1.0;
    }
    y = next + k / (k + P + 1.0) * (next - x);
    x = next;
    ++since;
    ASSERT_EQ(method.update(state, now, objective), avi::Outcome::ok);
    if (!now.evaluated) now.evaluate(objective);
    // Both lose digits where gradients nearly cancel; the same formula keeps them together.
    ASSERT_NEAR((now.x - y).norm(), 0.0, 1e-9) << "iteration " << iteration;
    ASSERT_NEAR(state.L / L, 1.0, 1e-6) << "iteration " << iteration;
  }
  EXPECT_LE(now.gradient.norm(), 1e-6);
  EXPECT_GT(measured, 5);
  EXPECT_GT(restarts, 2);
  EXPECT_GT(doublings, 0);
}

// The first step is a hundredth of x, or for x = 0 one that would bring f down by a hundredth.
TEST(BregmanRestarted, BeginsWithASmallStep) {
  const auto curvature = [](const VectorX& x, const VectorX& gradient, double value) {
    const auto state = avi::BregmanRestarted{}.start({.x = x, .gradient = gradient, .value = value});
    EXPECT_EQ(state.last_L, state.L);
    return state.L;
  };
  const VectorX zero = VectorX::Zero(2), x = Eigen::Vector2d(2.0, -4.0), g = Eigen::Vector2d(8.0, -1.0);
  EXPECT_DOUBLE_EQ(curvature(x, g, 3.0), 8.0 / (0.01 * 4.0));
  EXPECT_DOUBLE_EQ(curvature(zero, g, -3.0), 65.0 / (0.01 * 3.0));
  EXPECT_EQ(curvature(zero, g, 0.0), 1.0);
  EXPECT_EQ(curvature(x, zero, 3.0), 1.0);
}

TEST(BregmanRestarted, FindsCurvaturesBelowOne) {
  const auto bowl = [](const VectorX& x, VectorX& gradient) {
    gradient = 0.01 * x;
    return 0.005 * x.squaredNorm();
  };
  avi::Counted objective(bowl, 2);
  avi::Iterate now{.x = Eigen::Vector2d(2.0, 1.0), .gradient = VectorX::Zero(2)};
  now.evaluate(objective);
  const avi::BregmanRestarted method;
  auto state = method.start(now);
  EXPECT_DOUBLE_EQ(state.L, 1.0);
  double least = 1.0;
  for (int k = 0; k < 15; ++k) {
    ASSERT_EQ(method.update(state, now, objective), avi::Outcome::ok);
    if (!now.evaluated) now.evaluate(objective);
    least = std::min(least, state.L);
  }
  EXPECT_NEAR(least, 0.01, 1e-6);
}

TEST(BregmanRestarted, FindsCurvaturesInDistantUnits) {
  for (const double unit : {1.0, 1e100, 1e-100}) {  // of x: curvatures of 1e-200 and 1e200 have no squares
    const auto bowl = [unit](const VectorX& x, VectorX& gradient) {
      double sum = 0.0;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double c = static_cast<double>(i + 1), at = x[i] / unit - 1.0;
        gradient[i] = c * at / unit;
        sum += 0.5 * c * at * at;
      }
      return sum;
    };
    const auto run = avi::run_updates(bowl, avi::BregmanRestarted{}, VectorX::Constant(10, 3.0 * unit),
                                      {.delta = 1e-10 / unit, .iterations = 200});
    EXPECT_TRUE(run.ok()) << unit << ": " << run.message;  // measured 75 to 105
  }
}

TEST(BregmanRestarted, RefusesAnOrderThatIsNotPositive) {
  const avi::Iterate now{.x = VectorX::Ones(2), .gradient = VectorX::Ones(2), .value = 1.0};
  for (const double P : {0.0, -1.0, std::nan("")})
    EXPECT_THROW((void)avi::BregmanRestarted{.P = P}.start(now), std::invalid_argument);
}

}  // namespace bregman_restarted_test
