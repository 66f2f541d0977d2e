#include "avi/solve.hpp"
#include "src/features/barriers.hpp"

#include <gtest/gtest.h>

#include <cmath>

using avi::Formula, avi::solve, avi::State, avi::detail::Barriers;

namespace barriers_test {

/// Whether a barrier of H, a function of one coordinate, lies between two places.
template <class H>
bool between(const H& h, double from, double to) {
  const Formula formula = Formula::of_phase<1>(h);
  const auto found = Barriers::of(formula.graph(), formula.node());
  if (!found) return false;
  Barriers barriers = *found;
  const double a[]{from, 0.3}, b[]{to, 0.2};
  const auto energy = [&](const double* z) {
    return h(avi::Vector<double, 1>(z[0]), avi::Vector<double, 1>(z[1]));
  };
  return barriers.between(a, b, energy);
}

TEST(Barriers, AreWhereADivisorChangesItsSignAndHIsInfinite) {
  const auto inverse = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + 1e-12 / q[0]; };
  const auto square = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 1e-16 / (2.0 * q[0] * q[0]) + 1e6;
  };
  const auto root = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + pow(abs(q[0]), -0.5); };
  const auto angle = [](const auto& q, const auto& p) {
    const auto over = (p[0] - cos(q[0])) / sin(q[0]);
    return 0.5 * over * over;
  };
  EXPECT_TRUE(between(inverse, 0.7, -0.4));
  EXPECT_TRUE(between(square, -1.0, 0.3));
  EXPECT_TRUE(between(root, 0.7, -0.4));
  EXPECT_TRUE(between(angle, 3.0, 3.3));
  const auto many = [](const auto& q, const auto& p) {
    auto sum = 0.5 * p[0] * p[0];
    for (int k = 1; k <= 200; ++k)
      sum += 1e-12 / (k - q[0]);
    return sum;
  };
  EXPECT_TRUE(between(many, 199.2, 200.3));
  EXPECT_FALSE(between(many, 199.2, 199.3));
  EXPECT_FALSE(between(inverse, 0.7, 0.4));
  EXPECT_FALSE(between(angle, 3.0, 3.1));
}

TEST(Barriers, AreNotWhereWhatIsDividedVanishesOrHHardlyGrows) {
  const auto sinc = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - sin(q[0]) / q[0]; };
  const auto logarithm = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + log(abs(q[0])); };
  EXPECT_FALSE(between(sinc, 0.7, -0.4));
  EXPECT_FALSE(between(logarithm, 0.7, -0.4));
}

TEST(Barriers, AreNotLookedForWhereADivisorIsNeverNegative) {
  const auto none = [](const auto& h) {
    const Formula formula = Formula::of_phase<2>(h);
    return !Barriers::of(formula.graph(), formula.node());
  };
  EXPECT_TRUE(none([](const auto& q, const auto& p) { return 0.5 * p.dot(p) - 1.0 / sqrt(q.dot(q)); }));
  EXPECT_TRUE(none([](const auto& q, const auto& p) {
    return 0.5 * p.dot(p) - pow(q[0] * q[0] + pow(q[1], 4.0) + 0.1, -1.5) + 1.0 / cosh(q[0]);
  }));
  EXPECT_TRUE(none([](const auto& q, const auto& p) { return 0.5 * p.dot(p) + q[0] * q[0] * q[1]; }));
  EXPECT_FALSE(none([](const auto& q, const auto& p) { return 0.5 * p.dot(p) / (1.0 - q[1]); }));
}

// In one dimension the radius of an oscillator is sqrt(cos^2 t + L^2 sin^2 t). Steps of both runs went
// through zero together: the state had the wrong sign, and was called right.
TEST(Barriers, AreNotSteppedOver) {
  for (const double momentum : {1e-3, 1e-4, 1e-5, 1e-7}) {
    const auto radial = [&](const auto& q, const auto& p) {
      return 0.5 * p[0] * p[0] + momentum * momentum / 2.0 / (q[0] * q[0]) + 0.5 * q[0] * q[0];
    };
    const State<1> start{.q = avi::Vector<double, 1>(1.0), .p = avi::Vector<double, 1>(0.0)};
    for (const double end : {4.0, 10.0})
      for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
        const auto orbit = solve(radial, start, end, tolerance);
        EXPECT_TRUE(orbit.kept()) << orbit.report();
        EXPECT_NEAR(orbit.state.q[0], std::hypot(std::cos(end), momentum * std::sin(end)), tolerance)
            << orbit.report();
      }
  }
}

TEST(Barriers, EndARunWhoseStepIsGiven) {
  const auto radial = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.5e-8 / (q[0] * q[0]) + 0.5 * q[0] * q[0];
  };
  const State<1> start{.q = avi::Vector<double, 1>(1.0), .p = avi::Vector<double, 1>(0.0)};
  const auto orbit = solve(radial, start, 4.0, 1e-6, {.order = 8, .monitor = "fixed", .h = 0.9});
  EXPECT_EQ(orbit.run.outcome, avi::Outcome::not_converged);
  EXPECT_NE(orbit.report().find("a step went over a place where H is infinite"), std::string::npos)
      << orbit.report();
  EXPECT_GT(orbit.state.q[0], 0.0);
}

}  // namespace barriers_test
