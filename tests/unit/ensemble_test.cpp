#include "avi/core/ensemble.hpp"

#include "avi/avi.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <vector>

using avi::Kepler, avi::Outcome, avi::State;

namespace ensemble_test {

/// g = |q|^2, negative for those who start far out.
const auto monitor = [](const auto& q) {
  const auto square = q[0] * q[0] + q[1] * q[1];
  return square * (9.0 - square);
};

const auto make = [](const State<2>& start) {
  return avi::collocation(avi::poincare(Kepler{}, start, monitor), 8);
};

std::vector<State<2>> starts() {
  std::vector<State<2>> z;
  for (int i = 0; i < 9; ++i)
    z.push_back(Kepler::pericentre(0.05 * i));
  z[2].q = {4.0, 0.0};                                   // the monitor is negative
  z[5].p[0] = std::numeric_limits<double>::quiet_NaN();  // H is not finite there
  return z;
}

void expect_same(const State<2>& a, const State<2>& b, std::size_t i) {
  EXPECT_TRUE(a.q == b.q) << i;
  EXPECT_TRUE(a.p == b.p || a.p != a.p) << i;
  EXPECT_EQ(a.t, b.t) << i;
}

TEST(Ensemble, MembersAreSingleRunsToTheLastBit) {
  const auto z = starts();
  for (int threads : {0, 1, 2, 20}) {
    const auto members = avi::ensemble(make, z, 0.02, {.time = 10.0}, {.threads = threads});
    ASSERT_EQ(members.size(), z.size());
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (i == 5) continue;
      State<2> alone = z[i];
      auto method = make(alone);
      const avi::Run run = avi::integrate_to(method, alone, 0.02, 10.0);
      expect_same(members[i].state, alone, i);
      EXPECT_EQ(members[i].run.outcome, run.outcome) << i;
      EXPECT_EQ(members[i].run.steps, run.steps) << i;
      EXPECT_EQ(members[i].run.evaluations, run.evaluations) << i;
      EXPECT_EQ(members[i].run.message, run.message) << i;
    }
  }
}

TEST(Ensemble, OneThatFailsSpoilsNoOther) {
  const auto z = starts();
  const auto members = avi::ensemble(make, z, 0.02, {.time = 10.0});
  for (std::size_t i = 0; i < z.size(); ++i) {
    const avi::Run& run = members[i].run;
    if (i == 2) {
      EXPECT_EQ(run.outcome, Outcome::bad_monitor);
    } else if (i == 5) {
      EXPECT_EQ(run.outcome, Outcome::stopped);
      EXPECT_EQ(run.steps, 0);
      EXPECT_TRUE(run.message.starts_with("At the start p[0] is nan")) << run.message;
    } else {
      EXPECT_EQ(run.outcome, Outcome::ok) << run.message;
      EXPECT_EQ(members[i].state.t, 10.0);
    }
  }
}

TEST(Ensemble, ShowsEachStepOfEachMemberInOrder) {
  const std::vector<State<2>> z(6, Kepler::pericentre(0.3));
  std::vector<long> seen(z.size(), 0);
  std::vector<bool> in_order(z.size(), true);
  const auto members = avi::ensemble(make, z, 0.02, {.steps = 50}, {.threads = 3},
                                     [&](std::size_t i, const State<2>&, long k) {
                                       if (k != seen[i] + 1) in_order[i] = false;
                                       seen[i] = k;
                                       return k < 10 * static_cast<long>(i + 1);
                                     });
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_TRUE(in_order[i]);
    EXPECT_EQ(seen[i], std::min(50L, 10 * static_cast<long>(i + 1)));
    EXPECT_EQ(members[i].run.outcome, i < 5 ? Outcome::stopped : members[5].run.outcome);
  }
}

TEST(Ensemble, UsesTheThreadsAskedFor) {
  const std::vector<State<2>> z(64, Kepler::pericentre(0.3));
  std::mutex mutex;
  std::set<std::thread::id> ids;
  const auto observer = [&](std::size_t, const State<2>&, long) {
    {
      const std::lock_guard lock(mutex);
      ids.insert(std::this_thread::get_id());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that others get their turn
  };
  (void)avi::ensemble(make, z, 0.02, {.steps = 1}, {.threads = 4}, observer);
  EXPECT_EQ(ids.size(), 4u);
  ids.clear();
  (void)avi::ensemble(make, z, 0.02, {.steps = 1}, {.threads = 1}, observer);
  EXPECT_EQ(ids.size(), 1u);
  ids.clear();
  const auto noted = [&](const State<2>& start) {
    observer(0, start, 0);
    return make(start);
  };
  (void)avi::ensemble(noted, z, 0.02, {.steps = 1});
  EXPECT_EQ(ids.size(), std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, z.size()));
}

