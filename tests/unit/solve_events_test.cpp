#include "avi/problems/kepler.hpp"
#include "avi/solve.hpp"
#include "avi/solver.hpp"
#include "kept.hpp"
#include "refusal.hpp"
#include "systems.hpp"
#include "unit/cayley.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace solve_events_test {

using avi::Kepler, avi::solve, avi::when, systems::at, systems::spring;

constexpr double rounding = std::numeric_limits<double>::epsilon();
constexpr auto position = [](const auto& q, const auto&) { return q[0]; };
constexpr auto fall = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - 1.0 / q[0]; };
constexpr auto radial = [](const auto& q, const auto& p) { return q[0] * p[0] + q[1] * p[1]; };

// Measured: 28 units, at times up to 100, whose own rounding is 32.
TEST(SolveEvents, AreThoseOfARunByHandInMoreDigits) {
  const double h = 0.1;
  const auto orbit = solve(spring, at(1.0, 0.0), 100.0, 1e-13,
                           {.order = 4, .monitor = "fixed", .h = h, .events = {when(position)}});
  ASSERT_EQ(orbit.events.size(), 32u);
  double t = M_PI / 2.0;
  for (const auto& event : orbit.events) {
    long double root = event.state.t;
    for (int i = 0; i < 4; ++i) {  // Newton's method
      const auto z = by_hand({1.0L, 0.0L}, h, root);
      root -= z.real() / z.imag();
    }
    EXPECT_NEAR(event.state.t, t, 1e-3);
    EXPECT_LE(std::abs(static_cast<double>(event.state.t - root)), 100.0 * rounding);
    EXPECT_LE(std::abs(event.state.q[0]), 2.0 * rounding);
    t += M_PI;
  }
}

TEST(SolveEvents, KnowDirectionAndCount) {
  const auto orbit =
      solve(spring, at(1.0, 0.0), 100.0, 1e-8,
            {.events = {when(position, {.direction = 1}), when(position, {.direction = -1, .count = 3})}});
  int rising = 0, falling = 0;
  double last = 0.0;
  for (const auto& event : orbit.events) {
    EXPECT_GT(event.state.t, last);
    last = event.state.t;
    EXPECT_GT(event.index == 0 ? event.state.p[0] : -event.state.p[0], 0.5);
    ++(event.index == 0 ? rising : falling);
  }
  EXPECT_EQ(rising, 16);
  EXPECT_EQ(falling, 3);
}

// As the run goes: what rises in time falls in a run that goes back.
TEST(SolveEvents, HaveTheDirectionOfTheRun) {
  const auto orbit =
      solve(spring, at(1.0, 0.0), -10.0, 1e-8, {.events = {when(position, {.direction = -1})}});
  ASSERT_EQ(orbit.events.size(), 2u);
  EXPECT_NEAR(orbit.events[0].state.t, -M_PI / 2.0, 1e-8);
  EXPECT_NEAR(orbit.events[1].state.t, -2.5 * M_PI, 1e-8);
}

TEST(SolveEvents, MayDependOnTime) {
  const auto clock = [](const auto&, const auto& t, const auto&) { return t - 3.25; };
  const auto orbit = solve(spring, at(1.0, 0.0), 10.0, 1e-8, {.events = {when(clock)}});
  ASSERT_EQ(orbit.events.size(), 1u);
  EXPECT_NEAR(orbit.events[0].state.t, 3.25, 4.0 * rounding);
}

