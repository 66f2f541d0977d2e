#include "avi/problems/kepler.hpp"
#include "avi/solve.hpp"
#include "avi/solver.hpp"
#include "kept.hpp"
#include "refusal.hpp"
#include "resumed.hpp"
#include "scratch.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace solve_options_test {

using avi::Kepler, avi::solve, avi::SolveProgress, systems::at, systems::spring;

TEST(SolveOptions, FixMonitorOrderAndStep) {
  const auto z = Kepler::pericentre(0.6);
  for (const char* name : {"fixed", "energy", "energy^1.5"})
    for (const int order : {2, 4, 6, 10, 16}) {
      const auto orbit = solve(Kepler(), z, 10.0, 1e-6, {.order = order, .monitor = name, .h = 0.03});
      EXPECT_EQ(orbit.choice.name, name);
      EXPECT_EQ(orbit.choice.order, order);
      EXPECT_EQ(orbit.choice.h, 0.03);
      EXPECT_TRUE(orbit.ok());
      EXPECT_EQ(orbit.kept(), order > 4 || (order == 4 && name != std::string("fixed"))) << orbit.report();
      const auto chosen = kept(solve(Kepler(), z, 10.0, 1e-6, {.order = order, .monitor = name}));
      EXPECT_EQ(chosen.choice.name, name);
      EXPECT_EQ(chosen.choice.order, order);
    }
}

// A second of processor time, with or without a second run.
TEST(SolveOptions, LetAStepThatIsGivenGoOnForLong) {
  const auto chain = [](const auto& q, const auto& p) {
    auto sum = 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0];
    for (int i = 1; i < q.size(); ++i)
      sum = sum + 0.5 * p[i] * p[i] + 0.5 * (q[i] - q[i - 1]) * (q[i] - q[i - 1]);
    return sum;
  };
  const int n = 100;
  const avi::State<avi::dynamic> z{.q = avi::VectorX::LinSpaced(n, 0.0, 1.0), .p = avi::VectorX::Zero(n)};
  const auto orbit =
      solve(chain, z, 4e4, 1e-3, {.check = false, .order = 6, .monitor = "splitting", .h = 0.2});
  EXPECT_TRUE(orbit.ok()) << orbit.report();
  EXPECT_EQ(orbit.state.t, 4e4);
}

// A run by hand of the same choice: the map of a spring under order 4, whose error at the end is known.
TEST(SolveOptions, EstimateTheErrorOfAStepThatIsGiven) {
  const double h = 0.1;
  const auto orbit = solve(spring, at(1.0, 0.0), 30.0, 1e-4, {.order = 4, .monitor = "fixed", .h = h});
  const double error = std::abs(orbit.state.q[0] - std::cos(30.0)) / 2.0;
  EXPECT_GT(orbit.state_error, 0.3 * error);
  EXPECT_LT(orbit.state_error, 5.0 * error);
}

TEST(SolveOptions, AreToldOfTheProgressInOrder) {
  auto z = Kepler::pericentre(0.6);
  z.t = 5e3;
  std::vector<SolveProgress> seen;
  const avi::SolveOptions options{.progress = [&](const SolveProgress& now) {
    seen.push_back(now);
    return true;
  }};
  const auto watched = solve(Kepler(), z, std::vector<double>{5e3 + 1.0, 1e4}, 1e-10, options);
  EXPECT_TRUE(watched.ok());
  ASSERT_GE(seen.size(), 2u);
  double seconds = 0.0;
  long sweeps = 0;
  bool running = false;
  for (const SolveProgress& now : seen) {
    EXPECT_GE(now.seconds, seconds);
    EXPECT_GE(now.sweeps, sweeps);
    EXPECT_GE(now.fraction, 0.0);
    EXPECT_LE(now.fraction, 1.0);
    EXPECT_NEAR(now.fraction, (now.t - z.t) / 5e3, 1e-12);
    if (now.phase == avi::SolvePhase::running) running = true;
    EXPECT_EQ(now.phase == avi::SolvePhase::running, running);
    seconds = now.seconds, sweeps = now.sweeps;
  }
  EXPECT_TRUE(running);
  // At most some twenty calls a second.
  EXPECT_LE(static_cast<double>(seen.size()), 21.0 * seconds + 3.0);
  EXPECT_EQ(watched.state, solve(Kepler(), z, std::vector<double>{5e3 + 1.0, 1e4}, 1e-10).state);
}

