#include "beyond/counts/sustained.hpp"
#include "bregman/perturbed.hpp"

#include "common/table.hpp"

#include <gtest/gtest.h>

// What the published counts mean: measured facts that the paper does not have.

using experiment::Setting;

namespace {

const std::string data = AVI_CHECK_DIR "/data/";

TEST(ConvergenceRate, StaysBelowItsBoundAndFallsTwiceAsFast) {
  const auto table = experiment::Table::read(data + "convergence_rate.tsv");
  ASSERT_EQ(table.rows.size(), 4u);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double p = table.number(i, "p");
    EXPECT_LE(table.number(i, "largest_ratio"), 1.0);
    EXPECT_LE(table.number(i, "largest_rise_of_E"), 1e-9);
    // The adiabatic rate of a quartic, t^(-2p), where the bound is t^-p; measured within 6e-4 of it.
    EXPECT_NEAR(table.number(i, "fitted_rate") / (-2.0 * p), 1.0, 1.2e-3) << p;
    EXPECT_EQ(table.text(i, "outcome"), "ok");
  }
}

TEST(OrderEquivalence, OnlyTheClockTellsAdaptiveFromDirect) {
  const auto table = experiment::Table::read(data + "order_equivalence.tsv");
  int exact = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.number(i, "order"), std::pow(table.number(i, "p"), 2) / table.number(i, "p_ring"));
    if (table.text(i, "clock") == "exact") {
      ++exact;
      EXPECT_LT(table.number(i, "distance_100"), 1e-11);
    } else {
      EXPECT_GT(table.number(i, "distance_100"), 1e-5);
    }
  }
  EXPECT_EQ(exact, 7);
}

/// First passage and sustained convergence of a setting.
experiment::Sustained sustained(const Setting& s) {
  const avi::CorrelatedQuartic f;
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

/// P(X <= k) of the binomial distribution.
double binomial(long k, long n, double p) {
  double sum = 0.0;
  for (long i = 0; i <= k; ++i) {
    const double a = static_cast<double>(i), b = static_cast<double>(n - i);
    sum += std::exp(std::lgamma(a + b + 1.0) - std::lgamma(a + 1.0) - std::lgamma(b + 1.0) + a * std::log(p) +
                    b * std::log1p(-p));
  }
  return sum;
}

TEST(RoundingSensitivity, ThePublishedBestRowDivergesFromSomeMovedStarts) {
  // p = 10, p_ring = 0.5, h = 1.95e-5 stands at the edge of stability. Which of the moved starts fail changes
  // with the last bit of the arithmetic, so the number is a sample: that of 1024 refutes, each at a level of
  // 1 %, that fewer than one start in a hundred fails and that more than one in ten does.
  constexpr long n = 1024;
  const long failed = experiment::perturbed_counts({"htvi", 10, 0.5, 1.95e-5}, n, 1e-14, {}).failed;
  EXPECT_LT(1.0 - binomial(failed - 1, n, 0.01), 0.01) << failed;  // measured 56; holds from 19 on
  EXPECT_LT(binomial(failed, n, 0.1), 0.01) << failed;             // holds up to 80
}

}  // namespace