// The clock has few numbers in a step, and none but the two beside the zero in a hundred-thousandth of it.
TEST(SolveEvents, MayDependOnATimeThatIsFarFromZero) {
  for (int k = 0; k < 40; ++k) {
    const double begin = 1.7e9 * (1.0 + 0.05 * k), w = 20.0 + k;
    const auto fast = [=](const auto&, const auto& t, const auto&) { return sin(w * (t - begin) - 1.0); };
    avi::State<1> start = at(1.0, 0.0);
    start.t = begin;
    const auto orbit = solve(spring, start, begin + 0.2, 1e-4, {.events = {when(fast)}});
    ASSERT_TRUE(orbit.ok()) << k << ' ' << orbit.run.message;
    ASSERT_EQ(orbit.events.size(), static_cast<std::size_t>((0.2 * w - 1.0) / M_PI) + 1) << k;
    EXPECT_NEAR(orbit.events[0].state.t - begin, 1.0 / w, 4.0 * rounding * begin) << k;
  }
}

TEST(SolveEvents, AreSeenTwoInAStep) {
  // A circle that is left and entered again within a hundredth of a step, and one that is nearly touched.
  const auto high = [](const auto& q, const auto&) { return q[0] - std::cos(0.01); };
  const auto above = [](const auto& q, const auto&) { return q[0] - std::cos(0.01) - 1e-4; };
  const auto orbit = solve(spring, at(0.0, 1.0), 6.0, 1e-8, {.events = {when(high), when(above)}});
  ASSERT_EQ(orbit.events.size(), 2u);
  EXPECT_NEAR(orbit.events[0].state.t, M_PI / 2.0 - 0.01, 1e-6);
  EXPECT_NEAR(orbit.events[1].state.t, M_PI / 2.0 + 0.01, 1e-6);
}

TEST(SolveEvents, StopARunAndCostWhatItTakesToTheEvent) {
  const auto z = Kepler::pericentre(0.9);
  const double period = 2.0 * M_PI;
  for (const double end : {20.0, 1e5, 1e12}) {
    const auto orbit = kept(solve(Kepler(), z, end, 1e-10,
                                  {.events = {when(radial, {.direction = -1, .count = 3, .stop = true})}}));
    EXPECT_NEAR(orbit.state.t, 2.5 * period, 1e-8);
    EXPECT_NEAR(orbit.state.q[0], -1.9, 1e-9);
    EXPECT_EQ(orbit.events.size(), 3u);
    EXPECT_EQ(orbit.note, "Event 0 ended the run at t = 15.708.");
    EXPECT_LT(orbit.run.evaluations + orbit.choice.sweeps, 20 * 300);
  }
}

// Far behind what the first, rough run suggests, or where that finds nothing.
TEST(SolveEvents, AreFoundThoughTheFirstRunMissesThem) {
  const auto clock = [](const auto&, const auto& t, const auto&) { return t - 20000.25; };
  const auto z = Kepler::pericentre(0.6);
  const auto orbit = solve(Kepler(), z, 1e9, 1e-8, {.events = {when(clock, {.stop = true})}});
  EXPECT_TRUE(orbit.ok());
  EXPECT_NEAR(orbit.state.t, 20000.25, 1e-10);
  const auto never =
      solve(spring, at(1.0, 0.0), 50.0, 1e-8,
            {.events = {when([](const auto& q, const auto&) { return q[0] - 2.0; }, {.stop = true})}});
  EXPECT_TRUE(never.kept());
  EXPECT_EQ(never.state.t, 50.0);
  EXPECT_TRUE(never.events.empty());
}

TEST(SolveEvents, DoNotBeginARun) {
  avi::SolveOptions options{.events = {when(position, {.stop = true})}};
  auto z = at(1.0, 0.0);
  for (int k = 0; k < 20; ++k) {
    const auto orbit = solve(spring, z, z.t + 10.0, 1e-10, options);
    ASSERT_EQ(orbit.events.size(), 1u) << k;
    EXPECT_NEAR(orbit.state.t - z.t, k == 0 ? M_PI / 2.0 : M_PI, 1e-8) << k;
    z = orbit.state;
  }
}

