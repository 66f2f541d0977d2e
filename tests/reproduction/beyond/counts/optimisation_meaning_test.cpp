#include "beyond/counts/sustained.hpp"
#include "bregman/table.hpp"

#include "reproduction/data.hpp"

#include <gtest/gtest.h>

// What the published counts mean: measured facts that the paper does not have.

using experiment::Setting;

namespace optimisation_meaning_test {

TEST(ConvergenceRate, StaysBelowItsBoundAndFallsTwiceAsFast) {
  const auto table = data::whole.rows("convergence_rate");
  ASSERT_EQ(table.size(), 4u);
  for (const auto& row : table) {
    const double p = row.number("p");
    EXPECT_LE(row.number("largest_ratio"), 1.0);
    EXPECT_LE(row.number("largest_rise_of_E"), 1e-9);
    // The adiabatic rate of a quartic, t^(-2p), where the bound is t^-p; measured within 6e-4 of it.
    EXPECT_NEAR(row.number("fitted_rate") / (-2.0 * p), 1.0, 1.2e-3) << p;
    EXPECT_EQ(row.text("outcome"), "ok");
  }
}

TEST(OrderEquivalence, OnlyTheClockTellsAdaptiveFromDirect) {
  int exact = 0;
  for (const auto& row : data::whole.rows("order_equivalence")) {
    EXPECT_EQ(row.number("order"), std::pow(row.number("p"), 2) / row.number("p_ring"));
    if (row.text("clock") == "exact") {
      ++exact;
      EXPECT_LT(row.number("distance_100"), 1e-11);
    } else {
      EXPECT_GT(row.number("distance_100"), 1e-5);
    }
  }
  EXPECT_EQ(exact, 7);
}

/// First passage and sustained convergence of a setting.
experiment::Sustained sustained(const Setting& s) {
  const experiment::CorrelatedQuartic f;
  experiment::Sustained seen;
  experiment::run_setting(s, f, f.start(), {.delta = 0.0, .iterations = seen.cap}, seen);
  return seen;
}

TEST(SustainedConvergence, TheStoppingTestFirstHoldsByChance) {
  const auto direct = sustained(experiment::direct("htvi", 4, 8e-4));
  EXPECT_TRUE(direct.confirmed);
  EXPECT_EQ(direct.first, 77877);
  EXPECT_EQ(direct.sustained(), 982354);
  // f comes back by nine powers of ten within the next 5 % of iterations.
  EXPECT_GT(direct.rebound, 1e8 * direct.at_first);
  const auto adaptive = sustained({"htvi", 4, 1, 2.4e-4});
  EXPECT_EQ(adaptive.first, 9360);
  EXPECT_EQ(adaptive.sustained(), 18008);
}

TEST(RoundingSensitivity, ThePublishedBestRowDivergesFromSomeMovedStarts) {
  // p = 10, p_ring = 0.5, h = 1.95e-5 stands at the edge of stability. Which of the moved starts fail changes
  // with the last bit of the arithmetic, so their number is a draw: 56 of 1024 were seen (99 % interval of
  // the share: 3.8 to 7.6 %). Two such numbers differ by 10.3 (the root of 2 n x (1 - x)) typically, and one
  // time in a hundred by more than 26.5.
  constexpr long n = 1024;
  EXPECT_NEAR(experiment::perturbed_counts({"htvi", 10, 0.5, 1.95e-5}, n, 1e-14, {}).failed, 56, 26.5);
}

}  // namespace optimisation_meaning_test
