#include "bregman/table.hpp"

#include "common/rules/update_rules.hpp"
#include "common/table.hpp"

#include <gtest/gtest.h>

// The published iteration counts, asserted exactly where the settings determine them. A row that the last bit
// decides is found by perturbing the start, not by a list.

using experiment::Setting;

namespace optimisation_counts_test {

const experiment::CorrelatedQuartic f;

/// What a table of the paper prints, by the column that names the row's cells.
struct PublishedRow {
  std::string method, approach, row;
  double p = 0.0, p_ring = std::nan(""), h = 0.0;
  long iterations = 0;
};

std::vector<PublishedRow> published(const std::string& stem) {
  const auto table = experiment::Table::read(std::string(AVI_PUBLISHED_DIR) + "/" + stem + ".tsv");
  std::vector<PublishedRow> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (rows.empty() || rows.back().row != table.text(i, "row"))
      rows.push_back({table.text(i, "method"), table.text(i, "approach"), table.text(i, "row")});
    PublishedRow& row = rows.back();
    const double value = table.number(i, "published");
    if (table.text(i, "quantity") == "p") row.p = value;
    if (table.text(i, "quantity") == "p_ring") row.p_ring = value;
    if (table.text(i, "quantity") == "h") row.h = value;
    if (table.text(i, "quantity") == "iterations") row.iterations = static_cast<long>(value);
  }
  return rows;
}

/// The paper counts points for these two methods, updates for cloning.
long counted(const std::string& method, long updates) {
  return method == "htvi" || method == "splitting" ? updates + 1 : updates;
}

class Tables : public testing::TestWithParam<const char*> {};

TEST_P(Tables, CountsAreExactOrChaotic) {
  int exact = 0, chaotic = 0;
  for (const PublishedRow& row : published(GetParam())) {
    Setting s{row.method, row.p, row.approach == "direct" ? row.p : row.p_ring, row.h};
    avi::Minimisation run = experiment::run_setting(s, f, f.start());
    if (row.row == "Adaptive CloneY4" && row.h == 2.9e-4) {
      // The slip of the table: the printed step diverges at once, 2.2e-4 gives the printed count.
      EXPECT_EQ(run.outcome, avi::Outcome::diverged);
      EXPECT_LT(run.iterations, 100);
      s.h = 2.2e-4;
      run = experiment::run_setting(s, f, f.start());
    }
    ASSERT_TRUE(run.ok()) << row.row << ": " << run.message;
    if (counted(row.method, run.iterations) == row.iterations) {
      ++exact;
      continue;
    }
    const auto moved = experiment::perturbed_counts(s, 16, 1e-14, {});
    EXPECT_LT(moved.least(), moved.most())
        << row.row << " has one count and it is not the printed one: " << counted(row.method, run.iterations);
    EXPECT_LE(counted(row.method, moved.least()), row.iterations) << row.row;
    EXPECT_GE(counted(row.method, moved.most()), row.iterations) << row.row;
    ++chaotic;
  }
  const std::string stem = GetParam();
  const int expected = stem == "direct_vs_adaptive" ? 6 : stem == "method_comparison" ? 9 : 6;
  EXPECT_EQ(exact, expected);
  EXPECT_EQ(chaotic, stem == "method_comparison" ? 1 : 2);
}

INSTANTIATE_TEST_SUITE_P(Published, Tables,
                         testing::Values("direct_vs_adaptive", "method_comparison", "p_dependence"),
                         [](const auto& at) { return std::string(at.param); });

/// First passages through delta = 1e-2, 1e-3, ... as far as the list of printed counts goes, of
/// run(stopping, witness).
std::vector<long> passages_of(const auto& run, int count) {
  std::vector<long> found;
  double before = 0.0;
  const double last = std::pow(10.0, -1 - count);
  run(avi::Stopping{.delta = last, .iterations = 20'000'000}, [&](const avi::Iterate& at, long k, long) {
    const double change = std::abs(at.value - before);
    before = at.value;
    for (double delta = std::pow(10.0, -2.0 - static_cast<double>(found.size()));
         k > 0 && static_cast<int>(found.size()) < count && change < delta && avi::norm(at.gradient) < delta;
         delta = std::pow(10.0, -2.0 - static_cast<double>(found.size())))
      found.push_back(k);
  });
  return found;
}

