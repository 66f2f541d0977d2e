// data: cloning_sign
#include "scorecard/sheets.hpp"

#include <gtest/gtest.h>

namespace {

TEST(CloningSign, CopiesStayTogetherForTheMeantSignOnly) {
  const auto lines =
      scorecard::judge(scorecard::cloning_sign_sheet(), AVI_PUBLISHED_DIR, AVI_CHECK_DIR "/data");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].published, "1");
  EXPECT_EQ(lines[0].judgement.verdict, scorecard::Verdict::erratum) << lines[0].judgement.note;

  const auto data = avi::Table::read(AVI_CHECK_DIR "/data/cloning_sign.tsv");
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    if (std::isnan(data.number(i, "order"))) continue;
    EXPECT_NEAR(data.number(i, "order"), data.number(i, "sign") < 0.0 ? 2.0 : 0.0, 0.05) << i;
  }
}

}  // namespace
