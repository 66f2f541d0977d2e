#include "avi/bregman/bregman_htvi.hpp"
#include "avi/optim/run_updates.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "common/timing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using avi::BregmanFamily, avi::VectorX;

namespace optimiser_cost_test {

TEST(Htvi, AnIterationCostsLittleMoreThanItsGradient) {
  // Both loops are chains: the next point depends on what the evaluation returned. Ratio of minima over
  // interleaved rounds, as many as it takes to meet ten seconds undisturbed by other programs; measured 1.04
  // to 1.23 with the vector units of the machine and up to 1.33 with SSE2 alone.
  constexpr long n = 20'000;
  double evaluation = 1.0, iteration = 1.0, sink = 0.0;
  const experiment::CorrelatedQuartic f;
  VectorX g(50);
  const avi::BregmanHtvi method{.family = BregmanFamily::adaptive(4.0, 1.0), .h = 2.4e-4};
#ifdef __AVX2__
  const double bound = 1.3;
#else
  const double bound = 1.5;
#endif
  for (int round = 0; round < 1000 && (round < 15 || iteration > bound * evaluation); ++round) {
    VectorX x = f.start();
    evaluation = std::min(evaluation, experiment::seconds([&] {
                            for (long k = 0; k < n; ++k) {
                              const double value = f(x, g);
                              x[0] += 1e-30 * value;
                              x[49] += 1e-30 * value;
                              sink += value;
                            }
                          }));
    iteration =
        std::min(iteration, experiment::seconds([&] {
                   sink += avi::run_updates(f, method, f.start(), {.delta = 0.0, .iterations = n}).last.value;
                 }));
  }
  EXPECT_GT(sink, 0.0);
#ifdef NDEBUG
  EXPECT_LT(iteration, bound * evaluation);
#endif
  RecordProperty("ratio_percent", static_cast<int>(100.0 * iteration / evaluation));
  std::printf("one iteration costs %.2f evaluations of value and gradient (%.0f ns)\n",
              iteration / evaluation, 1e9 * evaluation / n);
}

}  // namespace optimiser_cost_test
