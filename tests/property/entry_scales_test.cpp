#include "avi/avi.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using avi::Outcome, avi::State, systems::at, systems::spring;

// When a step counts as solved, each entry in its own scale.

namespace entry_scales_test {

TEST(EntryScales, AStepIsSolvedWhereAStagePassesZero) {
  // The momentum of the middle stage is 0 in the first sweep: the relative change there is no measure.
  for (const int order : {2, 6, 10, 14})
    for (const double h : {0.1, 0.6, 1.0}) {
      const State<1> start = at(1.0, 0.5 * h);
      State<1> z = start;
      auto method = avi::collocation(avi::poincare(spring, start), order);
      ASSERT_EQ(method.step(z, h).outcome, Outcome::ok);
      EXPECT_NEAR(spring(z.q, z.p) / spring(start.q, start.p), 1.0, 5e-16) << order << " " << h;
    }
}

TEST(EntryScales, SlowSweepsGoOnToRounding) {
  // Measured: at most 0.5 units of rounding a step; up to 1800 where sweeps end at the first that does not
  // fall.
  for (const double h : {2.0, 2.5, 2.75, 2.9, 2.96, 3.0}) {
    const State<1> start = at(1.0, 0.3);
    State<1> z = start;
    auto method = avi::collocation(avi::poincare(spring, start), 4);
    ASSERT_EQ(avi::integrate(method, z, h, {.steps = 10000}).outcome, Outcome::ok) << h;
    EXPECT_NEAR(spring(z.q, z.p) / spring(start.q, start.p), 1.0, 10000 * 2.2e-16) << h;
  }
}

/// Two springs that know nothing of each other, of frequencies 1 and 10.
struct Pair {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * (q[0] * q[0]) + 50.0 * (q[1] * q[1]);
  }
};

TEST(EntryScales, ASmallMotionIsSolvedBesideALargeOne) {
  const double small = 1e-8;
  for (const double large : {1.0, 1e4, 1e8})
    for (const double angle : {1.0, 2.5, 12.0})  // the last by Newton's method
      for (const int order : {8, 16}) {
        State<2> z{.q = {large, small}, .p = {0.0, 0.0}};
        auto method = avi::collocation(avi::poincare(Pair{}, z), order);
        ASSERT_EQ(avi::integrate(method, z, angle / 10.0, {.steps = 2000}).outcome, Outcome::ok)
            << large << " " << angle << " " << order;
        EXPECT_NEAR(std::hypot(z.q[1], z.p[1] / 10.0) / small, 1.0, 2e-13)
            << large << " " << angle << " " << order;
      }
}

template <class Q>
auto squared(const Q& q, int i, int j) {
  const auto x = q[2 * i] - q[2 * j], y = q[2 * i + 1] - q[2 * j + 1];
  return x * x + y * y;
}
/// Sun, a comet of 1e-12 and Jupiter.
struct Comet {
  static constexpr double light = 1e-12, heavy = 9.5e-4;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + (0.5 / light) * (p[2] * p[2] + p[3] * p[3]) +
           (0.5 / heavy) * (p[4] * p[4] + p[5] * p[5]) - light / sqrt(squared(q, 0, 1)) -
           heavy / sqrt(squared(q, 0, 2)) - light * heavy / sqrt(squared(q, 1, 2));
  }
  /// The start, the comet at its aphelion.
  static State<6> start() {
    const double v = -light * std::sqrt((1.0 - 0.967) / (1.0 + 0.967) / 17.8), w = heavy / std::sqrt(5.2);
    State<6> z{.q = avi::Vector<double, 6>::Zero(), .p = avi::Vector<double, 6>::Zero()};
    z.q[2] = -17.8 * (1.0 + 0.967);
    z.q[4] = 5.2;
    z.p[1] = -v - w;
    z.p[3] = v;
    z.p[5] = w;
    return z;
  }
  /// The comet's energy in the field of the Sun, for a unit of mass.
  static double own_energy(const State<6>& z) {
    const double u = z.p[2] / light - z.p[0], v = z.p[3] / light - z.p[1];
    return 0.5 * (u * u + v * v) - 1.0 / std::sqrt(squared(z.q, 0, 1));
  }
};
const auto closest_pair = [](const auto& q) {
  return pow(pow(squared(q, 0, 1), -1.5) + pow(squared(q, 0, 2), -1.5) + pow(squared(q, 1, 2), -1.5), -0.5);
};