TEST(Ensemble, RefusesWhatIntegrateRefuses) {
  const std::vector<State<2>> z(3, Kepler::pericentre(0.3));
  EXPECT_THROW((void)avi::ensemble(make, z, 0.0, {.time = 1.0}), std::invalid_argument);
  EXPECT_THROW((void)avi::ensemble(make, z, 0.1, {}), std::invalid_argument);
  EXPECT_EQ(refusal([&] { (void)avi::ensemble(make, z, 0.1, {.time = 1.0}, {.threads = -1}); }),
            "Number of threads is -1; it must be at least 0.");
  const std::vector<double> two{0.1, 0.2}, zero{0.1, 0.0, 0.1};
  EXPECT_EQ(refusal([&] { (void)avi::ensemble(make, z, two, {.time = 1.0}); }),
            "Number of steps is 2; it must be that of the starts, 3.");
  EXPECT_EQ(refusal([&] { (void)avi::ensemble(make, z, zero, {.time = 1.0}); }),
            "Step size h is 0; it must be finite and not zero.");
  EXPECT_THROW((void)avi::ensemble(make, std::vector<State<2>>{}, 0.1, {}), std::invalid_argument);
  EXPECT_TRUE(avi::ensemble(make, std::vector<State<2>>{}, 0.1, {.time = 1.0}).empty());
}

TEST(Ensemble, ReportsWhatIsThrownAndGoesOn) {
  const std::vector<State<2>> z(5, Kepler::pericentre(0.3));
  State<2> first = z[0];
  ASSERT_TRUE(make(first).step(first, 0.1).ok());
  const auto members =
      avi::ensemble(make, z, 0.1, {.time = 1.0}, {.threads = 2}, [](std::size_t i, const State<2>&, long k) {
        if (i == 1 && k == 1) throw std::runtime_error("seen enough");
        if (i == 3) throw 7;
      });
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_EQ(members[i].ok(), i % 2 == 0) << i;
    // The last good state: that after the first step, where something is thrown then.
    EXPECT_EQ(members[i].state.t, i % 2 == 0 ? 1.0 : first.t) << i;
    EXPECT_EQ(members[i].error != nullptr, i % 2 == 1) << i;
  }
  EXPECT_EQ(members[1].run.outcome, Outcome::stopped);
  EXPECT_EQ(members[1].run.message, "seen enough");
  EXPECT_THROW(std::rethrow_exception(members[1].error), std::runtime_error);
  EXPECT_EQ(members[3].run.message, "Something was thrown that is no std::exception.");
}

TEST(Ensemble, RefusesAStartWithoutATimeAlone) {
  std::vector<State<2>> z(3, Kepler::pericentre(0.3));
  z[1].t = std::numeric_limits<double>::quiet_NaN();
  const auto plain = [](const State<2>&) {
    return avi::splitting(avi::LogHamiltonian(Kepler{}, Kepler::pericentre(0.3)),
                          avi::compositions::kahan_li8);
  };
  for (const avi::Until until : {avi::Until{.time = 1.0}, avi::Until{.steps = 10}}) {
    const auto members = avi::ensemble(plain, z, 0.1, until);
    EXPECT_TRUE(members[0].ok() && members[2].ok());
    EXPECT_EQ(members[1].run.outcome, Outcome::stopped);
    EXPECT_EQ(members[1].run.message, "Time of the start is nan; it must be finite.");
  }
}

TEST(Ensemble, TakesAStepForEachMember) {
  const auto z = starts();
  std::vector<double> sizes;
  for (std::size_t i = 0; i < z.size(); ++i)
    sizes.push_back(0.01 * static_cast<double>(i + 1));
  const auto by_list = avi::ensemble(make, z, sizes, {.time = 3.0});
  const auto of_start = [&](const State<2>& start) {
    if (start.q[0] > 3.0) return 0.03;
    return start.p[0] != start.p[0] ? 0.0 : 0.01 * (1.0 + std::round((1.0 - start.q[0]) / 0.05));
  };
  const auto by_function = avi::ensemble(make, z, of_start, {.time = 3.0});
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (i == 2 || i == 5) continue;
    State<2> alone = z[i];
    auto method = make(alone);
    EXPECT_TRUE(avi::integrate_to(method, alone, sizes[i], 3.0).ok());
    expect_same(by_list[i].state, alone, i);
    expect_same(by_function[i].state, alone, i);
  }
}

