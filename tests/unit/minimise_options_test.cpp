#include "avi/optim/minimise_options.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <stdexcept>

using avi::MinimiseOptions;

namespace minimise_options_test {

TEST(MinimiseOptions, HaveTheDocumentedDefaults) {
  const MinimiseOptions options;
  EXPECT_EQ(options.relative, 1e-6);
  EXPECT_EQ(options.absolute, 0.0);
  EXPECT_EQ(options.change, HUGE_VAL);
  EXPECT_EQ(options.memory, 7);
  EXPECT_EQ(options.iterations, 10'000'000);
  EXPECT_EQ(options.evaluations, 10'000'000);
  EXPECT_FALSE(options.check_gradient);
}

TEST(MinimiseOptions, HaveTheDefaultsThatTheirPageStates) {
  const std::string page = text_of(AVI_SOURCE_DIR "/lib/docs/minimise.md"),
                    header = text_of(AVI_SOURCE_DIR "/lib/avi/optim/minimise_options.hpp");
  const std::regex row("\n\\| `([a-z_]+)` \\| `([^`]+)`");
  int rows = 0;
  for (std::sregex_iterator i(page.begin(), page.end(), row), end; i != end; ++i, ++rows)
    EXPECT_NE(header.find(" " + i->str(1) + " = " + i->str(2) + ";"), std::string::npos) << i->str();
  EXPECT_EQ(rows, 6);
}

TEST(MinimiseOptions, AreRefusedOutsideTheirRanges) {
  for (const MinimiseOptions& bad : {MinimiseOptions{.relative = -1e-9},
                                     {.relative = 1.0},
                                     {.absolute = -1e-9},
                                     {.absolute = HUGE_VAL},
                                     {.change = 0.0},
                                     {.memory = -1},
                                     {.memory = 1001},
                                     {.iterations = 0},
                                     {.evaluations = 0}})
    EXPECT_THROW(bad.validate(), std::invalid_argument);
}

}  // namespace minimise_options_test
