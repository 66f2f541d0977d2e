#include "avi/avi.hpp"
#include "kept.hpp"
#include "resumed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

/// @file
/// Steps that end at the kinks of H.

namespace kinks_test {

using avi::solve, avi::State;

const auto ramp = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + abs(q[0]); };
const State<1> resting{.q = {1.0}, .p = {0.0}};

/// Free fall to and fro, from rest at 1.
double fallen(double t) {
  const double quarter = std::sqrt(2.0), x = std::fmod(std::abs(t), 4.0 * quarter);
  if (x < quarter) return 1.0 - 0.5 * x * x;
  if (x < 3.0 * quarter) return 0.5 * (x - 2.0 * quarter) * (x - 2.0 * quarter) - 1.0;
  return 1.0 - 0.5 * (x - 4.0 * quarter) * (x - 4.0 * quarter);
}

// At 1e-7 it was refused after five million sweeps, with steps of 4e-5.
TEST(Kinks, CostSomeStepsEach) {
  for (const double end : {55.0, -55.0})
    for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
      const auto orbit = kept(solve(ramp, resting, end, tolerance));
      EXPECT_NEAR(orbit.state.q[0], fallen(end), 3e-12);             // measured 1.1e-12
      EXPECT_LT(orbit.run.evaluations + orbit.choice.sweeps, 3000);  // measured at most 1527
    }
}

// A spring that is harder on one side: half of a period of each.
TEST(Kinks, LeaveTheOrder) {
  const auto spring = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.5 * select(q[0] < 0.0, 9.0 * q[0] * q[0], q[0] * q[0]);
  };
  const double period = M_PI * (1.0 + 1.0 / 3.0);
  for (const double periods : {1.0, 100.0}) {
    const auto orbit = kept(solve(spring, State<1>{.q = {0.5}, .p = {0.0}}, periods * period, 1e-11));
    EXPECT_NEAR(orbit.state.q[0], 0.5, 2e-15);  // measured 7e-16
    EXPECT_NEAR(orbit.state.p[0], 0.0, 5e-14);  // measured 2.3e-14
  }
}

// Times, events and the curve know them, too. Measured: at most 5.4e-15.
TEST(Kinks, AreOnTheWay) {
  std::vector<double> times;
  for (int i = 0; i <= 100; ++i)
    times.push_back(0.3 * i);
  const auto zero = [](const auto& q, const auto&) { return q[0]; };
  const auto orbit = kept(solve(ramp, resting, times, 1e-10, {.dense = true, .events = {avi::when(zero)}}));
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(orbit.states[i].q[0], fallen(times[i]), 1.2e-14);
  ASSERT_EQ(orbit.events.size(), 11u);
  for (std::size_t k = 0; k < orbit.events.size(); ++k)
    EXPECT_NEAR(orbit.events[k].state.t, std::sqrt(2.0) * (2.0 * static_cast<double>(k) + 1.0), 1.2e-14);
  for (double t = 0.05; t < 30.0; t += 0.17)
    EXPECT_NEAR(orbit(t).q[0], fallen(t), 1.2e-14);
}

// Two balls between soft walls that meet each other. Steps beside that know nothing of kinks err by the
// square of their length, 2.1e-5; by 2.2e-7 where they are a tenth as long.
TEST(Kinks, MayBeSeveral) {
  const auto balls = [](const auto& q, const auto& p) {
    const auto push = [](const auto& depth) {
      using std::max;
      const auto d = max(depth, 0.0 * depth);
      return 50.0 * d * d;
    };
    return 0.5 * p.squaredNorm() + push(-1.0 - q[0]) + push(q[0] - q[1] + 0.2) + push(q[1] - 1.0);
  };
  const State<2> start{.q = {-0.5, 0.6}, .p = {1.0, -0.7}};
  const auto apart = [](const State<2>& a, const State<2>& b) {
    return (a.q - b.q).norm() + (a.p - b.p).norm();
  };
  auto method = avi::collocation(avi::poincare(balls, start), 4);
  State<2> beside = start;
  EXPECT_TRUE(avi::integrate_to(method, beside, 2e-4, 20.0).ok());
  const State<2> truth = solve(balls, start, 20.0, 1e-12).state;
  EXPECT_LT(apart(beside, truth), 4.2e-5);
  for (const double tolerance : {1e-4, 1e-8}) {
    const auto orbit = kept(solve(balls, start, 20.0, tolerance));
    EXPECT_LT(apart(orbit.state, truth), 2e-3 * tolerance);  // measured 3.2e-8 and 7.9e-12
  }
}

