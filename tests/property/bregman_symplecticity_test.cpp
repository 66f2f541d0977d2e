#include "bregman/printed/extended_splitting.hpp"
#include "bregman/printed/htvi_printed.hpp"
#include "framework/step_defects.hpp"

#include <gtest/gtest.h>

// Symplecticity on extended phase space (q, t, r, r^t), and the printed splitting as the control that fails.

using avi::BregmanFamily;

namespace bregman_symplecticity_test {

using namespace experiment;

const BregmanFamily families[] = {BregmanFamily::direct(2.0), BregmanFamily::direct(4.0),
                                  BregmanFamily::adaptive(2.0, 1.0), BregmanFamily::adaptive(4.0, 1.0)};

TEST(Symplecticity, HtviAndThreeFlowsAtRoundOffWhateverTheStep) {
  for (const auto& family : families)
    for (double h : {0.005, 0.01, 0.02}) {
      EXPECT_LT(bregman_defect(htvi_printed_step, family, h), 2e-11)
          << family.p << " " << family.p_ring << " " << h;
      EXPECT_LT(bregman_defect(three_flow_step, family, h), 2e-11)
          << family.p << " " << family.p_ring << " " << h;
    }
}

TEST(Symplecticity, PrintedSplittingFailsByTheThirdPowerOfTheStep) {
  for (const auto& family : families) {
    const double coarse = bregman_defect(splitting_printed_step, family, 0.005),
                 fine = bregman_defect(splitting_printed_step, family, 0.0025);
    EXPECT_GT(fine, 1e-9);
    EXPECT_NEAR(std::log2(coarse / fine), 3.0, 0.3) << family.p << " " << family.p_ring;
  }
}

TEST(Symplecticity, PrintedSplittingIsSymplecticInPositionAndMomentum) {
  const auto family = BregmanFamily::adaptive(4.0, 1.0);
  EXPECT_LT(bregman_defect(splitting_printed_step, family, 0.02, true), 2e-11);
}

}  // namespace bregman_symplecticity_test
