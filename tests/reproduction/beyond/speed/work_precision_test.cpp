#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

using experiment::Table;

namespace work_precision_test {

TEST(WorkPrecision, HoldsTheReferenceRun) {
  const Table& table = data::quick("work_precision");
  ASSERT_FALSE(table.rows.empty());
  EXPECT_EQ(table.text(0, "method"), "stormer_verlet");
  EXPECT_NEAR(table.number(0, "steps"), 200000, 1);
  EXPECT_NEAR(table.number(0, "energy_error"), 3.118e-6, 1e-9);
  EXPECT_NEAR(table.number(0, "position_error"), 3.330e-5, 2e-8);
  EXPECT_NEAR(table.number(0, "cost"), 1.0, 1e-12);
}

TEST(WorkPrecision, ErrorsFallWithTheStepUntilRoundOff) {
  const Table& table = data::quick("work_precision");
  std::map<std::string, double> last;
  int pairs = 0;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const std::string &method = table.text(i, "method"), &setting = table.text(i, "setting");
    // Tolerances, other libraries' and of sweeps, promise no such thing.
    if (setting.find("tolerance=") != std::string::npos) continue;
    const std::string curve = method + table.text(i, "order") + setting.substr(0, setting.rfind('='));
    const double error = table.number(i, "position_error");
    if (last.contains(curve) && last[curve] > 1e-12) {
      EXPECT_LT(error, last[curve]) << method << ' ' << setting;
      ++pairs;
    }
    last[curve] = error;
  }
  EXPECT_GE(last.size(), 6u);  // 27 where nothing else runs; on a slow machine fewer fit
  EXPECT_GE(pairs, 5);
}

TEST(WorkPrecision, SweepsThatEndEarlySaveWorkAndErrAsTheirToleranceAllows) {
  const Table& table = data::quick("work_precision");
  std::map<std::string, std::size_t> solved;  // rows whose sweeps go on to round-off
  int rows = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string& setting = table.text(i, "setting");
    if (table.text(i, "method") != "collocation" || table.text(i, "order") != "16") continue;
    const auto from = setting.find("tolerance="), to = setting.rfind("h=");
    if (from == std::string::npos) {
      solved[setting] = i;
      continue;
    }
    const auto tight = solved.find(setting.substr(0, from) + setting.substr(to));
    if (tight == solved.end()) continue;
    ++rows;
    // At most 4.6 tolerances were measured.
    EXPECT_LT(table.number(i, "position_error"),
              10.0 * std::stod(setting.substr(from + 10)) + table.number(tight->second, "position_error"))
        << setting;
    EXPECT_LT(table.number(i, "evaluations"), table.number(tight->second, "evaluations")) << setting;
  }
  EXPECT_GE(rows, 2);  // 9 where nothing else runs
}

/// Solved to rounding, and beside it whatever ends the sweeps: the latter is never dearer, and the same where
/// its setting has no tolerance.
TEST(WorkPrecision, AdviceHasCollocationSolvedToRoundingBesideTheCheapest) {
  int solved = 0;
  for (const auto& row : data::quick.rows("work_precision_advice")) {
    EXPECT_EQ(row.text("solved_setting").find("tolerance="), std::string::npos);
    if (row.text("solved") == "none") continue;
    ++solved;
    EXPECT_LE(row.number("collocation_cost"), row.number("solved_cost"));
    if (row.text("collocation_solved") == "1") {
      EXPECT_EQ(row.text("collocation_setting"), row.text("solved_setting"));
    }
    EXPECT_GE(row.number("drift"), 0.0);
  }
  EXPECT_GE(solved, 2);
}

TEST(WorkPrecision, ItsAdviceReachesTheTargetsAheadOfEveryPeer) {
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "not optimised, as the other libraries are";
#endif
  const auto advice = data::quick.rows("work_precision_advice");
  ASSERT_EQ(advice.size(), 5u);
  for (const auto& row : advice) {
    EXPECT_EQ(row.text("verdict"), "ahead") << row.text("target");
    EXPECT_LT(row.number("ratio"), 1.0);
  }
}

}  // namespace work_precision_test