TEST(EntryScales, ALightBodyIsFollowedWithAMonitor) {
  // The monitor's gradient is multiplied by the energy that heavy bodies lack at a stage. Divided by the mass
  // of the comet that is so large that neither sweeps nor one matrix for all stages contract. Over one
  // return, to rounding over the comet's mass: measured 5e-6, steps of a tenth without a monitor are the
  // reference.
  State<6> z = Comet::start(), reference = z;
  auto exact = avi::collocation(avi::poincare(Comet{}, z), 16);
  auto method = avi::collocation(avi::poincare(Comet{}, z, closest_pair), 16);
  const avi::Run run = avi::integrate(method, z, 0.125, {.steps = 500});
  ASSERT_EQ(run.outcome, Outcome::ok) << run.message;
  EXPECT_GT(z.t, 400.0);
  EXPECT_LE(run.evaluations, 500 * 50);
  ASSERT_EQ(avi::integrate(exact, reference, z.t / 4000.0, {.steps = 4000}).outcome, Outcome::ok);
  EXPECT_NEAR(Comet::own_energy(z), Comet::own_energy(reference), 1e-5);
  EXPECT_NEAR(Comet{}(z.q, z.p) / Comet{}(reference.q, reference.p), 1.0, 1e-13);
}

TEST(EntryScales, WhatIsAtRestIsNoHindrance) {
  // A plane in space; a body between two others that pull alike; one that is pushed only on the way.
  const auto plane = avi::Kepler::pericentre(0.5);
  State<3> z{.q = {plane.q[0], plane.q[1], 0.0}, .p = {plane.p[0], plane.p[1], 0.0}};
  auto method = avi::collocation(avi::poincare(systems::kepler_in_space, z), 16);
  const avi::Run run = avi::integrate(method, z, 0.1, {.steps = 100});
  EXPECT_EQ(run.outcome, Outcome::ok);
  EXPECT_LE(run.evaluations, 100 * 11);
  EXPECT_EQ(z.q[2], 0.0);
  const auto pushed = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * (q[0] * q[0]) - q[0] * q[0] * q[0] * q[0] * q[1];
  };
  State<2> a{.q = {0.0, 0.0}, .p = {1e-3, 0.0}}, b = a;
  auto once = avi::collocation(avi::poincare<2>(pushed, a), 8);
  ASSERT_EQ(once.step(a, 1.0).outcome, Outcome::ok);
  auto back = avi::collocation(avi::poincare<2>(pushed, b), 8);
  State<2> there = a;
  ASSERT_EQ(back.step(there, -1.0).outcome, Outcome::ok);
  EXPECT_NEAR(there.p[1], 0.0, 1e-27) << "a.p[1] is " << a.p[1];
  EXPECT_GT(std::abs(a.p[1]), 1e-14);
}

TEST(EntryScales, AreTwiceTheStartAndItsIncrements) {
  avi::EntryScales<avi::dynamic> scales(2);
  State<avi::dynamic> start{.q = avi::Vector<double, avi::dynamic>::Zero(2),
                            .p = avi::Vector<double, avi::dynamic>::Zero(2)};
  avi::Vector<avi::Pack<2>, avi::dynamic> dq(2), dp(2);
  for (auto* each : {&dq, &dp})
    std::fill(each->data(), each->data() + 2, avi::Pack<2>(0.0));
  start.q[0] = -1.0;
  dq[0].set(0, 0.5);
  dq[0].set(1, -0.5);
  EXPECT_FALSE(scales.set(start, dq, dp));
  EXPECT_EQ(scales.q[0], 0.25);
  EXPECT_EQ(scales.q[1], 0.25) << "the scale of the largest";
  EXPECT_EQ(scales.p[0], 0.0) << "nothing moves";
  dq[1].set(0, 1e-20);
  start.p.setConstant(2.0);
  EXPECT_TRUE(scales.set(start, dq, dp));
  EXPECT_EQ(scales.q[1], 0.5 / 1e-20);
  EXPECT_EQ(scales.p[1], 0.25);
}

