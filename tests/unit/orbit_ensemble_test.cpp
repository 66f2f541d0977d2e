#include "avi/problems/henon_heiles.hpp"
#include "avi/solver.hpp"
#include "scratch.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

namespace orbit_ensemble_test {

using avi::HenonHeiles, avi::State, systems::pendulum, systems::spring;

std::vector<State<2>> some_starts(int count) {
  std::vector<State<2>> starts;
  for (int i = 0; i < count; ++i)
    starts.push_back({.q = {0.0, 0.1 + 0.002 * i}, .p = {0.2, 0.0}});
  return starts;
}

TEST(OrbitEnsemble, HasTheSameBitsOnAnyNumberOfThreadsAndAlone) {
  const auto starts = some_starts(20);
  const avi::Solver solver(HenonHeiles(), starts[10], 50.0, 1e-9, {.check = false});
  const std::vector<double> times{10.0, 20.0, 50.0};
  const auto one = solver.ensemble(starts, times, {.threads = 1}),
             three = solver.ensemble(starts, times, {.threads = 3});
  for (std::size_t i = 0; i < starts.size(); ++i) {
    ASSERT_TRUE(one[i].ok()) << one[i].solution.run.message;
    EXPECT_EQ(one[i].solution.states, three[i].solution.states);
    EXPECT_EQ(one[i].solution.state, solver.run(starts[i], 50.0).state);
    EXPECT_EQ(one[i].solution.choice.h, solver.choice().h);
    const auto alone = avi::solve(HenonHeiles(), starts[i], 50.0, 1e-11);
    EXPECT_LE((alone.state.q - one[i].solution.state.q).norm(), 3e-9);
  }
}

TEST(OrbitEnsemble, KnowsItsErrorsWhereItIsToCheckThem) {
  const auto starts = some_starts(4);
  const avi::Solver solver(HenonHeiles(), starts[0], 50.0, 1e-9);
  for (const auto& member : solver.ensemble(starts, 50.0))
    EXPECT_TRUE(member.solution.kept()) << member.solution.report();
  const avi::Solver unchecked(HenonHeiles(), starts[0], 50.0, 1e-9, {.check = false});
  EXPECT_FALSE(unchecked.run(starts[1], 50.0).kept());
  EXPECT_TRUE(unchecked.run(starts[1], 50.0).ok());
}

TEST(OrbitEnsemble, GoesOnWhereAMemberThrowsOrIsCancelled) {
  auto starts = some_starts(5);
  const avi::Solver solver(HenonHeiles(), starts[0], 50.0, 1e-9, {.check = false});
  starts[2].q[0] = NAN;
  const auto members = solver.ensemble(starts, 50.0, {.threads = 2});
  EXPECT_EQ(members[2].solution.run.outcome, avi::Outcome::stopped);
  EXPECT_TRUE(members[2].error);
  EXPECT_FALSE(members[2].solution.run.message.empty());
  EXPECT_TRUE(std::isinf(members[2].solution.state_error));
  EXPECT_TRUE(std::isnan(members[2].solution.state.q[1])) << "the start is not what a run reached";
  EXPECT_THROW((void)solver.ensemble(starts, std::vector{2.0, 1.0, 3.0}), std::invalid_argument);
  for (const int i : {0, 1, 3, 4})
    EXPECT_TRUE(members[static_cast<std::size_t>(i)].ok());
  std::stop_source source;
  const auto cancelled = solver.ensemble(starts, 50.0,
                                         {.threads = 1,
                                          .progress =
                                              [&](std::size_t done, std::size_t) {
                                                if (done == 1) source.request_stop();
                                              },
                                          .cancel = source.get_token()});
  EXPECT_TRUE(cancelled[0].ok());
  for (std::size_t i = 1; i < starts.size(); ++i)
    EXPECT_EQ(cancelled[i].solution.run.outcome, avi::Outcome::stopped);
}

// By a choice for another orbit, whose first step leads to where H is no number here.
TEST(OrbitEnsemble, HasNoCurveWhereNoStepWasMade) {
  const auto root = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - sqrt(q[0]); };
  const avi::Solver solver(root, State<1>{.q = 5.0, .p = 1.0}, 20.0, 1e-8, {.check = false, .dense = true});
  const auto lost = solver.run({.q = 1e-9, .p = -1.0}, 1.0);
  EXPECT_FALSE(lost.ok());
  ASSERT_EQ(lost.run.steps, 0) << lost.report();
  EXPECT_FALSE(lost.curve);
  EXPECT_THROW((void)lost(0.5), std::logic_error);
}

