#include "avi/transform/euler_b.hpp"

#include "avi/problems/kepler.hpp"
#include "avi/transform/monitors.hpp"

#include <gtest/gtest.h>

#include <cmath>

using avi::Kepler, avi::State;

namespace euler_b_test {

/// H = p^2 / 2 in one dimension.
struct Free {
  using Vec = avi::Vector<double, 1>;
  double operator()(const Vec&, const Vec& p) const { return 0.5 * p[0] * p[0]; }
  static double potential(const Vec&) { return 0.0; }
  static Vec potential_gradient(const Vec&) { return Vec(0.0); }
};

const State<2> start = Kepler::exact(0.5, 1.0);

/// |p_1 - (right-hand side of (3.26) with that p_1)|, with g = q . q written out.
double residual(const State<2>& z0, const State<2>& z1, double h, double pt) {
  const double g = z0.q.squaredNorm(), potential = -1.0 / z0.q.norm();
  const Eigen::Vector2d force = z0.q / std::pow(z0.q.norm(), 3), slope = 2.0 * z0.q;
  const Eigen::Vector2d p = z0.p - h * g * force - h * (0.5 * z1.p.squaredNorm() + potential + pt) * slope;
  return (z1.p - p).norm() + (z1.q - (z0.q + h * g * z1.p)).norm() + std::abs(z1.t - (z0.t + h * g));
}

TEST(EulerB, SolvesItsEquation) {
  const double pt = -Kepler{}(start.q, start.p);
  const auto method = avi::euler_b(Kepler{}, start, avi::NormSquared{});
  for (const double h : {0.05, 0.01, -0.01, -0.05}) {
    State<2> z = start;
    ASSERT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
    EXPECT_LT(residual(start, z, h, pt), 1e-14) << h;
    EXPECT_LT((z.p - start.p).norm(), 5.0 * std::abs(h)) << "the root that tends to the start";
  }
}

TEST(EulerB, IsThePlainMethodWithoutAMonitor) {
  auto method = avi::euler_b(Kepler{}, start);
  State<2> z = start;
  ASSERT_EQ(method.step(z, 0.1).outcome, avi::Outcome::ok);
  const Eigen::Vector2d p = start.p - 0.1 * start.q / std::pow(start.q.norm(), 3);
  EXPECT_LT((z.p - p).norm() + (z.q - (start.q + 0.1 * p)).norm(), 1e-15);
  EXPECT_EQ(z.t, start.t + 0.1);
}

TEST(EulerB, LeavesTheStateWhereThereIsNoStep) {
  const auto expect = [](const auto& method, double h, avi::Outcome outcome) {
    State<2> z = start;
    const avi::StepReport report = method.step(z, h);
    EXPECT_EQ(report.outcome, outcome);
    EXPECT_EQ(report.evaluations, 1);
    EXPECT_TRUE(z.q == start.q && z.p == start.p && z.t == start.t);
    return report.residual;
  };
  const auto method = avi::euler_b(Kepler{}, start, avi::NormSquared{});
  // Both signs of B = 1 + h A . grad g.
  for (const double h : {10.0, 30.0, -10.0, -30.0})
    EXPECT_LT(expect(method, h, avi::Outcome::not_converged), 0.0) << h;
  expect(avi::euler_b(Kepler{}, start, [](const auto& q) { return 0.0 * q[0]; }), 0.1,
         avi::Outcome::bad_monitor);
  expect(avi::euler_b(Kepler{}, start, [](const auto& q) { return -1.0 * q[0] * q[0]; }), 0.1,
         avi::Outcome::bad_monitor);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    expect(avi::euler_b(Kepler{}, start, [bad](const auto& q) { return bad + q[0]; }), 0.1,
           avi::Outcome::non_finite);
  expect(avi::euler_b(Kepler{}, start, [](const auto& q) { return 1.0 + pow(q[0] - q[0], 0.5); }), 0.1,
         avi::Outcome::non_finite);  // its slope is
}

TEST(EulerB, BiggestStepIsWhereTheDiscriminantEnds) {
  // In one dimension with T = p^2 / 2, V = 0, p^t = 0, g = q: A = p, B = 1 + h p, and B^2 - h^2 p^2 = 1 + 2 h
  // p.
  const auto g = [](const auto& q) { return 1.0 * q[0]; };
  const avi::EulerB<1, Free, decltype(g)> method(Free{}, g, 0.0);
  const auto outcome = [&](double h) {
    State<1> z{.q = {1.0}, .p = {-1.0}};
    return method.step(z, h).outcome;
  };
  EXPECT_EQ(outcome(0.5), avi::Outcome::ok) << "the double root";
  EXPECT_EQ(outcome(0.5001), avi::Outcome::not_converged);
}

}  // namespace euler_b_test
