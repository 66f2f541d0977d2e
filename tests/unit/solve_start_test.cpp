#include "avi/solve.hpp"
#include "avi/solver.hpp"
#include "kept.hpp"
#include "refusal.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace solve_start_test {

using avi::solve, avi::State, systems::at, systems::kepler;

TEST(SolveStart, NamesWhatWasForgotten) {
  const std::string forgotten = " is nan; it must be finite, and what is not given is nan.";
  const auto said = [](const State<2>& start, double end = 6.0) {
    return refusal([&] { (void)solve(kepler, start, end, 1e-8); });
  };
  EXPECT_EQ(said({.q = {0.1, 0.0}}), "At the start p[0]" + forgotten);
  EXPECT_EQ(said({.q = {0.1, 0.0}}, 0.0), "At the start p[0]" + forgotten);
  EXPECT_EQ(said({.p = {0.1, 0.0}}), "At the start q[0]" + forgotten);
  EXPECT_EQ(said({.q = {1.0, 0.0}, .p = {0.0, HUGE_VAL}}), "At the start p[1] is inf; it must be finite.");
  const auto in_time = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] + q[0] * sin(t);
  };
  EXPECT_EQ(refusal([&] { (void)solve(in_time, State<1>{.q = {0.1}}, 6.0, 1e-8); }),
            "At the start p[0]" + forgotten);
  const avi::Solver solver(kepler, State<2>{.q = {1.0, 0.0}, .p = {0.0, 1.0}}, 6.0, 1e-8, {.check = false});
  EXPECT_EQ(refusal([&] { (void)solver.run({.q = {1.0, 0.0}}, 6.0); }), "At the start p[0]" + forgotten);
}

// Of 80 such runs 8 were kept and wrong at the end, by up to 43 tolerances on the way; others took 27 times
// the steps.
TEST(SolveStart, MayBeZeroInEveryEntry) {
  const auto pulled = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - cos(q[0] + 0.3); };
  const State<1> rest = at(0.0, 0.0);
  const State<1> moved = at(1e-3, 0.0);
  for (const double tolerance : {1e-4, 1e-8, 1e-11}) {
    const auto found = kept(solve(pulled, rest, 20.0, tolerance));
    EXPECT_LE(found.run.steps, 2 * solve(pulled, moved, 20.0, tolerance).run.steps);
  }
  // A push in passing, by which a body at rest is given the speed pi w.
  const auto pulse = [](const auto& q, const auto& t, const auto& p) {
    const auto x = (t - 10.0) * (1.0 / 0.3);
    return 0.5 * p[0] * p[0] - q[0] / (1.0 + x * x);
  };
  for (const double tolerance : {1e-4, 1e-8, 1e-11}) {
    const auto found = kept(solve(pulse, rest, 30.0, tolerance));
    const double to = std::atan(20.0 / 0.3), from = std::atan(-10.0 / 0.3);
    EXPECT_NEAR(found.state.p[0], 0.3 * (to - from), 5.0 * tolerance);
  }
}

// What a turning body moves creeps from half turn to half turn, which was taken for a saddle.
TEST(SolveStart, MayBeFast) {
  for (double p = 20.0; p <= 60.0; p += 0.5) {
    const auto found = solve(systems::pendulum, at(0.3, p), 100.0, 1e-8);
    EXPECT_TRUE(found.kept()) << p << ": " << found.report();
  }
}

TEST(SolveStart, SaysWhereTheEnergyIsNotFinite) {
  const State<2> centre{.q = {0.0, 0.0}, .p = {1.0, 0.5}};
  const std::string sentence =
      "H is -inf at the start, where q = (0, 0), p = (1, 0.5); an orbit needs an energy that is finite.";
  EXPECT_EQ(refusal([&] { (void)solve(kepler, centre, 6.0, 1e-8); }), sentence);
  EXPECT_EQ(refusal([&] { (void)solve(kepler, centre, 0.0, 1e-8); }), sentence);
  const avi::Solver solver(kepler, State<2>{.q = {1.0, 0.0}, .p = {0.0, 1.0}}, 6.0, 1e-8, {.check = false});
  EXPECT_EQ(refusal([&] { (void)solver.run(centre, 6.0); }), sentence);
  const auto in_time = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] + q[0] / (t - 1.0);
  };
  EXPECT_EQ(refusal([&] { (void)solve(in_time, at(2.0, 0.0, 1.0), 6.0, 1e-8); }),
            "H is inf at the start, where q = (2), p = (0), t = 1; an orbit needs an energy that is finite.");
  // The force is infinite, not the energy.
  const auto root = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + sqrt(q[0]); };
  EXPECT_EQ(refusal([&] { (void)solve(root, at(0.0, 1.0), 6.0, 1e-8); }),
            "The derivative of H by q[0] at the start is inf; it must be finite.");
  const auto begins = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] + q[0] * sqrt(t);
  };
  EXPECT_EQ(refusal([&] { (void)solve(begins, at(2.0, 0.0), 6.0, 1e-8); }),
            "The derivative of H by t at the start is inf; it must be finite.");
}

TEST(SolveStart, NeedsNoMomentumInH) {
  const auto still = [](const auto& q, const auto&) { return 0.5 * q[0] * q[0]; };
  const auto orbit = solve(still, at(1.0, 1.0), 6.0, 1e-8);
  EXPECT_TRUE(orbit.kept());
  EXPECT_EQ(orbit.state.q[0], 1.0);
  EXPECT_NEAR(orbit.state.p[0], -5.0, 1e-14);
}

