#include "avi/bregman/bregman_htvi.hpp"
#include "avi/bregman/bregman_splitting.hpp"
#include "avi/optim/run_updates.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "common/rules/bregman_cloning.hpp"
#include "common/rules/bregman_runge_kutta.hpp"
#include "common/rules/update_rules.hpp"

#include "allocations.hpp"

#include <gtest/gtest.h>

#include <vector>

using avi::BregmanFamily, avi::VectorX, experiment::CorrelatedQuartic;

namespace optimiser_allocation_test {

const CorrelatedQuartic f;

/// Allocations between iterations 2 and 100.
long allocated(const auto& method) {
  long before = 0, after = 0;
  avi::run_updates(f, method, f.start(), {.delta = 0.0, .iterations = 101},
                   [&](const avi::Iterate&, long k, long) {
                     if (k == 2) before = allocations;
                     if (k == 100) after = allocations;
                   });
  return after - before;
}

TEST(Optimisers, AllocateNothingInTheLoop) {
  const auto family = BregmanFamily::adaptive(4.0, 1.0);
  const double h = 1e-4;
  EXPECT_EQ(allocated(avi::BregmanHtvi{.family = family, .h = h}), 0);
  EXPECT_EQ(allocated(avi::BregmanSplitting{.family = family, .h = h}), 0);
  EXPECT_EQ(allocated(experiment::BregmanCloning{
                .family = family, .h = h, .composition = experiment::CloneComposition::yoshida6}),
            0);
  EXPECT_EQ(allocated(experiment::BregmanRungeKutta<avi::ClassicalRungeKutta>{.family = family, .h = h}), 0);
  EXPECT_EQ(allocated(experiment::BregmanEmbedded<avi::DormandPrince>{.family = family}), 0);
  EXPECT_EQ(allocated(experiment::Nag{.h = 2e-6}), 0);
  EXPECT_EQ(allocated(experiment::Adam{}), 0);
  EXPECT_EQ(allocated(experiment::AdaGrad{}), 0);
  EXPECT_EQ(allocated(experiment::RmsProp{}), 0);
  EXPECT_EQ(allocated(experiment::TrustRegion{}), 0);
  EXPECT_EQ(allocated(experiment::GradientDescent{.h = 1e-7}), 0);
}

/// The control: a method that makes a temporary on the heap is seen.
struct Wasteful {
  struct State {};
  State start(const avi::Iterate&) const { return {}; }
  template <class F>
  avi::Outcome update(State&, avi::Iterate& now, F&) const {
    const std::vector<double> copy(now.gradient.begin(), now.gradient.end());
    now.x -= 1e-7 * VectorX::Map(copy.data(), now.x.size());
    now.evaluated = false;
    return avi::Outcome::ok;
  }
};
TEST(Optimisers, AnAllocationWouldBeSeen) { EXPECT_GT(allocated(Wasteful{}), 0); }

}  // namespace optimiser_allocation_test
