#include "avi/core/event.hpp"

#include "avi/avi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using avi::Crossing, avi::Event, avi::Kepler, avi::State;

namespace event_test {

/// q . p is zero at pericentre, where it rises, and at apocentre.
const auto radial = [](const State<2>& z) { return z.q.dot(z.p); };

auto method_for(const State<2>& z) {
  return avi::splitting(avi::LogHamiltonian(Kepler{}, z), avi::compositions::kahan_li8);
}

std::vector<State<2>> events(Crossing crossing, double h, double t_end) {
  auto z = Kepler::exact(0.5, 1.0);
  auto method = method_for(z), plain_method = method_for(z);
  auto plain = z;
  std::vector<State<2>> found;
  const auto run = avi::integrate(
      method, z, h, {.time = t_end},
      avi::on_event(Event{radial, crossing}, [&](const State<2>& point) { found.push_back(point); }));
  EXPECT_EQ(run.outcome, avi::Outcome::ok) << run.message;
  EXPECT_EQ(avi::integrate(plain_method, plain, h, {.time = t_end}).outcome, avi::Outcome::ok);
  EXPECT_TRUE(z.q == plain.q && z.p == plain.p && z.t == plain.t) << "the run is not touched";
  return found;
}

TEST(Event, IsFoundToRoundOffInEachDirection) {
  for (const auto& [crossing, first, period] : {std::tuple{Crossing::rising, 2.0 * M_PI, 2.0 * M_PI},
                                                {Crossing::falling, M_PI, 2.0 * M_PI},
                                                {Crossing::either, M_PI, M_PI}}) {
    const auto found = events(crossing, 0.2, 26.0);
    ASSERT_EQ(found.size(), crossing == Crossing::either ? 8u : 4u);
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_LT(std::abs(radial(found[k])), 1e-15);
      EXPECT_NEAR(found[k].t, first + static_cast<double>(k) * period, 2e-9);  // of the run: measured 7e-10
    }
  }
}

TEST(Event, RunsBackwardsInTheSenseOfTheRun) {
  const auto found = events(Crossing::rising, -0.2, -16.0);
  ASSERT_EQ(found.size(), 3u) << "against time, q . p rises at apocentre";
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k].t, -M_PI - 2.0 * M_PI * static_cast<double>(k), 2e-9);
}

TEST(Event, OnAStartDoesNotCount) {
  auto z = Kepler::pericentre(0.5);
  z.p[0] = 0.0;
  auto method = method_for(z);
  int count = 0;
  const auto run = avi::integrate(method, z, 0.2, {.time = 6.0},
                                  avi::on_event(Event{radial}, [&](const State<2>&) { ++count; }));
  EXPECT_EQ(run.outcome, avi::Outcome::ok);
  EXPECT_EQ(count, 1) << "apocentre";
}

TEST(Event, AtTheEndOfAStepBelongsToThatStep) {
  const auto seen = [](Crossing crossing, double before, double after) {
    return Event{[](double x) { return x; }, crossing}.crosses(before, after);
  };
  EXPECT_TRUE(seen(Crossing::rising, -1.0, 0.0) && seen(Crossing::falling, 1.0, 0.0));
  EXPECT_FALSE(seen(Crossing::either, 0.0, 1.0) || seen(Crossing::either, 0.0, -1.0));
  EXPECT_FALSE(seen(Crossing::rising, 1.0, 0.0) || seen(Crossing::falling, -1.0, 0.0));
}

TEST(Event, AtTheEndOfAStepIsFoundWithoutAnother) {
  const auto before = Kepler::exact(0.5, 1.0);
  auto after = before;
  auto method = method_for(before);
  ASSERT_EQ(method.step(after, 0.2).outcome, avi::Outcome::ok);
  const avi::Step<decltype(method), State<2>> step{method, before, after, 0.2};
  const auto found = step.locate(
      0.0, before.t - after.t, [&](const State<2>& z) { return z.t - after.t; }, 0.0);
  EXPECT_EQ(found.evaluations, 0);
  EXPECT_TRUE(found.state == after && found.h == 0.2);
}