// A pendulum near its top, by what was chosen for small swings.
TEST(OrbitEnsemble, SaysThatTheChoiceWasMadeForAnotherStart) {
  const avi::Solver solver(pendulum, State<1>{.q = {0.0}, .p = {0.01}}, 40.0, 1e-10);
  const auto like = solver.run({.q = {0.0}, .p = {0.011}}, 40.0);
  EXPECT_TRUE(like.kept()) << like.report();
  const auto other = solver.run({.q = {0.0}, .p = {1.9999}}, 40.0);
  EXPECT_FALSE(other.kept()) << other.report();
  EXPECT_NE(other.report().find("chosen for another start"), std::string::npos) << other.report();
}

// What is made of H for a Solver knows the energy at the start, and whatever is made of it, as parameters.
// Near the turn, steps for smaller swings are too long, and both runs err alike: by 28 to 83 tolerances where
// the state was called right.
TEST(OrbitEnsemble, SeesByTheEnergyThatStepsAreTooLong) {
  const auto at = [](double speed) { return State<1>{.q = 0.0, .p = speed}; };
  struct Case {
    double chosen_for, speed, tolerance;
  };
  for (const auto& [chosen_for, speed, tolerance] :
       {Case{0.5, 1.9, 1e-6}, Case{1.0, 1.93, 1e-6}, Case{1.0, 1.95, 1e-8}, Case{1.0, 1.99, 1e-10}}) {
    const avi::Solver solver(pendulum, at(chosen_for), 100.0, tolerance);
    const auto orbit = solver.run(at(speed), 100.0);
    EXPECT_FALSE(orbit.kept()) << orbit.report();
    EXPECT_TRUE(solver.run(at(0.9 * chosen_for), 100.0).kept());
  }
}

TEST(OrbitEnsemble, FollowsStartsOfAnyEnergy) {
  const auto own = [](const auto& q, const auto&) { return q[0] * q[0] + q[1] * q[1] + 0.01; };
  const auto start = [](double speed) { return State<2>{.q = {0.3, 0.0}, .p = {0.0, speed}}; };
  const std::vector<avi::SolveMonitor> monitors{"fixed",        "energy", "energy^1.5", "poles",
                                                "acceleration", own,      "splitting"};
  for (const auto& monitor : monitors)
    for (const bool check : {true, false}) {
      const avi::Solver solver(systems::kepler, start(2.3), 8.0, 1e-7, {.check = check, .monitor = monitor});
      for (const double speed : {2.2, 2.35, 2.3}) {
        const auto exact = avi::solve(systems::kepler, start(speed), {3.0, 8.0}, 1e-12);
        const auto run = solver.run(start(speed), std::vector<double>{3.0, 8.0});
        ASSERT_TRUE(exact.kept() && run.ok()) << monitor.name;
        for (const int i : {0, 1})
          EXPECT_LE((run.states[i].q - exact.states[i].q).norm(), 1e-6) << monitor.name << " " << speed;
        EXPECT_LE((solver.run(start(speed), 8.0).state.q - exact.state.q).norm(), 1e-6) << monitor.name;
      }
    }
}

TEST(OrbitEnsemble, RefusesOtherStarts) {
  const State<avi::dynamic> start{.q = avi::VectorX::Constant(1, 1.0), .p = avi::VectorX::Constant(1, 0.0)};
  const avi::Solver solver(spring, start, 10.0, 1e-8);
  const State<avi::dynamic> wide{.q = avi::VectorX::Constant(2, 1.0), .p = avi::VectorX::Constant(2, 0.0)};
  EXPECT_THROW((void)solver.run(wide, 1.0), std::invalid_argument);
  EXPECT_THROW((void)solver.run(start, std::vector<double>{}), std::invalid_argument);
  EXPECT_THROW((void)solver.ensemble({start}, 1.0, {.threads = -1}), std::invalid_argument);
  EXPECT_THROW(avi::Solver(spring, start, 0.0, 1e-8), std::invalid_argument);
}

TEST(OrbitEnsemble, HasNoFileForItsRuns) {
  const Scratch folder;
  const std::string file = folder / "run";
  std::ofstream(file) << "viorbit4 of another run";
  const auto starts = some_starts(2);
  const avi::Solver solver(HenonHeiles(), starts[0], 50.0, 1e-9, {.check = false, .checkpoint = file});
  EXPECT_TRUE(std::filesystem::exists(file));  // the orbit that is chosen for is nobody's
  EXPECT_THROW((void)solver.ensemble(starts, 50.0), std::invalid_argument);
  EXPECT_TRUE(solver.run(starts[1], 50.0).ok());
}

}  // namespace orbit_ensemble_test
