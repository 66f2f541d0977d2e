#include "avi/core/at_times.hpp"

#include "avi/avi.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

using avi::Kepler, avi::State;

namespace at_times_test {

std::vector<State<2>> output(double h, double t_end, const std::vector<double>& times) {
  auto z = Kepler::pericentre(0.7);
  auto method = avi::splitting(avi::LogHamiltonian(Kepler{}, z), avi::compositions::kahan_li8);
  auto plain_method = method;
  auto plain = z;
  std::vector<State<2>> seen;
  auto keep = avi::at_times(times, [&](const State<2>& s) { seen.push_back(s); });
  EXPECT_EQ(avi::integrate_to(method, z, h, t_end, keep).outcome, avi::Outcome::ok);
  EXPECT_EQ(avi::integrate_to(plain_method, plain, h, t_end).outcome, avi::Outcome::ok);
  EXPECT_TRUE(z.q == plain.q && z.t == plain.t) << "the run is not touched";
  return seen;
}

TEST(AtTimes, ShowsEachTimeOnce) {
  // Several in a step, one in a step, none in a step; the start and the end among them.
  for (const double sense : {1.0, -1.0}) {
    std::vector<double> times;
    for (const double t : {0.0, 1e-3, 2e-3, 0.5, 0.51, 3.0, 8.0, 9.0})
      times.push_back(sense * t);
    const auto seen = output(sense * 0.3, sense * 9.0, times);
    ASSERT_EQ(seen.size(), times.size());
    for (std::size_t k = 0; k < times.size(); ++k) {
      EXPECT_NEAR(seen[k].t, times[k], 3e-15);
      const auto exact = Kepler::exact(0.7, times[k]);
      EXPECT_LT((seen[k].q - exact.q).norm(), 1e-6) << times[k];
      EXPECT_LT((seen[k].p - exact.p).norm(), 1e-6) << times[k];
    }
  }
}

TEST(AtTimes, LeavesOutWhatLiesBeyondTheEnd) { EXPECT_EQ(output(0.3, 2.0, {1.0, 2.5}).size(), 1u); }

/// Moves in every second step.
struct Hesitant {
  avi::StepReport step(State<2>& z, double h) const {
    z.q[0] += 1.0;
    z.t += std::lround(z.q[0]) % 2 == 0 ? h : 0.0;
    return {};
  }
};

TEST(AtTimes, WaitsWhereTimeStandsStill) {
  for (const double sense : {1.0, -1.0}) {
    Hesitant method;
    State<2> z{.q = {0.0, 0.0}, .p = {0.0, 0.0}};
    int seen = 0;
    const auto run = avi::integrate(method, z, sense, {.steps = 8},
                                    avi::at_times({sense * 1.0, sense * 2.0}, [&](const State<2>& at) {
                                      EXPECT_EQ(at.t, sense * ++seen);
                                    }));
    EXPECT_EQ(run.outcome, avi::Outcome::ok) << run.message;
    EXPECT_EQ(seen, 2);
  }
}

TEST(AtTimes, ActionMayEndTheRun) {
  auto z = Kepler::pericentre(0.7);
  auto method = avi::splitting(avi::LogHamiltonian(Kepler{}, z), avi::compositions::kahan_li8);
  int seen = 0;
  const auto run =
      avi::integrate(method, z, 0.3, {.time = 9.0},
                     avi::at_times({0.0, 1.0, 1.01, 1.02, 5.0}, [&](const State<2>&) { return ++seen < 3; }));
  EXPECT_EQ(run.outcome, avi::Outcome::stopped);
  EXPECT_EQ(seen, 4) << "those of the same step are passed, too";
  EXPECT_LT(z.t, 2.0);
}

TEST(AtTimes, GoesOnWithARunThatItsActionHasEnded) {
  const std::vector<double> times{0.1, 0.2, 1.0};
  auto z = Kepler::pericentre(0.7);
  auto method = avi::splitting(avi::LogHamiltonian(Kepler{}, z), avi::compositions::kahan_li8);
  std::vector<double> seen;
  auto output = avi::at_times(times, [&](const State<2>& s) {
    seen.push_back(s.t);
    return seen.size() != 1;
  });
  EXPECT_EQ(avi::integrate(method, z, 1.0, {.time = 2.0}, output).outcome, avi::Outcome::stopped);
  ASSERT_GT(z.t, times[1]) << "one step passes both";
  EXPECT_TRUE(avi::integrate(method, z, 0.1, {.time = 2.0}, output).ok());
  EXPECT_EQ(seen, times);
}

TEST(AtTimes, RefusesTimesOutOfOrder) {
  const auto make = [](std::vector<double> times) { (void)avi::at_times(times, [](const State<2>&) {}); };
  EXPECT_THROW(make({1.0, 0.5, 2.0}), std::invalid_argument);
  EXPECT_THROW(make({1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(make({3.0, 2.0, 2.5}), std::invalid_argument);
  EXPECT_THROW(make({0.0, NAN}), std::invalid_argument);
  EXPECT_THROW(make({INFINITY}), std::invalid_argument);
  EXPECT_THROW(output(0.3, 2.0, {-1.0, 1.0}), std::invalid_argument);
}

TEST(AtTimes, AcceptsTimesAsNearAsNumbersAre) {
  for (const double sense : {1.0, -1.0}) {
    const std::vector<double> times{0.0, sense * 1e-300, sense * 2e-300};
    const auto seen = output(sense * 0.3, sense * 2.0, times);
    ASSERT_EQ(seen.size(), 3u);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(seen[k].t, times[k]);
  }
}

TEST(AtTimes, BlamesTheOrderOfTimesNotTheStart) {
  expect_refusal([] { (void)output(0.3, 2.0, {1.5, 0.5}); }, "beyond the one before it");
  expect_refusal([] { (void)output(-0.3, -2.0, {-1.5, -0.5}); }, "beyond the one before it");
  expect_refusal([] { (void)output(0.3, 2.0, {-1.0, 1.0}); }, "not before the start");
}

}  // namespace at_times_test