// H is 0 along the orbit, and nothing of it is known but q: that of an equation q' = f(q).
TEST(SolveStart, MayBeTheLiftOfAnEquation) {
  for (const double tolerance : {1e-3, 1e-10}) {
    const auto decay = kept(avi::solve([](const auto& q, const auto& p) { return -1.0 * p[0] * q[0]; },
                                       at(1.0, 0.0), 1.0, tolerance));
    EXPECT_NEAR(decay.state.q[0], std::exp(-1.0), 0.6 * tolerance);  // the range is 0.63
    EXPECT_EQ(decay.state.p[0], 0.0);
  }
}

// From rest, by a power of time: relative to its range the first step is as wrong as any shorter one.
TEST(SolveStart, MayBeAtRestWhereNothingActsYet) {
  const State<1> rest = at(0.0, 0.0);
  const auto pulled = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] - q[0] * t * t;
  };
  const auto first = kept(solve(pulled, rest, 5.0, 1e-8));
  EXPECT_NEAR(first.state.q[0], 5.0 * 5.0 * 5.0 * 5.0 / 12.0, 1e-6);
  const auto pushed = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * (p[0] * p[0] + q[0] * q[0]) - q[0] * sin(t) * sin(t);
  };
  const auto second = kept(solve(pushed, rest, 50.0, 1e-8));
  EXPECT_NEAR(second.state.q[0], (3.0 - 4.0 * std::cos(50.0) + std::cos(100.0)) / 6.0, 1e-8);
  // A coordinate that moves by the square of another one.
  const auto valley = [](const auto& q, const auto& p) {
    const auto d = q[1] - q[0] * q[0];
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + d * d);
  };
  const State<2> bottom{.q = {0.0, 0.0}, .p = {1.0, 0.0}};
  const auto third = solve(valley, bottom, 10.0, 1e-8), exact = solve(valley, bottom, 10.0, 1e-12);
  EXPECT_TRUE(third.kept() && exact.kept()) << third.report();
  EXPECT_NEAR((third.state.q - exact.state.q).norm(), 0.0, 1e-6);
}

// It was said that two runs tell how much the state errs, and that a method was chosen.
TEST(SolveStart, MayBeTheEnd) {
  const State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}};
  const auto still = solve(kepler, start, 0.0, 1e-8);
  EXPECT_TRUE(still.kept());
  EXPECT_EQ(still.state, start);
  EXPECT_EQ(still.run.steps, 0);
  EXPECT_EQ(still.run.evaluations + still.choice.sweeps + still.choice.check, 0);
  EXPECT_EQ(still.report(), "Kept: the end is the start, and no step was made.\n");
}

// Nothing moves for a while, or by 1e-150 at first. A pulse gives the oscillator what its Fourier transform
// has at frequency 1; with a power of time the motion is a polynomial beside sine and cosine.
TEST(SolveStart, AtRestMayBeWhatOnlyTimeSetsInMotion) {
  const State<1> rest = at(0.0, 0.0);
  for (const double width : {0.2, 0.5, 1.0}) {
    const auto pulse = [&](const auto& q, const auto& t, const auto& p) {
      const auto x = (t - 10.0) / width;
      return 0.5 * (p[0] * p[0] + q[0] * q[0]) - 5.0 * q[0] * exp(-x * x);
    };
    const auto orbit = kept(avi::solve(pulse, rest, 20.0, 1e-8));
    const double size = 5.0 * width * std::sqrt(M_PI) * std::exp(-0.25 * width * width);
    EXPECT_LT(orbit.run.steps, 200);  // measured 38 to 102; 16 526 where the beginning sets the step
    EXPECT_NEAR(orbit.state.q[0], size * std::sin(10.0), 2e-12);  // measured at most 1e-12
    EXPECT_NEAR(orbit.state.p[0], size * std::cos(10.0), 2e-12);
  }
  const auto power = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * (p[0] * p[0] + q[0] * q[0]) - q[0] * pow(0.1 * t, 12.0);
  };
  const auto orbit = kept(avi::solve(power, rest, 20.0, 1e-8));
  // derivatives of even order with changing signs, and what makes q vanish at 0
  double q = 0.0, p = 0.0, factor = std::pow(0.1, 12);
  for (int n = 12, sign = 1; n >= 0; n -= 2, sign = -sign) {
    q += sign * factor * std::pow(20.0, n);
    if (n > 0) p += sign * factor * n * std::pow(20.0, n - 1);
    if (n == 0) q -= sign * factor * std::cos(20.0), p += sign * factor * std::sin(20.0);
    factor *= n * (n - 1.0);
  }
  EXPECT_LT(orbit.run.steps, 100);  // measured 50
  EXPECT_NEAR(orbit.state.q[0] / q, 1.0, 1e-15);
  EXPECT_NEAR(orbit.state.p[0] / p, 1.0, 1e-15);
}

// At the kink itself the slope of H is the mean of both sides, and the sketch began with that of neither:
// 1205 steps.
TEST(SolveStart, MayLieOnAKink) {
  const auto roof = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + abs(q[0]); };
  const auto slope = [](const auto& q, const auto& p) {
    using std::max;
    return 0.5 * p[0] * p[0] + max(q[0], -q[0]);
  };
  for (const double end : {7.3, -7.3}) {
    const avi::State<1> start{.q = 0.0, .p = 1.0};
    for (const auto& orbit : {avi::solve(roof, start, end, 1e-8), avi::solve(slope, start, end, 1e-8)}) {
      EXPECT_TRUE(orbit.kept()) << orbit.report();
      EXPECT_LT(orbit.run.steps, 36);  // measured 18
      // 3.3 after a whole period of 4, to the other side.
      EXPECT_NEAR(orbit.state.q[0], std::copysign(1.3 - 0.5 * 1.3 * 1.3, -end), 4e-16);  // measured 1.7e-16
    }
  }
}

}  // namespace solve_start_test