TEST(Ensemble, HasOutputTimesEventsAndTrajectoriesOfEachMember) {
  const std::vector<double> times{0.5, 1.0, 2.5, 3.0};
  std::vector<State<2>> z;
  for (int i = 0; i < 6; ++i)
    z.push_back(Kepler::pericentre(0.1 * i));
  const avi::Event apse{[](const State<2>& at) { return at.q.dot(at.p); }, avi::Crossing::falling};
  const auto watch = [&](int threads) {
    std::vector<std::vector<State<2>>> seen(z.size());
    std::vector<double> apses(z.size(), 0.0);
    std::vector<avi::Trajectory<2>> paths(z.size());
    std::vector<long> steps(z.size(), 0);
    const auto members = avi::ensemble(
        make, z, 0.02, {.time = 4.0}, {.threads = threads},
        [&](std::size_t i) {
          return avi::at_times(times, [&, i](const State<2>& at) { seen[i].push_back(at); });
        },
        [&](std::size_t i) { return avi::on_event(apse, [&, i](const State<2>& at) { apses[i] = at.t; }); },
        [&](std::size_t i) -> auto& { return paths[i]; },
        [&](std::size_t i, const auto& step, long k) requires requires { step.before; } {
          steps[i] = step.h > 0.0 ? k : 0;
        });
    for (std::size_t i = 0; i < z.size(); ++i) {
      EXPECT_TRUE(members[i].ok()) << members[i].run.message;
      EXPECT_EQ(members[i].state.t, 4.0);
      EXPECT_EQ(seen[i].size(), times.size());
      for (std::size_t k = 0; k < seen[i].size(); ++k)
        EXPECT_EQ(seen[i][k].t, times[k]);
      EXPECT_NEAR(apses[i], i > 0 ? M_PI : 0.0, i > 0 ? 1e-6 : 4.0) << i;
      EXPECT_EQ(paths[i].states().size(), static_cast<std::size_t>(members[i].run.steps) + 1);
      EXPECT_EQ(steps[i], members[i].run.steps);
    }
    return seen;
  };
  const auto one = watch(1), three = watch(3);
  for (std::size_t i = 0; i < z.size(); ++i)
    for (std::size_t k = 0; k < times.size(); ++k)
      expect_same(one[i][k], three[i][k], i);
}

TEST(Ensemble, TellsItsProgressAndCanBeCancelled) {
  const std::vector<State<2>> z(20, Kepler::pericentre(0.3));
  for (const int threads : {1, 4}) {
    std::vector<std::size_t> done;
    std::stop_source stop;
    const auto members = avi::ensemble(make, z, 0.02, {.time = 1.0},
                                       {.threads = threads,
                                        .progress =
                                            [&](std::size_t now, std::size_t all) {
                                              EXPECT_EQ(all, z.size());
                                              done.push_back(now);
                                              if (now == 8) stop.request_stop();
                                            },
                                        .cancel = stop.get_token()});
    ASSERT_EQ(done.size(), z.size());
    for (std::size_t k = 0; k < done.size(); ++k)
      EXPECT_EQ(done[k], k + 1);
    std::size_t ended = 0;
    for (const auto& member : members) {
      ended += member.ok();
      EXPECT_EQ(member.run.outcome, member.ok() ? Outcome::ok : Outcome::stopped);
    }
    EXPECT_GE(ended, 8u);
    EXPECT_LT(ended, 8u + static_cast<std::size_t>(threads));
    EXPECT_EQ(members.back().run.message, "The ensemble was cancelled before this run began.");
  }
  // One long run is cancelled from within.
  std::stop_source stop;
  const auto members = avi::ensemble(make, std::vector{z[0]}, 0.02, {.time = 1e6},
                                     {.cancel = stop.get_token()}, [&](std::size_t, const State<2>&, long k) {
                                       if (k == 10) stop.request_stop();
                                     });
  EXPECT_EQ(members[0].run.outcome, Outcome::stopped);
  EXPECT_EQ(members[0].run.steps, 10);
}

}  // namespace ensemble_test
