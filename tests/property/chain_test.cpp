#include "avi/core/integrate.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/htvi/adjoint.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/chain.hpp"
#include "avi/problems/n_body.hpp"
#include "property/run_time.hpp"

#include <gtest/gtest.h>

#include <vector>

// Many bodies, their number known only at run time.

using avi::Chain;
using avi::dynamic;
using avi::Generating;
using avi::State;

namespace {

/// In motion, too.
State<dynamic> plucked(int masses) {
  auto z = Chain::plucked(masses);
  for (int i = 0; i < masses; ++i)
    z.p[i] = 0.1 * std::cos(3.0 * i);
  return z;
}

auto method_for(const State<dynamic>& start) {
  return avi::htvi_of_order<Generating::type2>(2, avi::poincare<dynamic>(avi::Automatic<Chain>{}, start),
                                               avi::gauss(2));
}

TEST(Chain, IsFollowedSymplecticallyAtItsOrder) {
  for (int masses : {1, 5}) {  // 2 and 10 partials: one chunk of them and two
    const auto start = plucked(masses);
    EXPECT_LT(avi::symplecticity_defect(method_for(start), start, 0.2), 2e-11) << masses;
    std::vector<double> steps, errors;
    State<dynamic> finest = start;
    for (int n : {320, 20, 40, 80}) {
      auto z = start;
      auto method = method_for(start);
      ASSERT_EQ(avi::integrate(method, z, 2.0 / n, {.steps = n}).outcome, avi::Outcome::ok);
      if (n == 320) {
        finest = z;
        continue;
      }
      steps.push_back(2.0 / n);
      errors.push_back(std::hypot((z.q - finest.q).norm(), (z.p - finest.p).norm()));
    }
    EXPECT_GT(avi::fit_order(steps, errors).order, 3.5) << masses;
  }
}

// Formulas of more operations than the tape has slots at first: it grows.
TEST(Chain, OfManyMassesKeepsItsEnergy) {
  auto z = plucked(18);
  const double energy = Chain{}(z.q, z.p);
  auto method = method_for(z);
  ASSERT_EQ(avi::integrate(method, z, 0.05, {.time = 1.0}).outcome, avi::Outcome::ok);
  EXPECT_NEAR(Chain{}(z.q, z.p), energy, 3e-8);
}

TEST(Chain, ComposesSymmetrically) {
  const auto start = plucked(5);
  auto z = start;
  auto method = avi::symmetric(method_for(start));
  for (double h : {0.2, -0.2})
    for (int k = 0; k < 10; ++k)
      ASSERT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
  EXPECT_LT(std::max((z.q - start.q).norm(), (z.p - start.p).norm()), 1e-14);
}

TEST(FigureEight, IsTheSameAtBothKindsOfDimension) {
  auto fixed = avi::FigureEight::start();
  auto free = run_time(fixed);
  auto a = avi::htvi_of_order<Generating::type2>(5, avi::poincare<6>(avi::FigureEight::problem(), fixed),
                                                 avi::gauss(3));
  auto b = avi::htvi_of_order<Generating::type2>(
      5, avi::poincare<dynamic>(avi::FigureEight::problem<dynamic>(), free), avi::gauss(3));
  for (int k = 0; k < 60; ++k) {
    ASSERT_EQ(a.step(fixed, 0.1).outcome, avi::Outcome::ok);
    ASSERT_EQ(b.step(free, 0.1).outcome, avi::Outcome::ok);
  }
  EXPECT_LT(gap(fixed, free), 1e-12);
}

TEST(Chain, SuppliesTheGradientOfItsEnergy) {
  const avi::Vector<double, 5> q = plucked(5).q, p = plucked(5).p;
  const Chain chain;
  EXPECT_LT((chain.d_dq(q, p) - avi::d_dq(avi::Automatic<Chain>{}, q, p)).norm(), 1e-15);
  EXPECT_LT((chain.d_dp(q, p) - avi::d_dp(avi::Automatic<Chain>{}, q, p)).norm(), 1e-15);
}

TEST(Chain, RefusesAStateOfAnotherSize) {
  auto method = method_for(plucked(5));
  auto z = plucked(4);
  try {
    method.step(z, 0.1);
    FAIL() << "a state of four entries went into a problem of five";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "Dimension of the state is 4; it must be that of the problem, 5, for q and p alike.");
  }
}

}  // namespace