TEST(SolveOptions, CancelACallThatKeepsWhatItHas) {
  const auto z = Kepler::pericentre(0.6);
  const auto orbit =
      solve(Kepler(), z, std::vector<double>{1.0, 1e9}, 1e-10,
            {.order = 16, .monitor = "energy", .h = 0.3, .progress = [](const SolveProgress& now) {
               return now.phase != avi::SolvePhase::choosing;
             }});
  EXPECT_EQ(orbit.run.outcome, avi::Outcome::stopped);
  EXPECT_FALSE(orbit.kept());
  EXPECT_NE(orbit.report().find("stopped by the callback"), std::string::npos);
  const auto thrown = [](const SolveProgress&) -> bool { throw std::domain_error("enough"); };
  EXPECT_THROW((void)solve(Kepler(), z, 1e9, 1e-10, {.progress = thrown}), std::domain_error);
}

// Before the run that is kept has begun, too.
TEST(SolveOptions, CancelACallThatIsResumed) {
  const auto z = Kepler::pericentre(0.6);
  const Scratch folder;
  const std::string file = folder / "run";
  const auto early = [](const SolveProgress& now) {
    EXPECT_EQ(now.phase, avi::SolvePhase::choosing);
    return now.steps < 100;
  };
  const auto part = solve(Kepler(), z, 1e5, 1e-8, {.check = false, .progress = early, .checkpoint = file});
  EXPECT_EQ(part.run.outcome, avi::Outcome::stopped);
  EXPECT_NE(part.report().find("stopped by the callback"), std::string::npos);
  const auto rest = avi::resume<2>(Kepler(), file);
  EXPECT_TRUE(rest.ok()) << rest.report();
  EXPECT_EQ(rest.state.t, 1e5);
  EXPECT_EQ(refusal([&] { (void)avi::resume<2>(Kepler(), file); }), "There is no checkpoint " + file + ".");
}

/// Leaves the checkpoint of a call that was stopped on its way from z.
void stop_on_the_way(const avi::State<2>& z, const std::string& file) {
  const auto soon = [](const SolveProgress& now) {
    return now.phase == avi::SolvePhase::choosing || now.steps < 100;
  };
  (void)solve(Kepler(), z, 1e5, 1e-8, {.progress = soon, .checkpoint = file});
  ASSERT_TRUE(std::filesystem::exists(file));
}

TEST(SolveOptions, OfARunWithoutLengthTakeTheCheckpointOfAnEarlierCallAway) {
  const auto z = Kepler::pericentre(0.6);
  const Scratch folder;
  const std::string file = folder / "run";
  stop_on_the_way(z, file);
  EXPECT_TRUE(solve(Kepler(), z, z.t, 1e-8, {.checkpoint = file}).ok());
  EXPECT_FALSE(std::filesystem::exists(file)) << "resume() would go on with another run";
}

// A mistyped start costs no run that is kept.
TEST(SolveOptions, ThatAreRefusedLeaveTheCheckpointOfAnEarlierCall) {
  const auto z = Kepler::pericentre(0.6);
  const Scratch folder;
  const std::string file = folder / "run";
  stop_on_the_way(z, file);
  const avi::State<2> centre{.q = {0.0, 0.0}, .p = {0.0, 1.0}};
  EXPECT_THROW((void)solve(Kepler(), centre, 1.0, 1e-8, {.checkpoint = file}), std::invalid_argument);
  const auto rest = avi::resume<2>(Kepler(), file);
  EXPECT_TRUE(rest.ok()) << rest.report();
  EXPECT_EQ(rest.state.t, 1e5);
}

TEST(SolveOptions, ResumeAsIfNothingHadHappened) {
  // On its own level, which the energy leaves by rounding alone, that is not found again.
  const auto off = [](const auto& q, const auto& p) { return spring(q, p) - 0.5; };
  expect_to_go_on(spring, at(1.0, 0.0), 3000.0, 1e-8,
                  {.order = 16, .monitor = "fixed", .h = 0.2, .events = {avi::when(off)}}, 6000);
  // A monitor of one's own makes steps ever shorter on purpose.
  const auto ever_shorter = [](const auto&, const auto& t, const auto&) { return (1.02 - t) * (1.02 - t); };
  const auto timed = [](const auto& q, const auto&, const auto& p) { return spring(q, p); };
  expect_to_go_on(timed, at(1.0, 0.0), 1.0, 1e-8, {.order = 4, .monitor = ever_shorter, .h = 0.001}, 3000);
  const avi::Solver solver(timed, at(1.0, 0.0), 1.0, 1e-8,
                           {.check = false, .order = 4, .monitor = ever_shorter, .h = 0.001});
  EXPECT_TRUE(solver.run(at(1.0, 0.0), 1.0).ok());
}