// A run that is interrupted goes on with the same bits.
TEST(Kinks, AreKnownToACheckpoint) { expect_to_go_on(ramp, resting, 300.0, 1e-8, {.check = false}, 400); }

// A drive that switches between two forces, and a kink in q: in between all is a parabola. Measured: at most
// 2.3e-13.
TEST(Kinks, AreFoundBesideSwitches) {
  const auto driven = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] + abs(q[0]) + select(cos(2.0 * t) > 0.0, 0.3, -0.3) * q[0];
  };
  const double end = 55.0, half = 0.5 * M_PI;
  double q = 1.0, p = 0.0;
  for (double t = 0.0; t < end;) {
    const double next = std::min(end, (std::floor(t / half + 0.5 + 1e-9) + 0.5) * half);
    const double slope = q != 0.0 ? q : p;
    const double push = -std::copysign(1.0, slope) - std::copysign(0.3, std::cos(t + next));
    double way = next - t;
    bool meets = false;
    for (const double sign : {1.0, -1.0}) {  // q + p s + push s^2 / 2 = 0
      const double root = p * p - 2.0 * push * q, s = (-p + sign * std::sqrt(root)) / push;
      if (root >= 0.0 && s > 1e-12 && s < way) way = s, meets = true;
    }
    q = meets ? 0.0 : q + p * way + 0.5 * push * way * way;
    p += push * way;
    t = meets ? t + way : next;
  }
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    const auto orbit = kept(solve(driven, resting, end, tolerance));
    EXPECT_NEAR(orbit.state.q[0], q, 4.6e-13);
    EXPECT_NEAR(orbit.state.p[0], p, 4.6e-13);
  }
}

// A ball falls from 1 onto a ground that is touched for a hundredth of the time: steps that are longer than
// that were alike in both runs, and the end that was kept was wrong by a thousand tolerances.
TEST(Kinks, MayBeCloserThanSteps) {
  constexpr double g = 9.81, hardness = 1e8, end = 10.3;
  const auto ball = [](const auto& q, const auto& p) {
    using std::max;
    const auto depth = max(-q[0], 0.0 * q[0]);
    return 0.5 * p[0] * p[0] + g * q[0] + hardness * pow(depth, 4);
  };
  double deepest = 0.1;  // g (1 + d) = hardness d^4, by Newton's method
  for (int k = 0; k < 50; ++k)
    deepest -=
        (hardness * std::pow(deepest, 4) - g * (1.0 + deepest)) / (4.0 * hardness * std::pow(deepest, 3) - g);
  double touch = 0.0;  // twice the integral of dd / v, with d = deepest (1 - s^2)
  constexpr int points = 200'000;
  for (int k = 0; k < points; ++k) {
    const double s = (k + 0.5) / points, d = deepest * (1.0 - s * s);
    // The fall of the potential from the deepest point, without cancellation.
    const double rise = deepest * s * s, sum = deepest + d;
    const double fall = rise * (hardness * sum * (deepest * deepest + d * d) - g);
    touch += 2.0 * 2.0 * deepest * s / std::sqrt(2.0 * fall) / points;
  }
  const double down = std::sqrt(2.0 / g), since = std::fmod(end, 2.0 * down + touch);
  ASSERT_GT(std::abs(since - down - 0.5 * touch), touch) << "the end is in free fall";
  const double away = since < down ? since : since - 2.0 * down - touch, exact = 1.0 - 0.5 * g * away * away;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    const auto orbit = kept(solve(ball, State<1>{.q = {1.0}, .p = {0.0}}, end, tolerance));
    EXPECT_NEAR(orbit.state.q[0], exact, 1e-9);  // measured 5.1e-10, 2.2e-13, 8.2e-12
  }
}

