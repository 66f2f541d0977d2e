#include "avi/collocation/stage_equations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace stage_equations_test {

using avi::GaussRule;

/// Starting values from the polynomial of a step of size 1 whose velocity is tau^k at tau in [0, 1], which a
/// rule of more than k stages has exactly, against its integral, or against the start where it leads too far.
/// @return the largest difference
template <int w>
double defect(int stages, int k, double offset, double ratio, int& too_far_ones) {
  using Equations = avi::StageEquations<1, w>;
  const GaussRule rule(stages);
  Equations equations(nullptr, rule);
  avi::StageValues<1, w> step(1);
  avi::Vector<avi::Pack<w>, 1> dq(avi::Pack<w>(0.0)), dp(avi::Pack<w>(0.0));
  for (int j = 0; j < stages; ++j) {
    dq[0].set(j, rule.weight(j) * std::pow(rule.node(j), k));
    dp[0].set(j, -2.0 * rule.weight(j) * std::pow(rule.node(j), k));
  }
  step.start.state = {.q = {0.25}, .p = {-0.5}};
  equations.begin(step, dq, dp, offset, ratio);
  const auto moved_at = [&](int i) {
    const double at = offset + ratio * rule.node(i);
    return (std::pow(at, k + 1) - std::pow(offset, k + 1)) / (k + 1);
  };
  double furthest = 0.0, worst = 0.0;
  for (int i = 0; i < stages; ++i)
    furthest = std::max(furthest, std::abs(moved_at(i)));
  const bool too_far = furthest > Equations::far * avi::largest(dq[0]);
  too_far_ones += too_far;
  for (int i = 0; i < w; ++i) {  // lanes beyond the last stage repeat it
    const double moved = too_far ? 0.0 : moved_at(std::min(i, stages - 1));
    worst = std::max(
        {worst, std::abs(step.q[0][i] - (0.25 + moved)), std::abs(step.p[0][i] - (-0.5 - 2.0 * moved))});
  }
  return worst;
}

TEST(StageEquations, BeginWhereThePolynomialOfAnotherStepLeads) {
  int too_far = 0;
  for (const double offset : {0.0, 1.0})
    for (const double ratio : {1.0, 0.5, 1.25, -0.75}) {
      // Beyond the step Legendre's polynomials grow by this factor from one degree to the next, and rounding
      // with them.
      const double end = std::abs(2.0 * (offset + ratio) - 1.0),
                   growth = end > 1.0 ? end + std::sqrt(end * end - 1.0) : 1.0;
      for (int stages = 1; stages <= 8; ++stages)
        for (int k = 0; k < stages; ++k) {
          const double bound = 2e-15 * std::pow(growth, stages);
          EXPECT_LT(defect<8>(stages, k, offset, ratio, too_far), bound)
              << stages << ", " << k << ", " << offset << ", " << ratio;
          EXPECT_LT(stages > 4 ? 0.0 : defect<4>(stages, k, offset, ratio, too_far), bound)
              << stages << ", " << k;
        }
    }
  EXPECT_GT(too_far, 5);
}

/// The field of H = (q^2 + p^2)/2.
template <int w>
struct Oscillation final : avi::StageField<1, w> {
  using Scalar = avi::Pack<w>;
  using Step = avi::StageValues<1, w>;
  void forces(Step& step, const Scalar& weight) override { step.dp[0] = -weight * step.q[0]; }
  void velocities(Step& step, const Scalar& weight) override { step.dq[0] = weight * step.p[0]; }
  const Scalar& rate(const Step& step) override { return step.rate; }
  [[nodiscard]] double clock(const avi::Vector<double, 1>&, double t) const override { return t; }
  [[nodiscard]] std::unique_ptr<avi::StageField<1, w>> clone() const override {
    return std::make_unique<Oscillation>(*this);
  }
};

// From (1, 0) on: q = cos t, p = -sin t.
TEST(StageEquations, SweepTheNextStepFromWhereThisOneEnds) {
  constexpr int w = 4;
  const GaussRule rule(w);
  const double h = 0.1;
  avi::StageEquations<1, w> equations(std::make_unique<Oscillation<w>>(), rule);
  equations.set_step(h);
  avi::StageValues<1, w> step(1), next(1);
  step.start.state = {.q = {1.0}, .p = {0.0}};
  equations.begin(step);
  // @return the largest distance of a stage from the motion
  const auto error = [&](const avi::StageValues<1, w>& at, double from) {
    double worst = 0.0;
    for (int i = 0; i < w; ++i) {
      const double t = from + h * rule.node(i);
      worst = std::max({worst, std::abs(at.q[0][i] - std::cos(t)), std::abs(at.p[0][i] + std::sin(t))});
    }
    return worst;
  };
  for (int k = 0; k < 20; ++k) {
    equations.forces(step);
    equations.stages(step);
  }
  EXPECT_LT(error(step, 0.0), 5e-10);
  equations.begin_next(step, next);
  EXPECT_LT(error(next, h), 1e-6);
  for (int k = 0; k < 20; ++k)
    equations.sweep_next(step, next);
  EXPECT_LT(error(next, h), 5e-10);
  EXPECT_NEAR(next.start.state.q[0], std::cos(h), 1e-14);
  EXPECT_NEAR(next.start.state.p[0], -std::sin(h), 1e-14);
}

}  // namespace stage_equations_test
