#include "src/choice/journey.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

namespace journey_test {

using avi::Outcome, avi::VectorX, avi::detail::Budget, avi::detail::Candidate, avi::detail::Journey,
    avi::detail::PointField, avi::detail::Ranges, avi::detail::Trip;
using State = avi::State<avi::dynamic>;

VectorX vector(auto... entries) { return VectorX{{entries...}}; }

TEST(Ranges, AreOfTheSmallestAndTheLargestEntries) {
  Ranges ranges({.q = vector(-1.0, 3.5), .p = vector(0.0, 2.0)});
  ranges.add({.q = vector(0.0, 3.0), .p = vector(4.0, 2.5)});
  ranges.add({.q = vector(1.0, 3.25), .p = vector(-4.0, 1.0)});
  EXPECT_EQ(ranges.low, vector(-1.0, 3.0, -4.0, 1.0));
  EXPECT_EQ(ranges.high, vector(1.0, 3.5, 4.0, 2.5));
}

/// H = (p^2 + q^2)/2 from (q, p) = (1, 0) at t = 2, and two methods for it.
struct Spring {
  std::shared_ptr<avi::ExpressionGraph> graph = std::make_shared<avi::ExpressionGraph>(2);
  int energy, lively;
  State start{.q = vector(1.0), .p = vector(0.0), .t = 2.0};
  avi::SolveOptions options;
  Budget budget{options};

