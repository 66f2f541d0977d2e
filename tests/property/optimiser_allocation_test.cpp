// Eigen's own allocations are counted through its assertion, all others through operator new.
namespace {
long allocations = 0;
}
#define EIGEN_RUNTIME_NO_MALLOC
#define eigen_assert(condition)                                                                              \
  do {                                                                                                       \
    if (!(condition)) ++allocations;                                                                         \
  } while (false)

#include "avi/bregman/bregman_cloning.hpp"
#include "avi/bregman/bregman_htvi.hpp"
#include "avi/bregman/bregman_runge_kutta.hpp"
#include "avi/bregman/bregman_splitting.hpp"
#include "avi/optim/adagrad.hpp"
#include "avi/optim/adam.hpp"
#include "avi/optim/gradient_descent.hpp"
#include "avi/optim/nag.hpp"
#include "avi/optim/rmsprop.hpp"
#include "avi/optim/run_updates.hpp"
#include "avi/optim/trust_region.hpp"
#include "avi/problems/correlated_quartic.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using avi::BregmanFamily;
using avi::CorrelatedQuartic;
using avi::VectorX;

namespace {

const CorrelatedQuartic f;

/// Allocations between iterations 2 and 100.
long allocated(const auto& method) {
  long before = 0, after = 0;
  avi::run_updates(f, method, f.start(), {.delta = 0.0, .iterations = 101},
                   [&](const avi::Iterate&, long k, long) {
                     Eigen::internal::set_is_malloc_allowed(k < 2 || k >= 100);
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
  EXPECT_EQ(allocated(avi::BregmanCloning{
                .family = family, .h = h, .composition = avi::CloneComposition::yoshida6}),
            0);
  EXPECT_EQ(allocated(avi::BregmanRungeKutta<avi::ClassicalRungeKutta>{.family = family, .h = h}), 0);
  EXPECT_EQ(allocated(avi::BregmanEmbedded<avi::DormandPrince>{.family = family}), 0);
  EXPECT_EQ(allocated(avi::Nag{.h = 2e-6}), 0);
  EXPECT_EQ(allocated(avi::Adam{}), 0);
  EXPECT_EQ(allocated(avi::AdaGrad{}), 0);
  EXPECT_EQ(allocated(avi::RmsProp{}), 0);
  EXPECT_EQ(allocated(avi::TrustRegion{}), 0);
  EXPECT_EQ(allocated(avi::GradientDescent{.h = 1e-7}), 0);
}

/// The control: a method that makes a temporary on the heap is seen.
struct Wasteful {
  struct State {};
  State start(const avi::Iterate&) const { return {}; }
  template <class F>
  avi::Outcome update(State&, avi::Iterate& now, F&) const {
    const VectorX copy = now.gradient;
    now.x -= 1e-7 * copy;
    now.evaluated = false;
    return avi::Outcome::ok;
  }
};
TEST(Optimisers, AnAllocationWouldBeSeen) { EXPECT_GT(allocated(Wasteful{}), 0); }

}  // namespace
