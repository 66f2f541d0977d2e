#include "avi/diagnostics/symplecticity.hpp"
#include "bregman/printed/extended_splitting.hpp"
#include "bregman/printed/htvi_printed.hpp"
#include "common/problems/correlated_quartic.hpp"

#include <gtest/gtest.h>

// Symplecticity on extended phase space (q, t, r, r^t), and the printed splitting as the control that fails.

using avi::BregmanFamily;
using avi::ExtendedPoint;
using avi::VectorX;
using experiment::CorrelatedQuartic;

namespace bregman_symplecticity_test {

constexpr Eigen::Index d = 3;
const CorrelatedQuartic f(d, 0.9);

const BregmanFamily families[] = {BregmanFamily::direct(2.0), BregmanFamily::direct(4.0),
                                  BregmanFamily::adaptive(2.0, 1.0), BregmanFamily::adaptive(4.0, 1.0)};

VectorX flat(const ExtendedPoint& z) {
  VectorX v(2 * d + 2);
  v << z.q, z.t, z.r, z.r_t;
  return v;
}

ExtendedPoint point(const VectorX& v) {
  return {.q = v.head(d), .t = v[d], .r = v.segment(d + 1, d), .r_t = v[2 * d + 1]};
}

ExtendedPoint start() {
  return {.q = Eigen::Vector3d(1.3, 0.8, 1.5), .t = 1.2, .r = Eigen::Vector3d(0.2, -0.4, 0.5), .r_t = 0.7};
}

/// Defect of one step at the start; `step` is one of the extended steps.
double defect(const auto& step, const BregmanFamily& family, double h) {
  const auto map = [&](const VectorX& v) -> VectorX {
    ExtendedPoint z = point(v);
    step(family, f, h, z);
    return flat(z);
  };
  return avi::symplecticity_defect(map, flat(start()));
}

const auto htvi = [](auto&&... arguments) { experiment::htvi_printed_step(arguments...); };
const auto three_flow = [](auto&&... arguments) { experiment::three_flow_step(arguments...); };
const auto printed = [](auto&&... arguments) { experiment::splitting_printed_step(arguments...); };

TEST(Symplecticity, HtviAndThreeFlowsAtRoundOffWhateverTheStep) {
  for (const auto& family : families)
    for (double h : {0.005, 0.01, 0.02}) {
      EXPECT_LT(defect(htvi, family, h), 2e-11) << family.p << " " << family.p_ring << " " << h;
      EXPECT_LT(defect(three_flow, family, h), 2e-11) << family.p << " " << family.p_ring << " " << h;
    }
}

TEST(Symplecticity, PrintedSplittingFailsByTheThirdPowerOfTheStep) {
  for (const auto& family : families) {
    const double coarse = defect(printed, family, 0.005), fine = defect(printed, family, 0.0025);
    EXPECT_GT(fine, 1e-9);
    EXPECT_NEAR(std::log2(coarse / fine), 3.0, 0.3) << family.p << " " << family.p_ring;
  }
}

TEST(Symplecticity, PrintedSplittingIsSymplecticInPositionAndMomentum) {
  const auto family = BregmanFamily::adaptive(4.0, 1.0);
  const auto map = [&](const VectorX& v) -> VectorX {
    ExtendedPoint z = start();
    z.q = v.head(d);
    z.r = v.tail(d);
    experiment::splitting_printed_step(family, f, 0.02, z);
    VectorX image(2 * d);
    image << z.q, z.r;
    return image;
  };
  VectorX v(2 * d);
  v << start().q, start().r;
  EXPECT_LT(avi::symplecticity_defect(map, v), 2e-11);
}

}  // namespace bregman_symplecticity_test