TEST(Event, ActionMayEndTheRun) {
  auto z = Kepler::exact(0.5, 1.0);
  auto method = method_for(z);
  int count = 0;
  const auto run = avi::integrate(method, z, 0.2, {.time = 100.0},
                                  avi::on_event(Event{radial}, [&](const State<2>&) { return ++count < 3; }));
  EXPECT_EQ(run.outcome, avi::Outcome::stopped);
  EXPECT_EQ(count, 3);
  EXPECT_GE(z.t, 3.0 * M_PI);
  EXPECT_LT(z.t, 3.0 * M_PI + 0.5);
}

TEST(Event, EndsARunExactly) {
  const auto start = Kepler::exact(0.5, 1.0);
  auto z = start;
  auto method = method_for(z);
  long last = 0;
  const auto run = avi::integrate_to(method, z, 0.2, Event{radial, Crossing::rising}, {.time = 10.0},
                                     [&](const State<2>& now, long k) {
                                       last = k;
                                       EXPECT_LE(now.t, 2.0 * M_PI + 1e-8);
                                     });
  EXPECT_EQ(run.outcome, avi::Outcome::ok) << run.message;
  EXPECT_EQ(run.steps, last);
  EXPECT_LT(std::abs(radial(z)), 1e-15);
  EXPECT_NEAR(z.t, 2.0 * M_PI, 2e-9);
  EXPECT_NEAR(z.q.norm(), 0.5, 2e-9);
  z = start;
  EXPECT_EQ(avi::integrate_to(method, z, 0.2, Event{radial, Crossing::rising}, {.time = 5.0}).outcome,
            avi::Outcome::step_limit)
      << "no event on the way";
  EXPECT_GE(z.t, 5.0);
  // Nor one behind that time, in a step that passes both.
  for (const double h : {0.01, 0.2, 0.7}) {
    z = start;
    auto fresh = method_for(z);
    EXPECT_EQ(avi::integrate_to(fresh, z, h, Event{radial, Crossing::rising}, {.time = 6.28}).outcome,
              avi::Outcome::step_limit)
        << h;
    EXPECT_GE(z.t, 6.28);
  }
}

/// A state of which the clock alone moves.
struct Clock {
  avi::StepReport step(State<1>& z, double h) const {
    z.t += h;
    return {};
  }
};

TEST(Event, AtAPoleIsNone) {
  // One over the time to 3, which is infinite at the end of a step; a bounded search meets it, too.
  for (const double sign : {1.0, -1.0})
    for (const double h : {0.25, 0.4}) {
      State<1> z{.q = {1.0}, .p = {0.0}};
      Clock clock;
      const Event pole{[sign](const State<1>& s) { return sign / (s.t - 3.0); }};
      const auto run = avi::integrate_to(clock, z, h, pole, {.time = 6.0});
      EXPECT_EQ(run.outcome, avi::Outcome::not_converged) << h;
      EXPECT_LT(z.t, 3.0);
    }
}

TEST(Event, InTimeIsFoundWhereTheClockIsCoarse) {
  for (const double t0 : {0.0, 1e6, 1e7, 1e8, 1.7e9, -1e9, 1e15})
    for (const double slope : {1.0, 1e-6, 1e6}) {
      const double step = std::max(0.3, 1e-12 * t0), after = 4.123 * step;  // no number of the clock
      State<1> z{.q = {1.0}, .p = {0.0}, .t = t0};
      Clock clock;
      const Event time{[&](const State<1>& s) { return slope * (s.t - t0 - after); }};
      const auto run = avi::integrate_to(clock, z, step, time, {.steps = 100});
      EXPECT_TRUE(run.ok()) << run.message;
      EXPECT_NEAR(z.t, t0 + after, 4e-16 * std::abs(t0) + 1e-15);
      // A jump there is one still.
      z.t = t0;
      const Event jump{[&](const State<1>& s) { return s.t - t0 < after ? -1.0 : 1.0; }};
      EXPECT_EQ(avi::integrate_to(clock, z, step, jump, {.steps = 100}).outcome, avi::Outcome::not_converged)
          << t0;
    }
}

TEST(Event, ToleranceEndsTheSearchEarly) {
  const auto tries = [](double tolerance) {
    auto z = Kepler::exact(0.5, 1.0);
    auto method = method_for(z);
    const auto run =
        avi::integrate_to(method, z, 0.2, Event{radial, Crossing::either, tolerance}, {.time = 10.0});
    EXPECT_LE(std::abs(radial(z)), std::max(tolerance, 1e-15));
    return run.evaluations;
  };
  EXPECT_LT(tries(1e-3), tries(0.0));
}

}  // namespace event_test
