#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

// What docs/optimisation.md says of the arena, on its whole default grid.

namespace optimiser_arena_test {

double of(const std::string& group, const std::string& method, const char* column) {
  return data::whole.number("optimiser_arena_summary", {{"group", group}, {"method", method}}, column);
}

TEST(OptimiserArena, TheDefaultsNeverFail) {
  EXPECT_EQ(of("all", "minimise_m7", "failures"), 0.0);
  EXPECT_EQ(of("all", "minimise_m0", "failures"), 0.0);
}

TEST(OptimiserArena, ItIsSeldomFarFromTheBest) {
  EXPECT_GE(of("tuned", "minimise_m7", "within_2"), 0.9);     // measured 0.95
  EXPECT_GE(of("held_out", "minimise_m7", "within_2"), 0.9);  // measured 1.00
}

TEST(OptimiserArena, MeansAgainstOthers) {
  EXPECT_LE(of("all", "minimise_m7", "ratio_to_best_cg"), 0.6);        // measured 0.37
  EXPECT_LE(of("all", "minimise_m0", "ratio_to_best_cg"), 0.8);        // measured 0.56
  EXPECT_LE(of("all", "minimise_m0", "evaluations_to_best_cg"), 0.6);  // measured 0.55
  EXPECT_LE(of("tuned", "minimise_m7", "per_iteration"), 1.3);         // measured 1.15
  EXPECT_LE(of("held_out", "minimise_m7", "per_iteration"), 1.25);     // measured 1.11
  if (std::isnan(of("all", "minimise_m7", "ratio_to_lbfgs"))) GTEST_SKIP() << "liblbfgs is not installed";
  EXPECT_LE(of("all", "minimise_m7", "ratio_to_lbfgs"), 0.9);       // measured 0.79
  EXPECT_LE(of("held_out", "minimise_m7", "ratio_to_lbfgs"), 0.9);  // measured 0.67
}

}  // namespace optimiser_arena_test
