#include "avi/problems/henon_heiles.hpp"
#include "avi/solve.hpp"
#include "resumed.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <sys/stat.h>
#include <sys/wait.h>

namespace checkpoint_test {

using avi::HenonHeiles, avi::State, systems::pendulum;

const State<2> start{.q = {0.0, 0.3}, .p = {0.45, 0.0}};
const double end = 30000.0;

std::string file_named(const std::string& name) {
  static const Scratch folder;
  return folder / name;
}
avi::SolveOptions options(const std::string& file) {
  return {.check = false,
          .order = 8,
          .monitor = "fixed",
          .h = 0.4,
          .dense = true,
          .events = {avi::when([](const auto& q, const auto&) { return q[0]; }, {.direction = 1})},
          .checkpoint = file,
          .checkpoint_seconds = 0.0};
}
const std::vector<double> times{100.0, 15000.0, 20000.0, end};

TEST(Checkpoint, OfARunThatMetABoundGoesOnWithTheSameBits) {
  const std::string file = file_named("bound");
  const auto whole = avi::solve(HenonHeiles(), start, times, 1e-8, options(file));
  ASSERT_TRUE(whole.ok()) << whole.report();
  EXPECT_FALSE(std::filesystem::exists(file));
  auto bounded = options(file);
  bounded.steps = 50000;
  const auto part = avi::solve(HenonHeiles(), start, times, 1e-8, bounded);
  EXPECT_EQ(part.run.outcome, avi::Outcome::step_limit);
  EXPECT_EQ(part.run.steps, 50000);
  EXPECT_EQ(part.states.size(), 3u);
  ASSERT_TRUE(std::filesystem::exists(file));
  bounded.steps = 60000;
  const auto more = avi::resume<2>(HenonHeiles(), file, bounded);
  EXPECT_EQ(more.run.steps, 60000);
  const auto rest = avi::resume<2>(HenonHeiles(), file, options(file));
  expect_same(whole, rest);
  EXPECT_EQ(rest.energy_error, whole.energy_error);
  // What the bound forbade to find out is not known.
  EXPECT_FALSE(rest.kept());
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// The distance in Kepler's problem with unit angular momentum.
const auto distance = [](const auto& q, const auto& p) {
  return 0.5 * p[0] * p[0] + 0.5 / (q[0] * q[0]) - 1.0 / q[0];
};
const auto disturbed = [](const auto& q, const auto& t, const auto& p) {
  return distance(q, p) + 0.01 * q[0] * cos(0.3 * t);
};

TEST(Checkpoint, OfEveryMonitorGoesOnWithTheSameBits) {
  const State<1> near{.q = {0.6}, .p = {0.0}};
  const auto goes_on = [&](const auto& h, const avi::SolveMonitor& monitor) {
    const double step = avi::solve(h, near, 200.0, 1e-8, {.check = false, .monitor = monitor}).choice.h;
    expect_to_go_on(h, near, 2000.0, 1e-8, {.check = false, .monitor = monitor, .h = step}, 300);
  };
  for (const char* const name : {"fixed", "energy", "energy^1.5", "poles", "acceleration", "splitting"})
    goes_on(distance, name);
  goes_on(disturbed, "energy");
  goes_on(distance, avi::SolveMonitor([](const auto& q) { return q[0]; }));
  goes_on(disturbed,
          avi::SolveMonitor([](const auto& q, const auto& t, const auto&) { return q[0] + 0.0 * t; }));
}

/// An oscillator whose gradient is a little wrong.
struct Wrong {
  double by;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return 0.5 * (p[0] * p[0] + q[0] * q[0]);
  }
  template <class Q, class P>
  auto d_dq(const Q& q, const P&) const -> Q {
    return Q(q * by);
  }
  template <class Q, class P>
  auto d_dp(const Q&, const P& p) const -> P {
    return p;
  }
};

TEST(Checkpoint, OfAnotherGradientIsRefused) {
  const std::string file = file_named("gradient");
  const State<1> z{.q = {1.0}, .p = {0.0}};
  avi::SolveOptions some{.check = false, .steps = 300, .monitor = "fixed", .h = 0.1, .checkpoint = file};
  some.order = 8;
  (void)avi::solve(Wrong{1.0000001}, z, 1e3, 1e-6, some);
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_THROW((void)avi::resume<1>(Wrong{1.000001}, file, {}), std::invalid_argument);
  EXPECT_TRUE(avi::resume<1>(Wrong{1.0000001}, file, {}).ok());
}

// What an earlier call left is not taken for the run of one that was stopped before its own began.
TEST(Checkpoint, IsNotOfAnEarlierCall) {
  const std::string file = file_named("stale");
  auto bounded = options(file);
  bounded.steps = 5000;
  (void)avi::solve(HenonHeiles(), start, times, 1e-8, bounded);
  ASSERT_TRUE(std::filesystem::exists(file));
  // The callback is told of each phase when that begins, however quick it is.
  avi::SolveOptions stopped{.progress = [](const avi::SolveProgress&) { return false; }, .checkpoint = file};
  EXPECT_EQ(avi::solve(HenonHeiles(), start, 1e6, 1e-6, stopped).run.outcome, avi::Outcome::stopped);
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(avi::resume<2>(HenonHeiles(), file, {.steps = 5000}).tolerance, 1e-6);
}

// Where an event is not met that a choice was made for, another one is made, with an interruption as without.
TEST(Checkpoint, BeforeAnEventThatDoesNotComeGoesOnAsWithout) {
  const double turn = std::acos(0.5) + 1e-6;
  const std::string file = file_named("horizon");
  avi::SolveOptions all{
      .events = {avi::when([=](const auto& q, const auto&) { return q[0] - turn; }, {.stop = true})},
      .checkpoint = file};
  avi::SolveOptions stopped = all;
  stopped.progress = [](const avi::SolveProgress& now) { return now.phase != avi::SolvePhase::running; };
  const State<1> z{.q = {0.0}, .p = {1.0}};
  const auto whole = avi::solve(pendulum, z, 2e4, 1e-9, all);
  (void)avi::solve(pendulum, z, 2e4, 1e-9, stopped);
  ASSERT_TRUE(std::filesystem::exists(file));
  const auto rest = avi::resume<1>(pendulum, file, all);
  EXPECT_EQ(rest.state, whole.state);
  EXPECT_EQ(rest.choice.h, whole.choice.h);
  EXPECT_EQ(rest.kept(), whole.kept());
}

// What was asked for is in the file, and a bound that the first look for the event meets changes nothing of
// it.
TEST(Checkpoint, BeforeAnEventGoesOnWithWhatWasAskedFor) {
  const std::string file = file_named("asked");
  const State<1> z{.q = {0.0}, .p = {1.9}};
  avi::SolveOptions all{
      .check = false,
      .order = 8,
      .monitor = "fixed",
      .h = 0.05,
      .events = {avi::when([](const auto& q, const auto&) { return q[0]; }, {.count = 60, .stop = true})},
      .checkpoint = file};
  const auto whole = avi::solve(pendulum, z, 1e5, 1e-8, all);
  avi::SolveOptions some = all;
  some.steps = 1000;
  (void)avi::solve(pendulum, z, 1e5, 1e-8, some);
  const auto rest = avi::resume<1>(pendulum, file, {.events = all.events});
  EXPECT_EQ(rest.choice.order, 8);
  EXPECT_EQ(rest.choice.h, 0.05);
  EXPECT_EQ(rest.choice.name, "fixed");
  EXPECT_EQ(rest.run.steps, whole.run.steps);
  EXPECT_NEAR(rest.state.t, whole.state.t, 1e-11);
}

// Seconds of a run with a file over those of one without, where nothing is written but its beginning.
TEST(Checkpoint, OfADenseRunCostsNoSquareOfItsSteps) {
  avi::SolveOptions dense{.check = false, .order = 8, .monitor = "fixed", .h = 0.4, .dense = true};
  avi::SolveOptions kept = dense;
  kept.checkpoint = file_named("dense");
  const auto seconds = [](const avi::SolveOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    (void)avi::solve(HenonHeiles(), start, 4e5, 1e-8, options);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const double without = std::min(seconds(dense), seconds(dense));
  EXPECT_LE(std::min(seconds(kept), seconds(kept)), 1.5 * without);
}

TEST(Checkpoint, IsNothingButAFile) {
  const std::string pipe = file_named("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW((void)avi::solve(HenonHeiles(), start, times, 1e-8, options(pipe)), std::invalid_argument);
  EXPECT_THROW((void)avi::resume<2>(HenonHeiles(), pipe, options(pipe)), std::invalid_argument);
  EXPECT_EQ(std::filesystem::status(pipe).type(), std::filesystem::file_type::fifo);
  std::filesystem::remove(pipe);
}

TEST(Checkpoint, OfAKilledProcessGoesOnWithTheSameBits) {
  const std::string file = file_named("killed");
  const auto whole = avi::solve(HenonHeiles(), start, times, 1e-8, options(file));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto bounded = options(file);
    bounded.steps = 50000;
    (void)avi::solve(HenonHeiles(), start, times, 1e-8, bounded);
    // Told when the run begins, which is after the file is written anew.
    auto fatal = options(file);
    fatal.progress = [](const avi::SolveProgress&) -> bool { return std::raise(SIGKILL) == 0; };
    (void)avi::resume<2>(HenonHeiles(), file, fatal);
    std::_Exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(std::filesystem::exists(file));
  const auto rest = avi::resume<2>(HenonHeiles(), file, options(file));
  expect_same(whole, rest);
  EXPECT_EQ(rest.energy_error, whole.energy_error);
}

TEST(Checkpoint, IsRefusedWhereItIsDamagedOrOfSomethingElse) {
  const std::string file = file_named("damaged");
  auto bounded = options(file);
  bounded.steps = 5000;
  (void)avi::solve(HenonHeiles(), start, times, 1e-8, bounded);
  const auto refused = [&](const auto& h, const avi::SolveOptions& with) {
    EXPECT_THROW((void)avi::resume<2>(h, file, with), std::invalid_argument);
  };
  refused(HenonHeiles(), {});  // without its event
  refused([](const auto& q, const auto& p) { return p[0] * p[0] + p[1] * p[1] + q[0] * q[1]; },
          options(file));
  const auto size = std::filesystem::file_size(file);
  {
    std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
    bytes.seekp(static_cast<std::streamoff>(size / 2));
    bytes.put('x');
  }
  refused(HenonHeiles(), options(file));
  std::filesystem::resize_file(file, size - 8);
  refused(HenonHeiles(), options(file));
  std::filesystem::resize_file(file, 4);
  refused(HenonHeiles(), options(file));
  std::filesystem::remove(file);
  refused(HenonHeiles(), options(file));
}

TEST(Checkpoint, LeavesNoHalfWrittenFileWhereTheCallbackThrows) {
  const std::string file = file_named("thrown");
  auto throwing = options(file);
  throwing.progress = [](const avi::SolveProgress&) -> bool { throw std::domain_error("enough"); };
  EXPECT_THROW((void)avi::solve(HenonHeiles(), start, times, 1e-8, throwing), std::domain_error);
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
  EXPECT_THROW((void)avi::solve(HenonHeiles(), start, times, 1e-8, options("/nowhere/at/all")),
               std::runtime_error);
}

}  // namespace checkpoint_test
