#include "avi/core/integrate.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/htvi/adjoint.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/n_body.hpp"

#include <gtest/gtest.h>

#include <vector>

// Many bodies, their number known only at run time.

using avi::Generating;
using avi::State;

namespace {

constexpr int dynamic = avi::dynamic;

template <int n>
State<dynamic> run_time(const State<n>& z) {
  return {.q = z.q, .p = z.p, .t = z.t};
}

template <int n>
double gap(const State<n>& a, const State<dynamic>& b) {
  return std::max({(a.q - b.q).norm(), (a.p - b.p).norm() / a.p.norm(), std::abs(a.t - b.t)});
}

/// Masses on a line between walls, coupled by springs with a quadratic term in their force (Fermi, Pasta,
/// Ulam and Tsingou).
struct Chain {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const auto spring = [](const auto& x) { return 0.5 * (x * x) + 0.25 * (x * x * x); };
    auto sum = spring(q[0]) + spring(-q[q.size() - 1]);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      sum += 0.5 * (p[i] * p[i]);
      if (i + 1 < q.size()) sum += spring(q[i + 1] - q[i]);
    }
    return sum;
  }
};

State<dynamic> plucked(int masses) {
  State<dynamic> z{.q = avi::Vector<double, dynamic>(masses), .p = avi::Vector<double, dynamic>(masses)};
  for (int i = 0; i < masses; ++i) {
    z.q[i] = 0.3 * std::sin(M_PI * (i + 1) / (masses + 1));
    z.p[i] = 0.1 * std::cos(3.0 * i);
  }
  return z;
}

auto method_for(const State<dynamic>& start) {
  return avi::htvi_of_order<Generating::type2>(2, avi::poincare<dynamic>(Chain{}, start), avi::gauss(2));
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