  Spring() {
    const auto q = avi::recorded_inputs(*graph, 0, 1), p = avi::recorded_inputs(*graph, 1, 1);
    energy = avi::Recorded(0.5 * (p[0] * p[0] + q[0] * q[0])).node_in(*graph);
    lively = avi::Recorded(1.0 / (1.0 + 2.0 * q[0] * q[0])).node_in(*graph);
  }
  [[nodiscard]] Candidate fixed() const { return {"fixed", 0.0, graph, energy, 0.5, -1}; }
  /// With g = 1/(1 + 2 q^2).
  [[nodiscard]] Candidate given() const { return {"given", -1.0, graph, energy, 0.5, lively}; }
  [[nodiscard]] PointField field() const { return {*graph, energy, {}}; }
  [[nodiscard]] Trip trip(double sense) { return {start, 0.5, 0.25, sense, budget}; }
};

TEST(Steps, AreDividedAtATime) {
  const Spring spring;
  PointField field = spring.field();
  for (Candidate candidate : {spring.fixed(), spring.given()})
    for (const double h : {0.3, -0.3}) {
      const auto method = candidate.steps(12, {});
      State z = spring.start;
      ASSERT_TRUE(method->step(z, h).ok());
      EXPECT_EQ(candidate.fixed(), std::abs(z.t - (2.0 + h)) < 1e-15);
      for (const double part : {0.01, 0.3, 0.6, 0.99}) {
        const double t = 2.0 + part * (z.t - 2.0);
        const double c = avi::detail::part_at(*method, candidate, spring.start, h, z.t, t);
        EXPECT_NEAR(method->polynomial(c).t, t, 1e-11);
        State there;
        const auto aside = method->clone();
        EXPECT_TRUE(avi::detail::land(*aside, candidate, field, spring.start, h, z.t, t, there).ok());
        EXPECT_EQ(there.t, t);
        EXPECT_NEAR(there.q[0], std::cos(t - 2.0), 1e-13);
        EXPECT_NEAR(there.p[0], -std::sin(t - 2.0), 1e-13);
      }
    }
}

TEST(Journey, GoesFromMarkToMark) {
  for (const double sense : {1.0, -1.0}) {
    Spring spring;
    PointField field = spring.field();
    for (Candidate candidate : {spring.fixed(), spring.given()}) {
      Trip trip = spring.trip(sense);
      Journey journey(trip, field, candidate, 12, 0.25, {});
      const long before = spring.budget.sweeps;
      journey.advance(2.0 + sense * 3.0, false);
      journey.advance(2.0 + sense * 20.0, true);
      ASSERT_TRUE(journey.ok());
      ASSERT_EQ(journey.marks.size(), 2u);
      for (int k = 0; k < 2; ++k) {
        const double t = k == 0 ? 3.0 : 20.0;
        EXPECT_EQ(journey.marks[k].t, 2.0 + sense * t);
        EXPECT_NEAR(journey.marks[k].q[0], std::cos(t), 1.2e-10);
        EXPECT_NEAR(journey.marks[k].p[0], -sense * std::sin(t), 1.2e-10);
      }
      EXPECT_EQ(journey.state, journey.marks[1]);
      EXPECT_EQ(candidate.fixed(), journey.run.steps == 80);
      EXPECT_EQ(spring.budget.sweeps - before, journey.run.evaluations);
      EXPECT_LT(journey.energy_error, 7e-11);
      EXPECT_GT(journey.energy_error, 0.0);
      EXPECT_LT((journey.ranges.high - vector(1.0, 1.0)).norm(), 0.05);
      EXPECT_LT((journey.ranges.low + vector(1.0, 1.0)).norm(), 0.05);
      EXPECT_EQ(journey.tails.size(), 2);
      EXPECT_FALSE(journey.spent);
    }
  }
}

TEST(Journey, HasTheSameBitsBesideAnotherOne) {
  Spring spring;
  PointField field = spring.field();
  Candidate candidate(std::string(avi::detail::splitting), 0.0, spring.graph, spring.energy, 0.5, -1);
  Trip trip = spring.trip(1.0);
  Journey coarse(trip, field, candidate, 6, 0.3, {}), fine(trip, field, candidate, 6, 0.25, {});
  fine.go_beside(coarse, 12.1);
  for (Journey* both : {&coarse, &fine}) {
    EXPECT_GT(both->run.steps, 30);
    both->advance(12.1, true);
    Journey alone(trip, field, candidate, 6, both->h, {});
    alone.advance(12.1, true);
    EXPECT_EQ(both->state, alone.state);
    EXPECT_EQ(both->run.steps, alone.run.steps);
    EXPECT_EQ(both->run.evaluations, alone.run.evaluations);
    EXPECT_EQ(both->energy_error, alone.energy_error);
    EXPECT_EQ(both->ranges.low, alone.ranges.low);
    EXPECT_EQ(both->ranges.high, alone.ranges.high);
  }
}

TEST(Journey, EndsAtItsBounds) {
  Spring spring;
  PointField field = spring.field();
  Candidate candidate = spring.fixed();
  Trip trip = spring.trip(1.0);
  Journey long_one(trip, field, candidate, 8, 0.5, {});
  long_one.most = 100.0;
  long_one.advance(1e3, true);
  EXPECT_EQ(long_one.run.outcome, Outcome::stopped);
  EXPECT_GT(long_one.run.evaluations, 100);
  EXPECT_LT(long_one.run.evaluations, 130);
  EXPECT_TRUE(long_one.marks.empty());
  EXPECT_NEAR(long_one.state.t, 2.0 + 0.5 * static_cast<double>(long_one.run.steps), 1e-12)
      << "the last good state";
  spring.options.steps = 7;
  Journey short_one(trip, field, candidate, 8, 0.5, {});
  short_one.advance(1e3, true);
  EXPECT_EQ(short_one.run.outcome, Outcome::step_limit);
  EXPECT_TRUE(short_one.spent);
  EXPECT_EQ(short_one.run.steps, 7);
  EXPECT_EQ(short_one.state.t, 5.5);
}

TEST(Journey, IsStalledWhereTimeDoesNotGoOn) {
  Spring spring;
  PointField field = spring.field();
  spring.lively = avi::Recorded(1e-30).node_in(*spring.graph);
  Candidate candidate = spring.given();
  Trip trip = spring.trip(1.0);
  Journey journey(trip, field, candidate, 8, 0.5, {});
  journey.advance(3.0, true);
  EXPECT_EQ(journey.run.outcome, Outcome::stalled);
  EXPECT_EQ(journey.run.steps, 0);
  EXPECT_EQ(journey.state, spring.start);
}

}  // namespace journey_test