// From one zero to another within a fiftieth of the first step, whole or cut short by the end.
TEST(SolveEvents, AreSeenSoonAfterAZeroThatARunBeginsOn) {
  const auto twice = [](const auto& q, const auto&) { return q[0] * (q[0] - 0.002); };
  for (const double h : {0.1, 1.0}) {
    const auto orbit = solve(spring, at(0.0, 1.0), 0.1, 1e-8,
                             {.order = 8, .monitor = "fixed", .h = h, .events = {when(twice)}});
    ASSERT_EQ(orbit.events.size(), 1u) << h;
    EXPECT_NEAR(orbit.events[0].state.t, std::asin(0.002), 1e-8) << h;
    EXPECT_LE(orbit.run.evaluations, 45) << h;  // 27 and 31; 61 where the first look is at other places
  }
}

// Over whole periods zeros lie on the points at which a step is looked at, where its polynomial and its
// states may have different signs.
TEST(SolveEvents, AreSeenOnThePointsThatAreLookedAt) {
  for (const double tolerance : {1e-2, 1e-4, 3e-5, 1e-6, 3e-7, 1e-8, 1e-9})
    for (int half_turns = 1; half_turns <= 6; ++half_turns)
      for (const int order : {0, 8}) {
        const double end = half_turns * M_PI;
        const auto found =
            solve(spring, at(1.0, 0.0), end, tolerance, {.order = order, .events = {when(position)}});
        EXPECT_EQ(static_cast<int>(found.events.size()), half_turns) << tolerance << " " << found.report();
        const auto from_zero =
            solve(spring, at(0.0, 1.0), end - 1.0, tolerance, {.order = order, .events = {when(position)}});
        EXPECT_EQ(static_cast<int>(from_zero.events.size()), half_turns - 1) << tolerance;
      }
}

// A run lands on its end by a straight line from a state that is a little off.
TEST(SolveEvents, MayLieOnTheEnd) {
  for (const double tolerance : {1e-4, 1e-6, 1e-9, 1e-11})
    for (int half_turns = 1; half_turns <= 2; ++half_turns)
      for (const double e : {0.1, 0.5, 0.9}) {
        const auto found = kept(solve(Kepler(), Kepler::pericentre(e), half_turns * M_PI, tolerance,
                                      {.events = {when([](const auto& q, const auto&) { return q[1]; })}}));
        EXPECT_GE(static_cast<int>(found.events.size()), half_turns - 1);
        for (std::size_t i = 0; i < found.events.size(); ++i) {
          EXPECT_NEAR(found.events[i].state.t, (static_cast<double>(i) + 1.0) * M_PI, 1e2 * tolerance);
          EXPECT_NEAR(found.events[i].state.q[1], 0.0, 1e-14);
        }
      }
}

// Steps follow the motion, not g; also where 8 points of a step see a fast g as a slow one.
/// Times of the events of a body that moves freely for T: zeros of the product of t - root.
std::vector<double> found_of(const std::vector<double>& roots, double T, int direction = 0) {
  const auto g = [&](const auto&, const auto& t, const auto&) {
    auto product = t - roots[0];
    for (std::size_t i = 1; i < roots.size(); ++i)
      product = product * (t - roots[i]);
    return product;
  };
  const auto free = [](const auto&, const auto& p) { return 0.5 * p[0] * p[0]; };
  const auto run = solve(free, at(0.0, 1.0), T, 1e-8, {.events = {when(g, {.direction = direction})}});
  EXPECT_TRUE(run.kept());
  std::vector<double> times;
  for (const auto& event : run.events)
    times.push_back(event.state.t);
  return times;
}

// A sample that is zero by chance, at the end of a step or of the run, has no sign.
TEST(SolveEvents, AreSeenBesideOneOnTheEndOfAStep) {
  const auto expect = [](const std::vector<double>& found, const std::vector<double>& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], wanted[i], 1e-12);
  };
  for (const double root : {3.0, 4.0, 5.0, 6.0, 7.0, 10.0})
    for (const double other : {root - 0.2, root + 0.2})
      expect(found_of({root, other}, 15.0), {std::min(root, other), std::max(root, other)});
  expect(found_of({0.999, 1.0}, 1.0, 1), {1.0});
  expect(found_of({0.999, 1.0}, 1.0, -1), {0.999});
  // Three of its four lie in two neighbouring pieces.
  expect(found_of({0.02477, 0.04543, 0.0662, 0.13989}, 1.0), {0.02477, 0.04543, 0.0662, 0.13989});
}