TEST(SolveOptions, OfACheckpointAreRefused) {
  const Scratch folder;
  const std::string file = folder / "run";
  std::ofstream(file) << "a thesis";
  const auto z = Kepler::pericentre(0.6);
  expect_refusal([&] { (void)solve(Kepler(), z, 10.0, 1e-8, {.checkpoint = file}); }, "is no checkpoint");
  EXPECT_EQ(std::filesystem::file_size(file), 8u);
  expect_refusal([&] { (void)avi::resume<2>(Kepler(), file, {}, -5); }, "are -5; they must be 2.");
  expect_refusal([&] { (void)avi::resume<2>(Kepler(), file, {}, 3); }, "are 3; they must be 2.");
  expect_refusal([&] { (void)avi::resume<avi::dynamic>(Kepler(), file); }, "are -1; they must be at least 1");
}

TEST(SolveOptions, BoundStepsAndKeepWhatWasReached) {
  const auto z = Kepler::pericentre(0.6);
  const auto orbit = solve(Kepler(), z, std::vector<double>{1.0, 2.0, 1e6}, 1e-10, {.steps = 500});
  EXPECT_EQ(orbit.run.outcome, avi::Outcome::step_limit);
  EXPECT_LE(orbit.run.steps, 500);
  EXPECT_EQ(orbit.states.size(), 2u);
  EXPECT_GT(orbit.state.t, 2.0);
  const auto swept = solve(Kepler(), z, std::vector<double>{1.0, 2.0, 1e9}, 1e-10, {.sweeps = 100000});
  EXPECT_EQ(swept.run.outcome, avi::Outcome::step_limit);
  EXPECT_EQ(swept.states.size(), 2u);
  EXPECT_LE(swept.run.evaluations + swept.choice.sweeps, 100200);
  // While monitor and step are being chosen, too.
  const auto early = solve(Kepler(), z, 100.0, 1e-8, {.steps = 20});
  EXPECT_EQ(early.run.outcome, avi::Outcome::step_limit);
  EXPECT_EQ(early.run.steps, 20);
  EXPECT_GT(early.state.t, 5.0);
  EXPECT_TRUE(early.state.finite());
}

TEST(SolveOptions, DoNotHelpWhereTheEndIsBeyondTheDigitsOfTime) {
  const auto orbit = solve(Kepler(), Kepler::pericentre(0.6), 1e30, 1e-8);
  EXPECT_EQ(orbit.run.outcome, avi::Outcome::stalled);
  EXPECT_NE(orbit.run.message.find("The end, t = 1e+30, is some"), std::string::npos) << orbit.run.message;
  EXPECT_FALSE(orbit.state.finite());
  EXPECT_LT(orbit.choice.sweeps, 100);
}

// The run with the longer step comes to the end where that with the shorter one meets the bound.
TEST(SolveOptions, DoNotCallAnEndKeptThatABoundForbadeToReach) {
  const auto z = Kepler::pericentre(0.2);
  const auto whole = solve(Kepler(), z, 100.0, 1e-8);
  const long bound = whole.run.steps - 2;
  const auto orbit = solve(Kepler(), z, 100.0, 1e-8, {.steps = bound});
  EXPECT_EQ(orbit.run.outcome, avi::Outcome::step_limit) << orbit.report();
  EXPECT_EQ(orbit.state.t, 100.0);
  EXPECT_GT(orbit.choice.h, whole.choice.h);
  EXPECT_NE(orbit.run.message.find("with the longer step"), std::string::npos) << orbit.run.message;
  const avi::SolveOptions given{
      .steps = bound, .order = whole.choice.order, .monitor = whole.choice.name, .h = whole.choice.h};
  const auto by_hand = solve(Kepler(), z, 100.0, 1e-8, given);
  EXPECT_EQ(by_hand.run.outcome, avi::Outcome::step_limit) << by_hand.report();
  EXPECT_EQ(by_hand.run.steps, bound);
  EXPECT_EQ(by_hand.choice.h, whole.choice.h);
}

