#include "scorecard/numbers/printed.hpp"
#include "scorecard/numbers/sheet.hpp"
#include "scorecard/shares.hpp"
#include "scratch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

using experiment::Table, scorecard::Line, scorecard::Printed, scorecard::Verdict;

namespace scorecard_test {

TEST(Printed, EqualsWhatRoundsToItsDigits) {
  struct Case {
    const char* printed;
    double below, inside, above;
  };
  for (const auto& [printed, below, inside, above] :
       {Case{"0.0051", 0.005049, 0.005149, 0.005151}, Case{"1.43E-05", 1.4249e-5, 1.4349e-5, 1.4351e-5},
        Case{"2E05", 149000, 249000, 251000}, Case{"4000", 3999, 4000, 4001},
        Case{"1.00E-04", 9.94e-5, 9.96e-5, 1.006e-4}, Case{"1.7E6", 1649999, 1744143, 1750001},
        Case{"8", 7.4, 8.0, 8.6}}) {
    EXPECT_FALSE(Printed(printed).equals(below)) << printed;
    EXPECT_TRUE(Printed(printed).equals(inside)) << printed;
    EXPECT_FALSE(Printed(printed).equals(above)) << printed;
    EXPECT_FALSE(Printed(printed).equals(std::nan(""))) << printed;
  }
  EXPECT_TRUE(Printed(">1E10").equals(2e10));
  EXPECT_FALSE(Printed(">1E10").equals(3.6e6));
  EXPECT_THROW(Printed("---"), std::invalid_argument);
  EXPECT_THROW(Printed("12 000"), std::invalid_argument);
  EXPECT_EQ(scorecard::beside("1.43E-05", 1.42901e-5), "1.4290E-05");
  EXPECT_EQ(scorecard::beside("181", 180.0), "180");
  EXPECT_EQ(scorecard::beside("5E-05", 4.50007e-5), "4.5001E-05") << "4.50 would round either way";
  EXPECT_EQ(scorecard::beside("5E-05", 4.5e-5), "4.50E-05");
}

TEST(Published, EveryTableHasItsCellsOnceAndAsNumbers) {
  const std::map<std::string, std::pair<std::string, std::size_t>> expected{
      {"kepler_e090", {"table1", 41}},        {"kepler_e099", {"table2", 41}},
      {"direct_vs_adaptive", {"table3", 28}}, {"method_comparison", {"table4", 35}},
      {"p_dependence", {"table5", 32}},       {"optimiser_comparison", {"table6", 50}}};
  for (const auto& [stem, source_and_cells] : expected) {
    const Table table = Table::read(std::string(AVI_PUBLISHED_DIR) + "/" + stem + ".tsv");
    EXPECT_EQ(table.rows.size(), source_and_cells.second) << stem;
    std::set<std::string> keys;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      keys.insert(table.text(i, "row") + '\t' + table.text(i, "quantity"));
      EXPECT_EQ(table.text(i, "source"), source_and_cells.first) << stem;
      EXPECT_NO_THROW(Printed(table.text(i, "published"))) << stem << ' ' << i;
    }
    EXPECT_EQ(keys.size(), table.rows.size()) << stem << ": a cell is typed twice";
  }
}

/// Judges Table 1 from data that agree with it but for what a test changes.
class KeplerSheet : public testing::Test {
 protected:
  const Scratch folder;
  Table data{{"method", "construction", "monitor", "h", "g_min", "g_max", "min_step", "max_step",
              "energy_error", "global_error", "global_error_shifted", "steps", "seconds"}};

  void SetUp() override {
    const double nan = std::nan("");
    data.row("htvi4", "printed", "gamma", 0.1, 0.01, 8, 1, 1, 1, 1, nan, 1, 1e-4);
    data.row("htvi4", "authors", "gamma", 0.1, 0.01, 8, 0.002001, 0.24931, 1.429e-5, 7.092e-6, nan, 180,
             1e-4);
    data.row("htvi4", "authors", "energy", 0.1, 1e-4, 2, 0.005149, 0.1809, 1.93e-6, 4.762e-6, nan, 145, 1e-4);
    data.row("htvi4", "authors", "arclength", 0.1, 0.03, 3, 0.00399, 0.1458, 1.1e-4, 3.692e-5, nan, 184,
             1e-4);
    data.row("htvi4", "authors", "none", 0.0025, nan, nan, 0.0025, 0.0025, 2.501e-6, 2.892e-5, nan, 4000,
             2e-3);
    data.row("stormer_verlet", "nan", "none", 5e-5, nan, nan, 5e-5, 5e-5, 3.118e-6, 3.33e-5, 4.678e-5, 200000,
             3e-3);
  }