// g is no number beyond the event that ends the run, in the same step.
TEST(SolveEvents, ComeBeforeTheFunctionIsNoNumber) {
  const auto ball = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + 9.81 * q[0]; };
  const auto root = when([](const auto& q) { return sqrt(q[0]) - 0.5; }, {.stop = true});
  const auto run = kept(solve(ball, at(10.0, 0.0), 3.0, 1e-8, {.events = {root}}));
  EXPECT_NEAR(run.state.t, std::sqrt(2.0 * 9.75 / 9.81), 1e-12);
  const auto below = when([](const auto& q) { return sqrt(q[0]) + 0.5; }, {.stop = true});
  const auto none = solve(ball, at(10.0, 0.0), 3.0, 1e-8, {.events = {below}});
  EXPECT_EQ(none.run.outcome, avi::Outcome::non_finite);
  EXPECT_NE(none.run.message.find("g of the event is nan at t = 1.427"), std::string::npos) << none.report();
}

TEST(SolveEvents, MayBeFasterThanTheMotion) {
  for (const double w : {1.0, 5.0, 20.0, 33.1, 50.0, 100.0}) {
    const auto fast = [=](const auto&, const auto& t, const auto&) { return sin(w * t); };
    const auto found = solve(spring, at(1.0, 0.0), 20.3, 1e-8, {.events = {when(fast)}});
    ASSERT_EQ(found.events.size(), static_cast<std::size_t>(20.3 * w / M_PI)) << w;
    for (std::size_t i = 0; i < found.events.size(); ++i)
      ASSERT_NEAR(found.events[i].state.t, static_cast<double>(i + 1) * M_PI / w, 1e-9);
  }
  const auto faster = [](const auto&, const auto& t, const auto&) { return sin(1e4 * t); };
  EXPECT_EQ(solve(spring, at(1.0, 0.0), 20.3, 1e-8, {.events = {when(faster)}}).run.outcome,
            avi::Outcome::not_converged);
  const auto hundredth = [](const auto&, const auto& t, const auto&) { return sin(40.0 * t + 0.3); };
  const auto stopped =
      solve(spring, at(1.0, 0.0), 1000.0, 1e-8, {.events = {when(hundredth, {.count = 100, .stop = true})}});
  EXPECT_NEAR(stopped.state.t, (100.0 * M_PI - 0.3) / 40.0, 1e-9);
}

// A grid that is some periods of g wide has a slow curve through it. Before, a third of these zeros was lost.
TEST(SolveEvents, AreSeenWhereAGridMakesThemLookSlow) {
  for (const double w : {1500.0, 2000.0, 2500.0}) {
    const auto fast = [=](const auto&, const auto& t, const auto&) { return sin(w * t); };
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      const auto found = solve(Kepler(), Kepler::pericentre(0.5), 2.0, tolerance, {.events = {when(fast)}});
      if (found.ok()) {
        EXPECT_EQ(found.events.size(), static_cast<std::size_t>(2.0 * w / M_PI)) << w << ' ' << tolerance;
      }
    }
  }
  for (int k = 0; k < 100; ++k) {  // some hundred periods in a step are more than can be told apart
    const double w = 4000.0 * (1.0 + 0.0371 * k);
    const auto faster = [=](const auto&, const auto& t, const auto&) { return sin(w * t); };
    const auto lost = solve(spring, at(1.0, 0.0), 3.0, 1e-8, {.events = {when(faster)}});
    EXPECT_EQ(lost.run.outcome, avi::Outcome::not_converged) << w;
  }
}

