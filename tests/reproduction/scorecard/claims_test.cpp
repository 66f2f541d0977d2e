#include "scorecard/claims/claims.hpp"
#include "scratch.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <set>

// The ledger of claims, ruled upon from what the tests' experiments wrote (some of them shortened).

namespace fs = std::filesystem;
using scorecard::Ruling;

namespace claims_test {

const fs::path check = AVI_CHECK_DIR;

std::map<std::string, scorecard::ClaimLine> ledger(const std::vector<fs::path>& folders) {
  std::map<std::string, scorecard::ClaimLine> lines;
  for (auto& line : scorecard::judge_claims(AVI_PUBLISHED_DIR, scorecard::Results(folders)))
    lines.emplace(line.key, line);
  return lines;
}

TEST(Claims, EachNamesItsExperimentAndATest) {
  const experiment::Table table = experiment::Table::read(fs::path(AVI_PUBLISHED_DIR) / "claims.tsv");
  std::set<std::string> keys;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    keys.insert(table.text(i, "key"));
    EXPECT_TRUE(lies_in("tests", table.text(i, "test") + ".cpp")) << table.text(i, "test");
    std::istringstream stems(table.text(i, "experiment"));
    for (std::string stem; stems >> stem;)
      EXPECT_TRUE(lies_in("experiments", stem + ".cpp")) << stem;
  }
  EXPECT_EQ(keys.size(), table.rows.size()) << "a key occurs twice";
  const auto decisions = scorecard::all_decisions();
  for (const auto& [key, decision] : decisions)
    EXPECT_TRUE(keys.contains(key)) << key << " is no claim of the ledger";
  EXPECT_EQ(decisions.size(), keys.size());
}

/// Rulings do not hang on the length of a run, but for these: some rest on seconds, and the shortened runs
/// stop before Taylor order 3 and leave out most tolerances of the Runge-Kutta pairs.
TEST(Claims, RulingsAreThoseOfTheWholeData) {
  const std::set<std::string> timed{"euler_b_costs_most",  "norm_squared_fastest",     "arclength_costs_most",
                                    "arclength_behind",    "gradient_free_is_cheaper", "adaptivity_pays",
                                    "gamma_most_efficient"};
  const std::set<std::string> shortened{"htvi4_is_fourth_order"};
  const auto lines = ledger({check / "data", check / "quick"});
  const experiment::Table stated =
      experiment::Table::read(fs::path(AVI_PUBLISHED_DIR).parent_path() / "verdicts.tsv");
  for (const auto& [key, line] : lines) {
    if (shortened.contains(key)) continue;
    EXPECT_NE(line.finding.ruling, Ruling::missing) << key << ": " << line.finding.evidence;
    if (timed.contains(key)) continue;
    const auto row = scorecard::find(stated, {{"source", "text"}, {"row", key}});
    EXPECT_EQ(row.text("verdict"), name(line.finding.ruling)) << key << ": " << line.finding.evidence;
  }
}

/// Other data, other rulings.
class ChangedData : public testing::Test {
 protected:
  const Scratch folder;

  /// The change of these cells, in rows whose `column` begins with `cell`.
  static auto with(std::map<std::string, std::string> cells, const char* column = nullptr,
                   const char* cell = nullptr) {
    return [=](const experiment::Table& table, auto& row) {
      if (column && !row[table.column(column)].starts_with(cell)) return;
      for (const auto& [name, text] : cells)
        row[table.column(name)] = text;
    };
  }
  /// The ruling on `key` after `change` of one table.
  template <class Change>
  Ruling ruling(const std::string& key, const std::string& stem, Change change) {
    const fs::path quick = check / "quick" / (stem + ".tsv");
    experiment::Table table =
        experiment::Table::read(fs::exists(quick) ? quick : check / "data" / (stem + ".tsv"));
    for (auto& row : table.rows)
      change(table, row);
    table.write(folder / (stem + ".tsv"));
    return ledger({folder, check / "data", check / "quick"}).at(key).finding.ruling;
  }
};

TEST_F(ChangedData, ChangesTheRuling) {
  EXPECT_EQ(ruling("rk4_fails", "runge_kutta_baselines", with({{"sustained", "nan"}})), Ruling::holds);
  EXPECT_EQ(ruling("adaptive_has_lower_order", "order_equivalence", with({{"distance_100", "0.1"}})),
            Ruling::holds);
  EXPECT_EQ(ruling("rate_bound", "convergence_rate", with({{"largest_ratio", "1.5"}})), Ruling::fails);
  EXPECT_EQ(ruling("truncation_fewest_steps", "euler_b_cost",
                   with({{"steps", "99999999"}}, "monitor", "norm_squared")),
            Ruling::holds);
  EXPECT_EQ(ruling("order_theorem", "order_verification",
                   with({{"measured_order", "0.5"}, {"limit_order", "0.5"}})),
            Ruling::fails);
  EXPECT_EQ(ruling("energy_not_extreme", "kepler_e090", with({{"max_step", "1.0"}}, "monitor", "energy")),
            Ruling::in_part);
  EXPECT_EQ(
      ruling("cloning_is_behind", "variants", with({{"gradients_per_step", "100"}}, "variant", "kick_first")),
      Ruling::holds);
  EXPECT_EQ(ruling("cloning_needs_3_7_19", "method_comparison",
                   [](const experiment::Table& table, auto& row) {
                     row[table.column("gradient_evaluations")] =
                         std::to_string(20 * std::stol(row[table.column("iterations")]));
                   }),
            Ruling::holds);
  for (const auto& [key, changed] :
       {std::pair{"beats_popular_methods", Ruling::fails}, {"not_the_most_efficient", Ruling::holds}})
    EXPECT_EQ(ruling(key, "optimiser_comparison", with({{"converged", "1"}, {"iterations", "100"}})),
              changed);
}

/// Where a claim speaks of cost or efficiency, seconds count beside steps.
TEST_F(ChangedData, SecondsCountWhereCostIsClaimed) {
  const auto with_seconds = [&](const char* key, const char* monitor, const char* seconds) {
    return ruling(key, "monitor_costs", with({{"seconds", seconds}}, "monitor", monitor));
  };
  EXPECT_EQ(with_seconds("gamma_most_efficient", "gamma", "10"),
            Ruling::fails);  // 1/2 and 3/4 with gamma = 1
  EXPECT_EQ(with_seconds("gamma_most_efficient", "gamma", "1e-9"), Ruling::in_part);
  EXPECT_EQ(with_seconds("arclength_behind", "arclength", "1e-9"), Ruling::in_part);
}

/// Seconds decide only where the rounds agree.
TEST_F(ChangedData, RoundsThatDisagreeDecideNothing) {
  const auto slower_truncation = [&](int every) {
    return ruling("norm_squared_fastest", "euler_b_cost_rounds",
                  [every](const experiment::Table& table, auto& row) {
                    const std::string& monitor = row[table.column("monitor")];
                    const int round = std::stoi(row[table.column("round")]);
                    row[table.column("nanoseconds")] = monitor == "norm_squared" ? "40"
                                                       : monitor == "arclength"  ? "100"
                                                       : round % every == 0      ? "90"
                                                                                 : "120";
                  });
  };
  EXPECT_EQ(slower_truncation(1), Ruling::holds);
  EXPECT_EQ(slower_truncation(2), Ruling::undecided);
  EXPECT_EQ(slower_truncation(22), Ruling::in_part);
}

TEST(Claims, AreMissingWithoutData) {
  for (const auto& [key, line] : ledger({}))
    EXPECT_EQ(line.finding.ruling, Ruling::missing) << key;
}

}  // namespace claims_test