  /// A table of the paper, judged from the folder.
  [[nodiscard]] std::vector<Line> lines(const char* stem) const {
    return judge({stem, "", scorecard::judge_kepler}, AVI_PUBLISHED_DIR, scorecard::Results({folder}));
  }
  /// "row quantity" -> verdict of every cell that is not exact, seconds left out.
  std::map<std::string, Verdict> inexact() {
    data.write(folder / "kepler_e090.tsv");
    std::map<std::string, Verdict> found;
    for (const Line& line : lines("kepler_e090"))
      if (line.judgement.verdict != Verdict::exact && line.quantity != "seconds")
        found[line.row + ' ' + line.quantity] = line.judgement.verdict;
    return found;
  }
  std::string& at(std::size_t row, const char* column) { return data.rows[row][data.column(column)]; }
};

using Found = std::map<std::string, Verdict>;
const Found slips{{"HTVI4 arclength g_min", Verdict::erratum}, {"HTVI4 arclength g_max", Verdict::erratum}};

TEST_F(KeplerSheet, FindsOnlyTheSlips) { EXPECT_EQ(inexact(), slips); }

TEST_F(KeplerSheet, SeesAChangedDigit) {
  at(1, "energy_error") = "1.44e-5";
  at(2, "steps") = "144";
  at(5, "global_error_shifted") = "3.33e-5";
  Found expected = slips;
  expected["HTVI4 gamma energy_error"] = expected["HTVI4 energy steps"] = expected["SV global_error"] =
      Verdict::differs;
  EXPECT_EQ(inexact(), expected);
}

TEST_F(KeplerSheet, DoesNotRoundSettings) {
  at(1, "h") = "0.11";
  at(2, "h") = "0.05";
  Found expected = slips;
  expected["HTVI4 gamma h"] = expected["HTVI4 energy h"] = Verdict::erratum;
  EXPECT_EQ(inexact(), expected);
}

/// Agreement comes near a prediction where the printed settings and the printed construction give the number,
/// too, and no more is missing than start and horizon.
TEST_F(KeplerSheet, TellsWhatRestsOnARecoveredSetting) {
  at(0, "monitor") = "energy";
  at(0, "min_step") = "0.005149";
  at(0, "steps") = "145";
  data.write(folder / "kepler_e090.tsv");
  std::set<std::string> printed, customary;
  for (const Line& line : lines("kepler_e090"))
    if (scorecard::kind_of(line.row, line.quantity) == scorecard::Kind::outcome) {
      if (line.judgement.settings == "printed") printed.insert(line.row + ' ' + line.quantity);
      if (line.judgement.settings == "customary") customary.insert(line.row + ' ' + line.quantity);
    }
  EXPECT_EQ(printed, std::set<std::string>{});
  EXPECT_EQ(customary, (std::set<std::string>{"HTVI4 energy min_step", "HTVI4 energy steps", "SV steps"}));
}

TEST_F(KeplerSheet, CallsNothingASlipWithoutEvidence) {
  at(3, "max_step") = "0.1468";
  EXPECT_EQ(inexact(), (Found{{"HTVI4 arclength g_min", Verdict::differs},
                              {"HTVI4 arclength g_max", Verdict::differs},
                              {"HTVI4 arclength max_step", Verdict::differs}}));
}

TEST_F(KeplerSheet, SaysWhatIsMissing) {
  data.rows.erase(data.rows.begin() + 2);
  const Found found = inexact();
  EXPECT_EQ(found.size(), 8 + slips.size());
  EXPECT_EQ(found.at("HTVI4 energy steps"), Verdict::missing);
  for (const Line& line : lines("kepler_e099")) {
    EXPECT_EQ(line.judgement.verdict, Verdict::missing);
    EXPECT_NE(line.judgement.note.find("kepler_e099.tsv"), std::string::npos);
  }
}

}  // namespace scorecard_test
