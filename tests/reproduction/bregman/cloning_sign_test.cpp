#include "common/table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cloning_sign_test {

TEST(CloningSign, CopiesStayTogetherForTheMeantSignOnly) {
  const auto data = experiment::Table::read(AVI_CHECK_DIR "/data/cloning_sign.tsv");
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    if (std::isnan(data.number(i, "order"))) continue;
    EXPECT_NEAR(data.number(i, "order"), data.number(i, "sign") < 0.0 ? 2.0 : 0.0, 0.05) << i;
  }
}

}  // namespace cloning_sign_test