State<2> drawn(std::mt19937& draw) {
  std::normal_distribution<double> some(0.0, 0.6);
  State<2> z;
  z.q << some(draw), some(draw);
  z.p << some(draw), some(draw);
  return z;
}

// Two coordinates change their signs so soon one after the other that |x y| does not show it at any of the
// points in a step. Both runs went on over that; of 60 orbits 4 were wrong by 45 to 490 tolerances.
TEST(Kinks, MayBeTwiceBetweenTwoPoints) {
  const auto pushed = [](const auto& q, const auto& p) {
    return 0.5 * p.squaredNorm() + 0.5 * q.squaredNorm() + 0.3 * (pow(q[0], 4) + pow(q[1], 4)) +
           1e-3 * abs(q[0] * q[1]);
  };
  std::mt19937 draw(2);
  double worst = 0.0;
  for (int k = 0; k < 60; ++k) {
    const State<2> start = drawn(draw);
    const auto orbit = kept(solve(pushed, start, 10.0, 1e-8)), truth = solve(pushed, start, 10.0, 1e-13);
    worst = std::max(worst, (orbit.state.q - truth.state.q).norm());
  }
  EXPECT_LT(worst, 2.6e-9);  // measured 1.3e-9
}

// A branch that is never taken, whose condition changes at both axes: what is asked for on the way is there.
// A shorter step to it took rounding at the beginning for another kink; of 100 runs 41 failed.
TEST(Kinks, DoNotStopWhatIsOnTheWay) {
  const auto well = [](const auto& q) { return 0.5 * q.squaredNorm() + 0.3 * (pow(q[0], 4) + pow(q[1], 4)); };
  const auto plain = [&](const auto& q, const auto& p) { return 0.5 * p.squaredNorm() + well(q); };
  const auto branched = [&](const auto& q, const auto& p) {
    return 0.5 * p.squaredNorm() + well(q) + select(abs(q[0] * q[1]) > 100.0, q[0], 0.0 * q[0]);
  };
  const auto axis = [](const auto& q, const auto&) { return q[0]; };
  std::vector<double> times;
  for (int i = 1; i <= 100; ++i)
    times.push_back(0.1 * i);
  std::mt19937 draw(3);
  for (int k = 0; k < 10; ++k) {
    const State<2> start = drawn(draw);
    const avi::SolveOptions options{.dense = true, .events = {avi::when(axis)}};
    const auto orbit = solve(branched, start, times, 1e-9, options),
               truth = solve(plain, start, times, 1e-12, options);
    ASSERT_TRUE(orbit.ok()) << orbit.report();
    ASSERT_EQ(orbit.events.size(), truth.events.size());
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_LT((orbit.states[i].q - truth.states[i].q).norm(), 5.4e-11);  // measured 2.7e-11
    for (double t = 0.04; t < 10.0; t += 0.3)
      EXPECT_LT((orbit(t).q - truth(t).q).norm(), 5.4e-11);
  }
}