// The other run, which comes second, had used up the bound: a single step was kept.
TEST(SolveOptions, KeepWhatTheStepThatIsGivenHasReached) {
  const avi::SolveOptions given{.sweeps = 30'000, .monitor = "fixed", .h = 1e-5};
  const auto cut = solve(Kepler(), Kepler::pericentre(0.5), 1e4, 1e-6, given);
  EXPECT_EQ(cut.run.outcome, avi::Outcome::step_limit) << cut.report();
  EXPECT_EQ(cut.choice.h, 1e-5);
  EXPECT_GT(cut.run.steps, 5000);  // measured 9999, of three sweeps
  // The bound is met by the second run.
  const auto both = solve(Kepler(), Kepler::pericentre(0.5), 0.08, 1e-6, given);
  EXPECT_EQ(both.run.outcome, avi::Outcome::step_limit) << both.report();
  EXPECT_EQ(both.state.t, 0.08);
  EXPECT_NE(both.run.message.find("which was to show the error"), std::string::npos) << both.run.message;
}

// With output on the way it ended as ok.
TEST(SolveOptions, SayThatABoundWasMetWhateverIsAskedFor) {
  const auto z = Kepler::pericentre(0.2);
  const long bound = solve(Kepler(), z, 100.0, 1e-8).run.steps - 2;
  const auto alone = solve(Kepler(), z, 100.0, 1e-8, {.steps = bound});
  for (const auto& orbit : {solve(Kepler(), z, 100.0, 1e-8, {.steps = bound, .dense = true}),
                            solve(Kepler(), z, std::vector<double>{1.0, 100.0}, 1e-8, {.steps = bound})}) {
    EXPECT_EQ(orbit.run.outcome, avi::Outcome::step_limit) << orbit.report();
    EXPECT_EQ(orbit.run.message, alone.run.message);
    EXPECT_EQ(orbit.state.t, 100.0);
  }
}

// Whichever of two runs meets a bound, the outcome is that of the bound and the message is about it.
TEST(SolveOptions, AreNamedWhenABoundIsMet) {
  const auto z = Kepler::pericentre(0.6);
  for (int k = 0; k < 12; ++k) {
    const auto timed = solve(Kepler(), z, 1e9, 1e-10, {.seconds = 0.01 + 0.003 * k});
    EXPECT_EQ(timed.run.outcome, avi::Outcome::time_limit) << timed.run.message;
    const auto swept = solve(Kepler(), z, 1e9, 1e-10, {.sweeps = 100'000 + 1234 * k});
    EXPECT_EQ(swept.run.outcome, avi::Outcome::step_limit) << swept.run.message;
    for (const auto& orbit : {timed, swept})
      EXPECT_EQ(orbit.run.message.find("over a hundred times"), std::string::npos) << orbit.run.message;
  }
}

TEST(SolveOptions, LetTheSolutionBeCalled) {
  const auto z = Kepler::pericentre(0.8);
  const std::vector<double> times{0.0, 0.1, 3.0, 6.2, 6.3, 19.0, 20.0};
  const auto orbit = solve(Kepler(), z, times, 1e-10, {.dense = true});
  const auto called = orbit(times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(called[i].t, times[i]);
    EXPECT_LE((called[i].q - orbit.states[i].q).norm(), 1e-14) << i;  // measured 4.8e-15
    EXPECT_LE((called[i].p - orbit.states[i].p).norm(), 2e-14) << i;
  }
  EXPECT_EQ(orbit(6.3), called[4]);
  EXPECT_EQ(orbit(20.0), orbit.state);
  EXPECT_THROW((void)orbit(20.1), std::invalid_argument);
  EXPECT_THROW((void)orbit(-0.1), std::invalid_argument);
  EXPECT_THROW((void)orbit(NAN), std::invalid_argument);
  EXPECT_THROW((void)solve(Kepler(), z, 1.0, 1e-6)(0.5), std::logic_error);
  // Where the end is the start, too.
  const auto still = solve(Kepler(), z, z.t, 1e-6, {.dense = true});
  ASSERT_TRUE(still.curve);
  EXPECT_EQ(still(z.t), z);
  EXPECT_THROW((void)still(z.t + 1.0), std::invalid_argument);
}

// q'' = -q + 0.3 cos 2t by hand.
TEST(SolveOptions, TimeMayBeInH) {
  const auto driven = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] - 0.3 * q[0] * cos(2.0 * t);
  };
  auto z = at(1.0, 0.0);
  z.t = 0.5;
  const double c = -0.1, a = 1.0 - c * std::cos(1.0), b = 2.0 * c * std::sin(1.0);
  const auto exact = [&](double t) {
    return a * std::cos(t - 0.5) + b * std::sin(t - 0.5) + c * std::cos(2.0 * t);
  };
  for (const double tolerance : {1e-5, 1e-8, 1e-12}) {
    const auto orbit = kept(solve(driven, z, std::vector<double>{0.5, 7.0, 100.0}, tolerance));
    EXPECT_EQ(orbit.states[0], z);
    EXPECT_NEAR(orbit.states[1].q[0], exact(7.0), 3.0 * tolerance);
    EXPECT_NEAR(orbit.state.q[0], exact(100.0), 3.0 * tolerance);
    EXPECT_EQ(orbit.state.t, 100.0);
    const auto back = solve(driven, orbit.state, 0.5, tolerance);
    EXPECT_NEAR(back.state.q[0], 1.0, 5.0 * tolerance);
  }
  const avi::State<avi::dynamic> wide{
      .q = avi::VectorX::Constant(1, 1.0), .p = avi::VectorX::Constant(1, 0.0), .t = 0.5};
  EXPECT_NEAR(solve(driven, wide, 7.0, 1e-10).state.q[0], exact(7.0), 1e-9);
}

TEST(SolveOptions, AreRefusedWithASentence) {
  const auto z = Kepler::pericentre(0.6);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const avi::SolveOptions& options, const char* part) {
    expect_refusal([&] { (void)solve(Kepler(), z, 1.0, 1e-6, options); }, part);
  };
  refused({.seconds = nan}, "nan");
  refused({.steps = 0}, "Bound on steps is 0");
  refused({.order = 3}, "Order is 3");
  refused({.order = 18}, "Order is 18");
  refused({.order = -2}, "Order is -2");
  refused({.monitor = "enery"}, "one of fixed, energy, energy^1.5, poles, acceleration");
  refused({.h = 0.1}, "Monitor is not set");
  refused({.monitor = "fixed", .h = -0.1}, "Fictive step h is -0.1");
  refused({.monitor = "fixed", .h = nan}, "Fictive step h is nan");
  refused({.checkpoint_seconds = nan}, "Seconds between checkpoints is nan");
  expect_refusal([&] { (void)solve(Kepler(), z, nan, 1e-6); }, "nan");
  auto timeless = z;
  timeless.t = nan;
  expect_refusal([&] { (void)solve(Kepler(), timeless, 1.0, 1e-6); }, "nan");
}

