#include "scorecard/claims/claims.hpp"
#include "scorecard/shares.hpp"
#include "text_of.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

// What the page on the reproduction says is what the scorecard found (paper/verdicts.tsv, made by `make
// verdicts`).

namespace fs = std::filesystem;

namespace front_page_test {

const fs::path source = AVI_SOURCE_DIR;

std::string readme() { return text_of(source / "README.md"); }

/// The page with the verdicts.
std::string reproduction() { return text_of(source / "lib/docs/reproduction.md"); }

/// Verdicts on numbers, and rulings on claims.
experiment::Table verdicts(bool claims) {
  experiment::Table all = experiment::Table::read(source / "paper/verdicts.tsv");
  std::erase_if(all.rows, [&](const auto& row) { return (row[0] == "text") != claims; });
  return all;
}

TEST(Verdicts, CoverEveryPublishedNumberAndClaim) {
  std::size_t cells = 0;
  const experiment::Table numbers = verdicts(false), rulings = verdicts(true);
  for (const auto& entry : fs::directory_iterator(source / "paper/published")) {
    const experiment::Table table = experiment::Table::read(entry.path());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      if (entry.path().stem() == "claims") {
        EXPECT_NO_THROW(scorecard::find(rulings, {{"row", table.text(i, "key")}})) << table.text(i, "key");
        continue;
      }
      ++cells;
      EXPECT_NO_THROW(scorecard::find(numbers, {{"source", table.text(i, "source")},
                                                {"row", table.text(i, "row")},
                                                {"quantity", table.text(i, "quantity")}}));
    }
  }
  EXPECT_EQ(numbers.rows.size(), cells);
  for (const auto* table : {&numbers, &rulings})
    for (std::size_t i = 0; i < table->rows.size(); ++i)
      EXPECT_NE(table->text(i, "verdict"), "missing") << table->text(i, "row");
}

TEST(FrontPage, StatesTheSharesOfTheScorecard) {
  const std::string text = reproduction();
  std::size_t stated = 0;
  using scorecard::Kind, scorecard::of_kind;
  for (const auto& cells :
       {of_kind(verdicts(false), Kind::outcome), of_kind(verdicts(false), Kind::input), verdicts(true)})
    for (const auto& share : scorecard::shares(cells, "verdict")) {
      const std::string line =
          fmt::format("| `{}` | {} | {:.1f} % |", share.name, share.count, 100.0 * share.part);
      EXPECT_NE(text.find(line), std::string::npos) << "the page lacks " << line;
      ++stated;
    }
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = text.find(" % |", at)) != std::string::npos; ++at)
    ++lines;
  EXPECT_EQ(lines, stated) << "The page states shares that the scorecard does not have";
}

/// A count that agrees after a fit is not sold as a prediction.
TEST(FrontPage, SaysHowManyOutcomesArePredicted) {
  const auto predicted = scorecard::predicted(verdicts(false));
  const std::string line = fmt::format("Of the exact ones {} from printed settings alone; {} need no more "
                                       "than the start and the horizon besides",
                                       predicted == 0   ? "none follows"
                                       : predicted == 1 ? "1 follows"
                                                        : fmt::format("{} follow", predicted),
                                       scorecard::customary(verdicts(false)));
  EXPECT_NE(reproduction().find(line), std::string::npos) << "the page lacks " << line;
}

TEST(Kinds, OfThePublishedNumbers) {
  using scorecard::Kind, scorecard::kind_of;
  EXPECT_EQ(kind_of("HTVI4 gamma", "g_min"), Kind::input);
  EXPECT_EQ(kind_of("HTVI4 gamma", "min_step"), Kind::outcome);
  EXPECT_EQ(kind_of("HTVI4 none", "min_step"), Kind::input);
  EXPECT_EQ(kind_of("SV", "max_step"), Kind::input);
  EXPECT_EQ(kind_of("SV", "seconds"), Kind::seconds);
  EXPECT_EQ(kind_of("Direct HTVI p=4", "iterations"), Kind::outcome);
}

/// The map from the paper's tables to files has the verdicts on each table's outcomes.
TEST(FrontPage, StatesTheVerdictsOfEachTable) {
  const std::string text = reproduction();
  for (const char* source_table : {"table1", "table2", "table3", "table4", "table5", "table6"}) {
    auto cells = scorecard::of_kind(verdicts(false), scorecard::Kind::outcome);
    std::erase_if(cells.rows, [&](const auto& row) { return row[0] != source_table; });
    std::string line = fmt::format("| {} outcomes:", cells.rows.size());
    const char* separator = " ";
    for (const auto& share : scorecard::shares(cells, "verdict")) {
      line += fmt::format("{}{} {}", separator, share.count, share.name);
      separator = ", ";
    }
    EXPECT_NE(text.find(line + " |"), std::string::npos) << source_table << ": the page lacks " << line;
  }
}

TEST(FrontPage, IsShort) {
  const std::string text = readme();
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 90);
}

/// That they are there guide_test sees.
TEST(FrontPage, HasSmallPictures) {
  const auto pictures = matches(readme(), "\\]\\(([^)\\s]+\\.png)\\)");
  EXPECT_GE(pictures.size(), 1u);
  for (const auto& picture : pictures)
    EXPECT_LT(fs::file_size(source / picture), 150'000u) << picture;
}

}  // namespace front_page_test