// Two zeros close to the top of g, wherever the points of a step lie.
TEST(SolveEvents, AreSeenInGrazingPairs) {
  for (const auto& [below, tolerance] : {std::pair{1e-3, 1e-4}, {3e-5, 1e-6}, {1e-6, 1e-10}}) {
    const auto near_top = [below = below](const auto& q, const auto&) { return q[0] - (1.0 - below); };
    const auto found = solve(spring, at(-1.0, 0.0), 400.0 * M_PI, tolerance, {.events = {when(near_top)}});
    EXPECT_EQ(found.events.size(), 400u) << below;
  }
}

// Two or more zeros between two of the points at which a step is looked at, also where g bends both ways.
TEST(SolveEvents, AreSeenCloseToOneAnother) {
  for (int k = 0; k < 50; ++k) {
    const double c = 50.0 + 0.1247 * k;
    const auto cubic = [=](const auto&, const auto& t, const auto&) {
      return (t - c) * (t - c - 0.09) * (t - c - 0.22);
    };
    const auto quartic = [=](const auto&, const auto& t, const auto&) {
      return (t - c) * (t - c - 0.09) * (t - c - 0.3) * (t - c - 1.5);
    };
    const auto corner = [=](const auto&, const auto& t, const auto&) { return abs(t - c) - 0.01; };
    const auto found = solve(spring, at(0.0, 1.0), 100.0, 1e-8,
                             {.check = false, .events = {when(cubic), when(quartic), when(corner)}});
    EXPECT_EQ(found.events.size(), 9u) << c;
    for (const auto& event : found.events) {
      const double late = event.state.t - c;
      EXPECT_LE(std::min({std::abs(late), std::abs(late - 0.09), std::abs(late - 0.22), std::abs(late - 0.3),
                          std::abs(late - 1.5), std::abs(std::abs(late) - 0.01)}),
                1e-10)
          << c;
    }
  }
}

// Inside a step its polynomial has half of the digits: near zero steps of the method say what is there.
TEST(SolveEvents, AreSeenInPairsCloserThanThePolynomialIsRight) {
  for (const double below : {1e-8, 1e-10}) {
    const auto near_top = [=](const auto& q, const auto&) { return q[0] - (1.0 - below); };
    const auto found = solve(spring, at(0.0, 1.0), 200.0, 1e-10, {.events = {when(near_top)}});
    EXPECT_EQ(found.events.size(), 64u) << below;
  }
  for (const double apart : {1e-3, 1e-4, 1e-5}) {
    const double a = std::sin(0.7), b = std::cos(0.7 + apart);
    const auto both = [=](const auto& q, const auto& p) { return (q[0] - a) * (p[0] - b); };
    const auto found = solve(spring, at(0.0, 1.0), 628.0, 1e-10, {.events = {when(both)}});
    EXPECT_EQ(found.events.size(), 400u) << apart;
  }
}

TEST(SolveEvents, EndAsInTheLoopWhereThereIsNoZero) {
  const auto pole = [](const auto& q, const auto&) { return 1.0 / (q[0] - 0.3); };
  const auto at_pole = solve(spring, at(1.0, 0.0), 10.0, 1e-8, {.events = {when(pole)}});
  EXPECT_EQ(at_pole.run.outcome, avi::Outcome::not_converged);
  EXPECT_NE(at_pole.run.message.find("pole"), std::string::npos) << at_pole.run.message;
  const auto root = [](const auto& q, const auto&) { return sqrt(q[0]) - 2.0; };
  const auto at_nan = solve(spring, at(1.0, 0.0), 10.0, 1e-8, {.events = {when(root)}});
  EXPECT_EQ(at_nan.run.outcome, avi::Outcome::non_finite);
  EXPECT_LT(at_nan.state.t, 2.0);
  EXPECT_FALSE(at_nan.kept());
  const auto nowhere = [](const auto& q, const auto&) { return sqrt(q[0] - 2.0); };
  for (const bool stop : {false, true}) {
    const auto orbit = solve(spring, at(1.0, 0.0), 10.0, 1e-8, {.events = {when(nowhere, {.stop = stop})}});
    EXPECT_EQ(orbit.run.outcome, avi::Outcome::non_finite) << orbit.report();
  }
}