TEST(SolveOptions, MayBeTheEndsOfTheirRanges) {
  const auto outcome = [](double tolerance, const avi::SolveOptions& options = {}) {
    return solve(spring, at(1.0, 0.0), 5.0, tolerance, options).run.outcome;
  };
  using enum avi::Outcome;
  EXPECT_EQ(outcome(1e-2), ok);
  EXPECT_EQ(outcome(1e-13), ok);
  EXPECT_EQ(outcome(1e-3, {.seconds = 0.0}), time_limit);
  EXPECT_EQ(outcome(1e-3, {.sweeps = 1}), step_limit);
  EXPECT_EQ(outcome(1e-3, {.steps = 1}), step_limit);
  EXPECT_EQ(outcome(1e-3, {.order = 2}), ok);
  EXPECT_EQ(outcome(1e-3, {.order = 16}), ok);
  EXPECT_EQ(outcome(1e-3, {.order = 6, .monitor = "splitting"}), ok);
  for (const double tolerance : {0.99e-13, 1.01e-2})
    EXPECT_THROW(outcome(tolerance), std::invalid_argument) << tolerance;
  for (const avi::SolveOptions& beyond :
       {avi::SolveOptions{.seconds = -1e-300}, avi::SolveOptions{.sweeps = 0}, avi::SolveOptions{.order = 1},
        avi::SolveOptions{.order = 8, .monitor = "splitting"}})
    EXPECT_THROW(outcome(1e-3, beyond), std::invalid_argument);
}

// A formula of two hundred thousand operations, whose preparation alone takes longer.
TEST(SolveOptions, BoundTheSecondsOfThePreparationToo) {
  const auto row = [](const auto& q, const auto& p) {
    auto sum = 0.5 * p[0] * p[0];
    for (Eigen::Index i = 1; i < p.size(); ++i)
      sum += 0.5 * p[i] * p[i];
    for (Eigen::Index i = 0; i < q.size(); ++i)
      for (Eigen::Index j = 0; j < i; ++j) {
        const auto x = q[i] - q[j];
        sum += 1.0 / sqrt(1e-2 + x * x);
      }
    return sum;
  };
  const avi::State<avi::dynamic> start{.q = avi::VectorX::LinSpaced(300, -1.0, 1.0),
                                       .p = avi::VectorX::Zero(300)};
  const auto found = solve(row, start, 1.0, 1e-6, {.seconds = 1e-3});
  EXPECT_EQ(found.run.outcome, avi::Outcome::time_limit);
  EXPECT_EQ(found.run.message, "The bound on seconds was met while the run was prepared.");
  EXPECT_TRUE(std::isnan(found.state.q[0]));
}

}  // namespace solve_options_test
