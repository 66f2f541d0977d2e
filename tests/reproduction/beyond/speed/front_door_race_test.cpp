#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

using experiment::Table;

namespace front_door_race_test {

/// The references are right: methods that share nothing come to within 1e-9 of them where motion is calm.
TEST(FrontDoorRace, SolveAndOtherLibrariesMeetAtTheReference) {
  std::map<std::string, std::map<std::string, double>> least;  // of each scene, by library
  for (const auto& row : data::quick.rows("front_door")) {
    if (row.number("horizon") > 1.0) continue;
    const std::string method = row.text("method");
    double& error =
        least[row.text("scene")].try_emplace(method.substr(0, method.find('_')), HUGE_VAL).first->second;
    error = std::min(error, row.number("error"));
  }
  EXPECT_GE(least.size(), 9u);
  for (const auto& [scene, by_library] : least) {
    EXPECT_TRUE(by_library.contains("avi")) << scene;
    EXPECT_TRUE(by_library.contains("gsl")) << scene;
    EXPECT_LT(by_library.at("avi"), 1e-6) << scene;
    EXPECT_LT(by_library.at("gsl"), 1e-9) << scene;
  }
}

TEST(FrontDoorRace, CellsHoldTheCheapestRowsThatReachTheirTargets) {
  const Table &cells = data::quick("front_door_cells"), &table = data::quick("front_door");
  ASSERT_GE(cells.rows.size(), 40u);
  for (std::size_t i = 0; i < cells.rows.size(); ++i) {
    const double ours = cells.number(i, "ours"), peer = cells.number(i, "best_peer"),
                 ratio = cells.number(i, "ratio");
    if (std::isfinite(ours) && std::isfinite(peer)) {
      EXPECT_NEAR(ratio, ours / peer, 1.6e-3 * ratio) << "three numbers of four digits, up to 5e-4 off each";
    } else {
      EXPECT_TRUE(std::isnan(ratio));
    }
    if (!std::isfinite(ours)) continue;
    bool found = false;  // the setting's own error
    for (std::size_t k = 0; k < table.rows.size() && !found; ++k)
      found = table.text(k, "scene") == cells.text(i, "scene") && table.text(k, "method") == "avi" &&
              table.number(k, "horizon") == cells.number(i, "horizon") &&
              table.text(k, "setting") == cells.text(i, "ours_setting") &&
              table.number(k, "error") <= cells.number(i, "target");
    EXPECT_TRUE(found) << cells.text(i, "scene") << ' ' << cells.text(i, "target");
  }
}

/// What seconds say is not due to how an evaluation is written: counts of evaluations, which no load moves,
/// are of the same size.
TEST(FrontDoorRace, EvaluationsAreCounted) {
  for (const auto& row : data::quick.rows("front_door_cells"))
    if (std::isfinite(row.number("ratio"))) {
      EXPECT_GT(row.number("ours_evaluations"), 0.0);
      EXPECT_GT(row.number("peer_evaluations"), 0.0);
    }
}

}  // namespace front_door_race_test
