#include "avi/core/ensemble.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/poincare.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using avi::Kepler;
using avi::Member;
using avi::Outcome;
using avi::State;

namespace ensemble_test {

/// g = |q|^2, negative for those who start far out.
struct Monitor {
  template <class Q>
  auto operator()(const Q& q) const {
    const auto square = q[0] * q[0] + q[1] * q[1];
    return square * (9.0 - square);
  }
};

const auto make = [](const State<2>& start) {
  return avi::collocation(avi::poincare(Kepler{}, start, Monitor{}), 8);
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
    const auto members = avi::ensemble(make, z, 0.02, {.time = 10.0}, threads);
    ASSERT_EQ(members.size(), z.size());
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (i == 5) continue;
      State<2> alone = z[i];
      auto method = make(alone);
      const avi::Run run = avi::integrate(method, alone, 0.02, {.time = 10.0});
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
      EXPECT_GE(members[i].state.t, 10.0);
    }
  }
}

TEST(Ensemble, ShowsEachStepOfEachMemberInOrder) {
  const std::vector<State<2>> z(6, Kepler::pericentre(0.3));
  std::vector<long> seen(z.size(), 0);
  std::vector<bool> in_order(z.size(), true);
  const auto members =
      avi::ensemble(make, z, 0.02, {.steps = 50}, 3, [&](std::size_t i, const State<2>&, long k) {
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
  (void)avi::ensemble(make, z, 0.02, {.steps = 1}, 4, observer);
  EXPECT_EQ(ids.size(), 4u);
  ids.clear();
  (void)avi::ensemble(make, z, 0.02, {.steps = 1}, 1, observer);
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
  EXPECT_EQ(refusal([&] { (void)avi::ensemble(make, z, 0.1, {.time = 1.0}, -1); }),
            "Number of threads is -1; it must be at least 0.");
  EXPECT_THROW((void)avi::ensemble(make, z, 0.1, {.time = 1.0}, 0,
                                   [](std::size_t i, const State<2>&, long) {
                                     if (i == 1) throw std::runtime_error("seen enough");
                                   }),
               std::runtime_error);
  EXPECT_TRUE(avi::ensemble(make, std::vector<State<2>>{}, 0.1, {.time = 1.0}).empty());
}

}  // namespace ensemble_test