// Two terms of a difference change places at a line, as rows do in a determinant with pivots: its sign jumps
// there, and its absolute value is smooth. Steps looked for a zero at the jump, and a call took up
// to 6992 sweeps.
TEST(Kinks, AreNotWhereAFunctionJumps) {
  const auto smooth = [](const auto& q, const auto& p) {
    return 0.5 * p.squaredNorm() * (1.0 + 0.1 * q.squaredNorm()) + 0.5 * q.squaredNorm();
  };
  const auto jumps = [](const auto& q, const auto& p) {
    const auto size = 1.0 + 0.1 * q.squaredNorm();
    const auto turned = select(abs(q[0]) < abs(q[1]), size, -size);
    return 0.5 * p.squaredNorm() * abs(turned) + 0.5 * q.squaredNorm();
  };
  std::mt19937 draw(5);
  for (int k = 0; k < 20; ++k) {
    const State<2> start = drawn(draw);
    const auto orbit = kept(solve(jumps, start, 10.0, 1e-8)), truth = solve(smooth, start, 10.0, 1e-12);
    EXPECT_LT((orbit.state.q - truth.state.q).norm(), 6.6e-10);    // measured 3.3e-10
    EXPECT_LT(orbit.run.evaluations + orbit.choice.sweeps, 2000);  // measured at most 1003
  }
}

// A root, a logarithm or a non-integer power of what has a kink, but does not vanish there, hid the kink: the
// call was refused, or wrong by 73 tolerances.
TEST(Kinks, AreFoundUnderRoots) {
  const State<1> start{.q = {1.0}, .p = {0.0}};
  const auto root = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + sqrt(1.0 + abs(q[0])); };
  const auto halves = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + select(q[0] > 0.0, pow(1.0 + q[0], 1.3), pow(1.0 - q[0], 1.3));
  };
  const auto power = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + pow(1.0 + abs(q[0]), 1.3);
  };
  // A quarter of a period is the integral of dq / sqrt(2 (V(1) - V(q))) from 0 to 1.
  const double s = std::sqrt(std::sqrt(2.0) - 1.0), quarter = 4.0 * s - std::sqrt(8.0) / 3.0 * s * s * s;
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    const auto orbit = kept(solve(root, start, 36.0 * quarter, tolerance));
    EXPECT_NEAR(orbit.state.q[0], 1.0, 0.012 * tolerance);  // measured 0.0059 tolerances
    EXPECT_NEAR(orbit.state.p[0], 0.0, 0.17 * tolerance);   // measured 0.083
    const auto one = kept(solve(power, start, 50.0, tolerance)), other = solve(halves, start, 50.0, 1e-12);
    EXPECT_NEAR(one.state.q[0], other.state.q[0], 1.5e-4 * tolerance);  // measured 7.3e-5 tolerances
  }
}

// Grains in a box, all pairs of which may touch: 325 conditions. More than 200 were not looked for, and the
// call was refused.
TEST(Kinks, MayBeMany) {
  constexpr int grains = 26, n = 2 * grains;
  const double side = 1.1 * std::sqrt(grains);
  const auto box = [&](const auto& q, const auto& p) {
    using std::max;
    auto h = 0.5 * p.squaredNorm();
    const auto push = [&](const auto& depth) { h += 50.0 * pow(max(depth, 0.0), 2); };
    for (int i = 0; i < grains; ++i)
      for (int k = 0; k < i; ++k)
        push(1.0 - (q.segment(2 * i, 2) - q.segment(2 * k, 2)).norm());
    for (int i = 0; i < n; ++i)
      push(q[i] - side), push(-q[i]);
    return h;
  };
  State<avi::dynamic> start;
  start.q.resize(n), start.p.resize(n);
  std::mt19937 draw(3);
  std::normal_distribution<double> some(0.0, 0.5);
  const int rows = static_cast<int>(std::ceil(std::sqrt(grains)));
  for (int i = 0; i < n; ++i) {
    start.q[i] = ((i % 2 == 0 ? i / 2 % rows : i / 2 / rows) + 0.5) * side / rows;
    start.p[i] = some(draw);
  }
  const auto orbit = kept(solve(box, start, 4.0, 1e-5)), truth = solve(box, start, 4.0, 1e-10);
  EXPECT_LT((orbit.state.q - truth.state.q).norm(), 7.4e-10);  // measured 3.7e-10
}

}  // namespace kinks_test
