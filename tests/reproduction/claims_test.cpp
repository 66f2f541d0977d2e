// data: kepler_e090 kepler_e099 convergence_rate order_equivalence cloning_sign
// data: symplecticity eccentricity_gain
// quick: extreme_eccentricity
// quick: euler_b_cost euler_b_step_sizes order_verification direct_vs_adaptive method_comparison p_dependence
// quick: runge_kutta_baselines optimiser_comparison
#include "scorecard/claims.hpp"

#include <gtest/gtest.h>

#include <set>
#include <unistd.h>

// The ledger of claims, ruled upon from what the tests' experiments wrote (some of them shortened).

namespace fs = std::filesystem;
using scorecard::Ruling;

namespace {

const fs::path check = AVI_CHECK_DIR;

std::map<std::string, scorecard::ClaimLine> ledger(const std::vector<fs::path>& folders) {
  std::map<std::string, scorecard::ClaimLine> lines;
  for (auto& line : scorecard::judge_claims(AVI_PUBLISHED_DIR, scorecard::Results(folders)))
    lines.emplace(line.key, line);
  return lines;
}

TEST(Claims, EachNamesItsExperimentAndATest) {
  const avi::Table table = avi::Table::read(fs::path(AVI_PUBLISHED_DIR) / "claims.tsv");
  std::set<std::string> keys;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    keys.insert(table.text(i, "key"));
    bool found = false;
    for (const char* folder : {"unit", "property", "reproduction", "stability"})
      found =
          found || fs::exists(fs::path(AVI_SOURCE_DIR) / "tests" / folder / (table.text(i, "test") + ".cpp"));
    EXPECT_TRUE(found) << table.text(i, "test");
    std::istringstream stems(table.text(i, "experiment"));
    for (std::string stem; stems >> stem;)
      EXPECT_TRUE(fs::exists(fs::path(AVI_SOURCE_DIR) / "experiments" / (stem + ".cpp"))) << stem;
  }
  EXPECT_EQ(keys.size(), table.rows.size()) << "a key occurs twice";
  std::size_t decided = 0;
  for (const auto* decisions :
       {&scorecard::euler_b_decisions(), &scorecard::htvi_decisions(), &scorecard::structure_decisions(),
        &scorecard::dynamics_decisions(), &scorecard::optimiser_decisions()})
    for (const auto& [key, decision] : *decisions) {
      EXPECT_TRUE(keys.contains(std::string(key))) << key << " is no claim of the ledger";
      ++decided;
    }
  EXPECT_EQ(decided, keys.size());
}

/// Rulings do not hang on the length of a run, but for these: some rest on seconds, and the shortened runs
/// stop before NAG converges in shifted variables and leave out most tolerances of the Runge-Kutta pairs.
TEST(Claims, RulingsAreThoseOfTheWholeData) {
  const std::set<std::string> timed{"euler_b_costs_most", "norm_squared_fastest", "arclength_behind",
                                    "gradient_free_is_cheaper", "adaptivity_pays"};
  const std::set<std::string> shortened{"nag_never_reaches"};
  const auto lines = ledger({check / "data", check / "quick"});
  const avi::Table stated = avi::Table::read(fs::path(AVI_PUBLISHED_DIR).parent_path() / "verdicts.tsv");
  for (const auto& [key, line] : lines) {
    EXPECT_NE(line.finding.ruling, Ruling::missing) << key << ": " << line.finding.evidence;
    if (timed.contains(key) || shortened.contains(key)) continue;
    const std::size_t row = scorecard::find(stated, {{"source", "text"}, {"row", key}});
    EXPECT_EQ(stated.text(row, "verdict"), name(line.finding.ruling)) << key << ": " << line.finding.evidence;
  }
}

/// Other data, other rulings.
class ChangedData : public testing::Test {
 protected:
  const fs::path folder = fs::temp_directory_path() / ("avi_claims_" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  /// The ruling on `key` after `change` of one table.
  template <class Change>
  Ruling ruling(const std::string& key, const std::string& stem, Change change) {
    const fs::path quick = check / "quick" / (stem + ".tsv");
    avi::Table table = avi::Table::read(fs::exists(quick) ? quick : check / "data" / (stem + ".tsv"));
    for (auto& row : table.rows)
      change(table, row);
    table.write(folder / (stem + ".tsv"));
    return ledger({folder, check / "data", check / "quick"}).at(key).finding.ruling;
  }
};

TEST_F(ChangedData, ChangesTheRuling) {
  const auto unless = [](const char* column, const char* from, const char* to) {
    return [=](const avi::Table& table, std::vector<std::string>& row) {
      auto& cell = row[table.column(column)];
      if (cell == from) cell = to;
    };
  };
  EXPECT_EQ(ruling("rk4_fails", "runge_kutta_baselines", unless("converged", "1", "0")), Ruling::holds);
  EXPECT_EQ(ruling("adaptive_has_lower_order", "order_equivalence",
                   [](const avi::Table& table, auto& row) { row[table.column("distance_100")] = "0.1"; }),
            Ruling::holds);
  EXPECT_EQ(ruling("rate_bound", "convergence_rate",
                   [](const avi::Table& table, auto& row) { row[table.column("largest_ratio")] = "1.5"; }),
            Ruling::fails);
  EXPECT_EQ(ruling("norm_squared_more_steps", "euler_b_cost",
                   [](const avi::Table& table, auto& row) {
                     if (row[table.column("monitor")] == "norm_squared")
                       row[table.column("steps")] = "99999999";
                   }),
            Ruling::holds);
  EXPECT_EQ(ruling("order_theorem", "order_verification",
                   [](const avi::Table& table, auto& row) { row[table.column("measured_order")] = "0.5"; }),
            Ruling::fails);
  EXPECT_EQ(ruling("energy_not_extreme", "kepler_e090",
                   [](const avi::Table& table, auto& row) {
                     if (row[table.column("monitor")] == "energy") row[table.column("max_step")] = "1.0";
                   }),
            Ruling::in_part);
  EXPECT_EQ(ruling("cloning_needs_3_7_19", "method_comparison",
                   [](const avi::Table& table, auto& row) {
                     row[table.column("gradient_evaluations")] =
                         std::to_string(20 * std::stol(row[table.column("iterations")]));
                   }),
            Ruling::holds);
}

TEST(Claims, AreMissingWithoutData) {
  for (const auto& [key, line] : ledger({}))
    EXPECT_EQ(line.finding.ruling, Ruling::missing) << key;
}

}  // namespace
