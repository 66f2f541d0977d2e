// data: cloning_sign
#include "scorecard/claims.hpp"

#include <gtest/gtest.h>

namespace {

TEST(CloningSign, CopiesStayTogetherForTheMeantSignOnly) {
  const auto finding =
      scorecard::dynamics_decisions().at("cloning_equations")(scorecard::Results({AVI_CHECK_DIR "/data"}));
  EXPECT_EQ(finding.ruling, scorecard::Ruling::fails) << finding.evidence;

  const auto data = avi::Table::read(AVI_CHECK_DIR "/data/cloning_sign.tsv");
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    if (std::isnan(data.number(i, "order"))) continue;
    EXPECT_NEAR(data.number(i, "order"), data.number(i, "sign") < 0.0 ? 2.0 : 0.0, 0.05) << i;
  }
}

}  // namespace