// A pole or a jump later in the same step ended the run at the beginning of that step, with no event.
TEST(SolveEvents, ComeBeforeAJumpInTheSameStep) {
  const auto clock = [](const auto&, const auto& t, const auto&) { return t - 0.3; };
  const auto tangent = [](const auto&, const auto& t, const auto&) { return tan(2.0 * (t - 0.3)); };
  const auto jump = [](const auto& q, const auto&) {
    return select(q[0] > 0.5, 1.0 + 0.0 * q[0], -1.0 + 0.0 * q[0]);
  };
  for (const auto& events : {std::vector{when(tangent, {.count = 1, .stop = true})},
                             std::vector{when(jump), when(clock, {.stop = true})}}) {
    const auto orbit = solve(spring, at(1.0, 0.0), 10.0, 1e-9, {.events = events});
    EXPECT_TRUE(orbit.ok()) << orbit.report();
    ASSERT_EQ(orbit.events.size(), 1u);
    EXPECT_NEAR(orbit.state.t, 0.3, 1e-15);
  }
}

// The last step went over one ulp, and the event on the switch was found twice.
TEST(SolveEvents, AreFoundOnceOnASwitchAtTheEnd) {
  for (const double end : {0.9, 1.7, 3.0, 5.0}) {
    const auto pushed = [end](const auto& q, const auto& t, const auto& p) {
      return 0.5 * p[0] * p[0] - q[0] * select(t < end, 1.0, -1.0);
    };
    const auto clock = [end](const auto&, const auto& t, const auto&) { return t - end; };
    for (const double tolerance : {1e-3, 1e-9}) {
      const auto orbit = kept(solve(pushed, at(0.0, 0.0), end, tolerance, {.events = {when(clock)}}));
      EXPECT_EQ(orbit.events.size(), 1u) << end;
    }
  }
}

TEST(SolveEvents, ComeWithTheTimesBeforeThem) {
  const auto orbit = solve(spring, at(1.0, 0.0), std::vector<double>{0.5, 1.0, 1.5, 2.0, 2.5}, 1e-10,
                           {.events = {when(position, {.stop = true})}});
  EXPECT_EQ(orbit.states.size(), 3u);
  EXPECT_NEAR(orbit.state.t, M_PI / 2.0, 1e-9);
}

// A body that has just left a singularity: what is tried for a choice lies between the start and the event.
TEST(SolveEvents, ThatStopARunAreLookedForAheadOfIt) {
  const auto far = [](const auto& q, const auto&) { return q[0] - 1.0; };
  const auto orbit =
      solve(fall, at(0.01, std::sqrt(200.0)), 1e3, 1e-8, {.events = {when(far, {.stop = true})}});
  EXPECT_TRUE(orbit.kept());
  ASSERT_EQ(orbit.events.size(), 1u);
  EXPECT_NEAR(orbit.state.t, 0.999 * M_SQRT2 / 3.0, 1e-8);
}

// What is chosen for the time behind a singularity is of no use before it.
TEST(SolveEvents, ThatStopARunBeforeASingularityAreKept) {
  for (const double near : {0.1, 0.01}) {
    const auto close = [=](const auto& q, const auto&) { return q[0] - near; };
    const auto orbit = kept(
        solve(fall, at(1.0, 0.0), 5.0, 1e-10, {.seconds = 60.0, .events = {when(close, {.stop = true})}}));
    EXPECT_NEAR(orbit.state.t, (std::acos(std::sqrt(near)) + std::sqrt(near * (1.0 - near))) / M_SQRT2, 1e-9);
  }
}