TEST(EntryProgress, GoesOnWhileAnyEntryImproves) {
  avi::StageValues<2, 2> old(2), step(2);
  step.per.q.setConstant(0.5);
  step.per.p.setConstant(0.5);
  avi::EntryProgress<2, 2> progress(2);
  progress.restart();
  double light = 1e-3;
  for (int k = 0; k < 5; ++k, light *= 0.25) {
    step.q[0] = avi::Pack<2>(1e-12);  // noise
    step.p[1] = avi::Pack<2>(light);
    progress.look(old, step);
    EXPECT_FALSE(progress.settled(1, true)) << k;
    EXPECT_EQ(progress.change(), 0.5 * light);
  }
  step.p[1] = avi::Pack<2>(2e-12);
  progress.look(old, step);
  EXPECT_FALSE(progress.settled(1, true)) << "it has just improved";
  progress.look(old, step);
  EXPECT_TRUE(progress.settled(1, true));
  EXPECT_FALSE(progress.settled(2, true)) << "one sweep of grace more";
  step.p[1] = avi::Pack<2>(1e-6);
  progress.look(old, step);
  EXPECT_FALSE(progress.settled(1, true)) << "it grows";
  step.p[1] = avi::Pack<2>(0.0);
  step.q[0] = avi::Pack<2>(1e-17);
  progress.look(old, step);
  EXPECT_TRUE(progress.settled(9, true)) << "below rounding";
}

/// A spring, and a body that flies far away and knows nothing of it.
const auto spring_and_comet = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0] + q[0] * q[0]) + 0.5 * p[1] * p[1];
};

// Sweeps that hardly contract leave what is small beside the comet and may look like noise: the spring's
// energy was 0.648 and 0.509 after these runs, with ok.
TEST(EntryScales, WhatIsFarAwayHidesNoUnsolvedEntry) {
  for (const auto& [order, h] :
       {std::pair{2, 1.49}, {4, 3.12}, {8, 3.66}, {12, 5.4}, {16, 6.6}, {16, 7.19}}) {
    State<1> alone = at(1.0, 0.3);
    State<2> both{.q = {1.0, 1.5e11}, .p = {0.3, 3e10}};
    auto method = avi::collocation(avi::poincare(spring, alone), order);
    auto beside = avi::collocation(avi::poincare(spring_and_comet, both), order);
    ASSERT_EQ(avi::integrate(method, alone, h, {.steps = 1000}).outcome, Outcome::ok) << order;
    ASSERT_EQ(avi::integrate(beside, both, h, {.steps = 1000}).outcome, Outcome::ok) << order;
    EXPECT_NEAR(both.q[0], alone.q[0], 1e-11) << order;
    EXPECT_NEAR(both.p[0], alone.p[0], 1e-11) << order;
  }
}

TEST(Tail, IsTheLastTermOfThePolynomial) {
  // The polynomial's difference of order s is that of its last term, s! times its leading coefficient; that
  // of (P_s - P_{s-2})(2c - 1)/2 is (2s)!/(2 (s!)^2).
  for (const int order : {2, 4, 8, 14}) {
    const int s = order / 2;
    State<2> z = avi::Kepler::pericentre(0.3);
    auto method = avi::collocation(avi::poincare(avi::Kepler{}, z, avi::Gamma{0.75}), order);
    double q[2] = {-1.0, -1.0}, p[2] = {-1.0, -1.0};
    method.tail(q, p);
    EXPECT_EQ(q[0], 0.0);
    EXPECT_EQ(p[1], 0.0);
    ASSERT_EQ(method.step(z, order == 14 ? 1.5 : 0.3).outcome, Outcome::ok);
    method.tail(q, p);
    for (int i = 0; i < 2; ++i) {
      double leading_q = 0.0, leading_p = 0.0, choose = 1.0, powers = 1.0;
      for (int k = 0; k <= s; ++k) {
        const State<2> at = method.polynomial(static_cast<double>(k) / s, 0.0);
        const double sign = (s - k) % 2 == 0 ? choose : -choose;
        leading_q += sign * at.q[i];
        leading_p += sign * at.p[i];
        choose *= static_cast<double>(s - k) / (k + 1);
      }
      for (int k = 1; k <= s; ++k)
        powers *= static_cast<double>(s) / k;
      double last = s == 1 ? 1.0 : 0.5;
      for (int k = 1; k <= s && s > 1; ++k)
        last *= static_cast<double>(s + k) / k;
      EXPECT_NEAR(q[i], std::abs(leading_q) * powers / last, 1e-13) << order;
      EXPECT_NEAR(p[i], std::abs(leading_p) * powers / last, 1e-13) << order;
      EXPECT_GT(q[i], 1e-7) << order;
    }
  }
}

}  // namespace entry_scales_test
