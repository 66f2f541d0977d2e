#include "avi/adaptive/monitors.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"
#include "property/run_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>

// The dimension known only at run time: the same formulas, partials a few at a time.

using avi::dynamic;
using avi::Generating;

namespace {

/// Largest difference between the two over some steps of Kepler's problem through pericentre.
template <Generating type, avi::Construction construction, class G>
double largest_gap(int r, const G& monitor) {
  const avi::Automatic energy{avi::Kepler{}};
  auto fixed = avi::Kepler::pericentre(0.6);
  auto free = run_time(fixed);
  auto a = avi::htvi_of_order<type, construction>(r, avi::poincare<2>(energy, fixed, monitor), avi::gauss(3));
  auto b =
      avi::htvi_of_order<type, construction>(r, avi::poincare<dynamic>(energy, free, monitor), avi::gauss(3));
  double worst = 0.0;
  for (int k = 0; k < 40; ++k) {
    EXPECT_EQ(a.step(fixed, 0.1).outcome, avi::Outcome::ok);
    EXPECT_EQ(b.step(free, 0.1).outcome, avi::Outcome::ok);
    worst = std::max(worst, gap(fixed, free));
  }
  return worst;
}

TEST(RunTimeDimension, GivesTheSameSteps) {
  const auto gamma = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
  for (int r : {0, 2, 5})
    EXPECT_LT((largest_gap<Generating::type2, avi::superconvergent>(r, gamma)), 2e-13) << r;
}

TEST(RunTimeDimension, GivesTheSameStepsWithEveryTermOfAMonitorOfTheMomentum) {
  const auto energy = avi::bounded(avi::Energy{avi::Kepler{}, 0.5}, 1e-2, 2.0);
  for (int r : {1, 4})
    EXPECT_LT((largest_gap<Generating::type3, avi::printed>(r, energy)), 2e-13) << r;
}

}  // namespace