TEST(SolveEvents, BeforeASingularityAreFoundThoughTheRunFails) {
  const auto half = [](const auto& q, const auto&) { return q[0] - 0.5; };
  const auto orbit =
      solve(systems::logarithm, at(1.0, 0.0), 2.0, 1e-10, {.seconds = 10.0, .events = {when(half)}});
  EXPECT_FALSE(orbit.ok());
  EXPECT_NE(orbit.run.outcome, avi::Outcome::time_limit);
  EXPECT_NE(orbit.run.message.find("singularity"), std::string::npos) << orbit.run.message;
  ASSERT_EQ(orbit.events.size(), 1u) << orbit.report();
  EXPECT_NEAR(orbit.events[0].state.t, std::sqrt(M_PI / 2.0) * std::erf(std::sqrt(std::log(2.0))), 1e-8);
}

// The bound is met where steps that grow ever shorter are gone on with.
TEST(SolveEvents, BeforeABlowUpAreFoundAndTheRunEnds) {
  const auto one = [](const auto& q, const auto&) { return q[0] - 1.0; };
  const auto orbit = solve(systems::blow_up, at(0.0, 1.0), 1.6, 1e-10,
                           {.sweeps = 100'000'000, .dense = true, .events = {when(one)}});
  EXPECT_FALSE(orbit.ok());
  EXPECT_NE(orbit.run.message.find("singularity"), std::string::npos) << orbit.run.message;
  ASSERT_EQ(orbit.events.size(), 1u) << orbit.report();
  EXPECT_NEAR(orbit.events[0].state.t, M_PI / 4.0, 1e-9);
  EXPECT_NEAR(orbit(1.5).q[0] / std::tan(1.5), 1.0, 1e-8);
}

// No run is known then that has come further, and steps in an even time of their own have no end.
TEST(SolveEvents, BeforeABlowUpAreFoundByASolverToo) {
  const auto one = [](const auto& q, const auto&) { return q[0] - 1.0; };
  const avi::Solver solver(
      systems::blow_up, at(0.0, 1.0), 1.5, 1e-8,
      avi::SolveOptions{.check = false, .sweeps = 3'000'000, .monitor = "energy", .events = {when(one)}});
  const auto orbit = solver.run(at(0.0, 1.1), 2.0);
  EXPECT_FALSE(orbit.ok());
  EXPECT_NE(orbit.run.message.find("singularity"), std::string::npos) << orbit.run.message;
  ASSERT_EQ(orbit.events.size(), 1u);
  EXPECT_NEAR(orbit.events[0].state.t, M_PI / 4.0, 1e-7);
}

TEST(SolveEvents, AreNoneWhereTheFunctionIsZeroAllTheWay) {
  const auto springs = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]);
  };
  const auto still = [](const auto& q, const auto&) { return q[1]; };
  const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 0.0}};
  const auto orbit = kept(solve(springs, start, 10.0, 1e-8, {.events = {avi::when(still)}}));
  EXPECT_TRUE(orbit.events.empty());
}

TEST(SolveEvents, RefuseWhatIsNone) {
  const auto said = [](const avi::SolveEvent& event) {
    return refusal([&] { (void)solve(spring, at(1.0, 0.0), 1.0, 1e-6, {.events = {event}}); });
  };
  EXPECT_EQ(said({}), "An event has no function g; avi::when(g) makes one.");
  EXPECT_EQ(said(when(position, {.direction = 2})), "Direction of an event is 2; it must be -1, 0 or 1.");
  EXPECT_EQ(said(when(position, {.direction = -2})), "Direction of an event is -2; it must be -1, 0 or 1.");
  EXPECT_EQ(said(when(position, {.count = -1})), "Count of an event is -1; it must be at least 0.");
  const auto of_two = [](int) { return avi::Formula::of_phase(position, 2); };
  EXPECT_EQ(said({of_two, {}}),
            "Number of arguments of an event is 4; it must be 2, or 3 where it depends on time.");
  EXPECT_NE(said(when(avi::Formula::of_phase(position, 3))), "accepted");
}

}  // namespace solve_events_test