std::vector<long> passages(const experiment::Rule& rule, int count) {
  return passages_of([&](const avi::Stopping& stopping,
                         auto&& witness) { return run_updates(rule, f, f.start(), stopping, witness); },
                     count);
}

using Counts = std::vector<long>;

TEST(Optimisers, NagCountsAreThePrintedOnes) {
  const Counts printed{4143, 10949, 27660, 65724, 154258, 341928, 745292};
  EXPECT_EQ(passages({.method = "nag", .h = 2e-6}, 7), printed);
  // With k = 1 at the first update, the usual reading of the printed momentum, none is.
  const Counts from_1 = passages({.method = "nag_from_1", .h = 2e-6}, 7);
  for (std::size_t i = 0; i < printed.size(); ++i)
    EXPECT_NE(from_1[i], printed[i]) << i;
}

// The paper's counts are two more than the number of updates.
TEST(Optimisers, AdamCountsAreThePrintedOnesLessTwo) {
  EXPECT_EQ(passages({.method = "adam"}, 9), (Counts{29665 - 2, 32733 - 2, 35802 - 2, 38871 - 2, 41939 - 2,
                                                     45008 - 2, 48076 - 2, 51145 - 2, 54215 - 2}));
}

TEST(Optimisers, AdaGradCountsAreThePrintedOnesLessTwo) {
  // 520 482 and 2.4E06; the further ones are optimiser_comparison's.
  const auto counts = passages({.method = "adagrad", .h = 7.0}, 2);
  EXPECT_EQ(counts, (Counts{520482 - 2, 2416099}));
}

TEST(Optimisers, RmsPropCountsAreThePrintedOnesLessTwo) {
  EXPECT_EQ(passages({.method = "rmsprop", .h = 0.1}, 9),
            (Counts{276 - 2, 305 - 2, 334 - 2, 363 - 2, 393 - 2, 422 - 2, 452 - 2, 498 - 2, 682 - 2}));
  // The control: epsilon outside the root, as ADAM has it, gives other counts.
  const auto outside = [](const avi::Stopping& stopping, auto&& witness) {
    return avi::run_updates(f, experiment::RmsProp{.rate = 0.1, .epsilon = 1e-16}, f.start(), stopping,
                            witness);
  };
  EXPECT_NE(passages_of(outside, 9).back(), 680);
}

TEST(Optimisers, TrustRegionCountsAreThePrintedOnesLessTwo) {
  EXPECT_EQ(passages({.method = "trust_region"}, 9),
            (Counts{32 - 2, 48 - 2, 71 - 2, 106 - 2, 154 - 2, 215 - 2, 288 - 2, 366 - 2, 455 - 2}));
}

TEST(RungeKutta4, ConvergesAgainstTheText) {
  const auto run = [&](const avi::BregmanFamily& family, double h) {
    return run_updates(experiment::Rule{.method = "runge_kutta_4", .family = family, .h = h}, f, f.start());
  };
  const auto direct = avi::BregmanFamily::direct(10), adaptive = avi::BregmanFamily::adaptive(10, 0.5);
  EXPECT_TRUE(run(direct, 8e-4).ok());
  EXPECT_EQ(run(direct, 8e-4).iterations, 6907);
  EXPECT_TRUE(run(adaptive, 3.9e-5).ok());
  EXPECT_EQ(run(direct, 1.6e-3).outcome, avi::Outcome::diverged);
  EXPECT_EQ(run(adaptive, 7.8e-5).outcome, avi::Outcome::diverged);
}

}  // namespace optimisation_counts_test
