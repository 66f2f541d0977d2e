#include "avi/adaptive/monitors.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/htvi/adjoint.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

#include <vector>

using avi::Generating;
using avi::Kepler;
using avi::State;

namespace {

const Kepler kepler;
const auto monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);

double distance(const State<2>& a, const State<2>& b) {
  return std::max({(a.q - b.q).norm(), (a.p - b.p).norm(), std::abs(a.t - b.t)});
}

/// With monitor, so that time moves unevenly and the on-shell terms are at work.
template <Generating type>
auto monitored(int r, const State<2>& z, const avi::Quadrature& rule = avi::gauss(3)) {
  return avi::htvi_of_order<type, avi::authors>(r, avi::poincare<2>(kepler, z, monitor), rule);
}

template <Generating type>
void expect_adjoint() {
  for (int r : {0, 1, 2, 3, 5, 7})
    for (double h : {0.05, -0.02}) {
      const State<2> start = Kepler::exact(0.6, 0.9);
      auto method = monitored<type>(r, start);
      auto reverse = avi::adjoint(method);
      State<2> z = start;
      ASSERT_EQ(reverse.step(z, h).outcome, avi::Outcome::ok) << r;
      ASSERT_GT(distance(z, start), 1e-3);
      ASSERT_EQ(method.step(z, -h).outcome, avi::Outcome::ok) << r;
      EXPECT_LT(distance(z, start), 1e-14) << r << " " << h;
    }
}

TEST(Adjoint, UndoesTheStepBackwards) {
  expect_adjoint<Generating::type2>();
  expect_adjoint<Generating::type3>();
}

// Without monitor, for separable H and r = 0, Type III with the mirrored rule is the adjoint of Type II;
// for other r the two expand from different points and agree to O(h^(r+2)).
TEST(Adjoint, OfTypeIIIsTypeIIIWithMirroredNodes) {
  const State<2> start = Kepler::exact(0.6, 0.9);
  const auto problem = avi::poincare<2>(kepler, start);
  for (int r : {0, 1, 2, 3}) {
    const auto rule = r == 0 ? avi::rectangle_left() : avi::gauss(3);
    std::vector<double> steps, gaps;
    for (double h : {0.16, 0.08, 0.04}) {
      auto left = avi::adjoint(avi::htvi_of_order<Generating::type2>(r, problem, rule));
      auto right = avi::htvi_of_order<Generating::type3>(r, problem, avi::mirrored(rule));
      State<2> a = start, b = start;
      ASSERT_EQ(left.step(a, h).outcome, avi::Outcome::ok);
      ASSERT_EQ(right.step(b, h).outcome, avi::Outcome::ok);
      steps.push_back(h);
      gaps.push_back(distance(a, b));
    }
    if (r == 0)
      EXPECT_LT(gaps[0], 1e-14);
    else
      EXPECT_GT(avi::fit_order(steps, gaps, {.floor = 1e-15}).order, r + 1.7) << r;
  }
}

TEST(Symmetric, ReturnsWhenTimeIsReversed) {
  for (int r : {0, 2, 3, 6}) {
    State<2> z = Kepler::pericentre(0.6);
    const State<2> start = z;
    auto method = avi::symmetric(monitored<Generating::type2>(r, z));
    auto plain = monitored<Generating::type2>(r, z);
    State<2> control = z;
    for (double h : {0.05, -0.05})
      for (int k = 0; k < 40; ++k) {
        ASSERT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
        ASSERT_EQ(plain.step(control, h).outcome, avi::Outcome::ok);
      }
    EXPECT_LT(distance(z, start), 1e-13) << r;
    if (r < 4) {
      EXPECT_GT(distance(control, start), 1e-8) << "Type II alone does not return";
    }
  }
}

TEST(Symmetric, HasTheNextEvenOrder) {
  for (const auto& [r, expected] : {std::pair{0, 2}, {1, 2}, {2, 4}, {3, 4}, {4, 6}}) {
    std::vector<double> steps, errors;
    for (double h = 0.2; h > 0.02; h /= 1.4) {
      State<2> z = Kepler::pericentre(0.4);
      auto method = avi::symmetric(monitored<Generating::type2>(r, z));
      for (int k = 0; k < std::lround(2.0 / h); ++k)
        ASSERT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
      steps.push_back(h);
      errors.push_back((z.q - Kepler::exact(0.4, z.t).q).norm());
    }
    EXPECT_NEAR(avi::fit_order(steps, errors, {.floor = 1e-12, .at_least = 3, .at_most = 4}).order, expected,
                0.4)
        << r;
  }
}

TEST(Symmetric, IsSymplectic) {
  const State<2> z = Kepler::exact(0.6, 0.9);
  EXPECT_LT(avi::symplecticity_defect(avi::symmetric(monitored<Generating::type2>(2, z)), z, 0.1), 2e-11);
  EXPECT_LT(avi::symplecticity_defect(avi::adjoint(monitored<Generating::type3>(2, z)), z, 0.1), 2e-11);
}

}  // namespace
