#include "avi/solve.hpp"
#include "kept.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// @file
/// Regular orbits that look like something else: like a pause at a saddle, chaos, or a fall into a pole.

namespace mistaken_test {

using avi::solve, avi::State;

/// The difference of the end from that of a run with the tolerance 1e-11, over the given tolerance.
template <class H>
double error(const H& h, const State<1>& start, double end, double tolerance, double range) {
  const auto orbit = kept(solve(h, start, end, tolerance)), exact = kept(solve(h, start, end, 1e-11));
  return std::abs(orbit.state.q[0] - exact.state.q[0]) / range / tolerance;
}

// Between two wells, an angle that turns hardly changes in comparison with the range that it covers: 115 of
// 240 such orbits were not kept.
TEST(Mistaken, ARotorPausesNowhere) {
  const auto check = [](const auto& potential) {
    const auto h = [&](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + potential(q[0]); };
    for (const double p : {2.3, 3.0, 3.9, 5.0, 6.0}) {
      const State<1> start{.q = {0.3}, .p = {p}};
      EXPECT_LT(error(h, start, 300.0, 1e-8, 300.0 * p), 1.5e-4) << p;  // measured 7.4e-5
    }
  };
  check([](const auto& q) { return -exp(20.0 * (cos(q) - 1.0)); });
  check([](const auto& q) { return -pow(cos(0.5 * q), 6); });
  check([](const auto& q) { return -cos(q) - 0.3 * cos(2.0 * q); });
}

TEST(Mistaken, ADrivenRotorPausesNowhere) {
  const auto lines = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] - p[0] * p[0] * p[0] / 9.0 + 1e-3 * cos(3.0 * q[0] - 2.0 * t) * p[0] +
           1e-3 * p[0] * p[0] * cos(4.0 * q[0] - 3.0 * t);
  };
  EXPECT_LT(error(lines, {.q = {0.0}, .p = {0.5}}, 600.0, 1e-4, 200.0), 1e-5);   // measured 9.1e-7
  EXPECT_LT(error(lines, {.q = {0.0}, .p = {0.8}}, 1500.0, 1e-4, 700.0), 1e-5);  // measured 5.3e-6
}

// Steps that suit the beginning run away later, and with them the unit of energy errors; and errors that grow
// because the motion becomes faster are not chaos.
TEST(Mistaken, ASpringThatStiffensIsNotChaotic) {
  const auto stiffens = [](int power) {
    return [power](const auto& q, const auto& t, const auto& p) {
      return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] * (1.0 + pow(t / 100.0, power));
    };
  };
  EXPECT_LT(error(stiffens(4), {.q = {0.3}, .p = {0.0}}, 300.0, 1e-2, 0.6), 0.05);  // measured 0.025
  EXPECT_LT(error(stiffens(4), {.q = {0.3}, .p = {0.0}}, 300.0, 1e-3, 0.6), 0.05);  // measured 0.012
  EXPECT_LT(error(stiffens(6), {.q = {0.3}, .p = {0.0}}, 300.0, 1e-4, 0.6), 1e-4);  // measured 4.5e-5
}

// A step that jumps over a wall ends on an orbit of another energy, where no step is short enough.
TEST(Mistaken, AWallIsNoDeadEndForLongSteps) {
  const auto check = [](double size, int power, double end, double tolerance) {
    const auto h = [=](const auto& q, const auto& p) {
      return 0.5 * p[0] * p[0] + q[0] * q[0] + size * pow(q[0], -power);
    };
    EXPECT_LT(error(h, {.q = {1.0}, .p = {0.0}}, end, tolerance, 1.0), 3e-4) << power  // measured 1.5e-4
                                                                             << ' ' << tolerance;
  };
  check(1e-12, 12, 30.0, 1e-4);
  check(1e-12, 12, 100.0, 1e-2);
  check(1e-12, 8, 100.0, 1e-5);
  check(1e-8, 8, 30.0, 1e-3);
}

// Where a stiff spring turns near its length at rest, rounding of its force is more than its momentum: steps
// counted as unsolved, and were made a fifty times shorter; or the run ended there.
TEST(Mistaken, RoundingOfAStiffForceIsNoReasonForShorterSteps) {
  const auto elastic = [](const auto& q, const auto& p) {
    const auto longer = sqrt(q[0] * q[0] + q[1] * q[1]) - 1.0;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 5e5 * longer * longer + q[1];
  };
  const State<2> start{.q = {1.0, 0.0}, .p = {0.0, 0.0}};
  const auto orbit = kept(solve(elastic, start, 60.0, 1e-4)), exact = kept(solve(elastic, start, 60.0, 1e-9));
  EXPECT_LT((orbit.state.q - exact.state.q).norm(), 2e-13);  // measured 9.9e-14
  EXPECT_LT(orbit.run.steps, 50'000);                        // measured 24 899; it took 1 310 068
}

// A third body on a circle far away makes the orbit of the first one ever narrower (Kozai 1962; Lidov 1962),
// which a circle at the beginning does not show: equal steps were kept, and made ever shorter.
TEST(Mistaken, ACircleDoesNotStayOne) {
  const auto kozai = [](const auto& q, const auto& t, const auto& p) {
    const auto x = 10.0 * cos(0.05 * t), y = 10.0 * sin(0.05 * t);
    const auto dx = q[0] - x, dy = q[1] - y;
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) -
           1.0 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) - 1.5 / sqrt(dx * dx + dy * dy + q[2] * q[2]) +
           1.5e-3 * (q[0] * x + q[1] * y);
  };
  const double tilt = 89.0 / 180.0 * M_PI;
  const State<3> start{.q = {1.0, 0.0, 0.0}, .p = {0.0, std::cos(tilt), std::sin(tilt)}};
  const auto exact = kept(solve(kozai, start, 2500.0, 1e-11));
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const auto orbit = kept(solve(kozai, start, 2500.0, tolerance));
    EXPECT_LT((orbit.state.q - exact.state.q).norm(), 0.03 * tolerance) << tolerance;  // measured 0.015
    EXPECT_LT(orbit.run.steps, 50'000) << tolerance;  // measured at most 20 592
  }
}

}  // namespace mistaken_test
