// data: kepler_e090 kepler_e099
#include "frame/timing.hpp"

#include "avi/adaptive/monitors.hpp"
#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/io/table.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

#include <string>

// Ratios of times measured in turns within one run. They hold for optimised code only.

namespace {

struct Cost {
  double seconds, steps;
};

Cost cost(const std::string& stem, const std::string& method, const std::string& monitor) {
  const auto table = avi::Table::read(std::string(AVI_CHECK_DIR) + "/data/" + stem + ".tsv");
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.text(i, "method") == method && table.text(i, "monitor") == monitor &&
        (method != "htvi4" || table.text(i, "construction") == "authors"))
      return {table.number(i, "seconds"), table.number(i, "steps")};
  throw std::runtime_error("no row " + method + " " + monitor);
}

bool optimised() {
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
  return true;
#else
  return false;
#endif
}

TEST(Speed, AdaptiveHtvi4BeatsStormerVerletAtItsPublishedStep) {
  if (!optimised()) GTEST_SKIP() << "not optimised";
  const auto e090 = cost("kepler_e090", "htvi4", "gamma"), e099 = cost("kepler_e099", "htvi4", "gamma");
  const auto verlet_090 = cost("kepler_e090", "stormer_verlet", "none"),
             verlet_099 = cost("kepler_e099", "stormer_verlet", "none");
  EXPECT_LT(e090.seconds, verlet_090.seconds / 20.0) << "measured 1/28 to 1/33";
  EXPECT_LT(e099.seconds, verlet_099.seconds / 1000.0) << "measured 1/1250 to 1/2300";
  const double step = e090.seconds / e090.steps, verlet_step = verlet_090.seconds / verlet_090.steps;
  EXPECT_LT(step, 60.0 * verlet_step) << "measured 31 to 36";
}

TEST(Speed, AutomaticGradientCostsAtMostFourTimesTheSuppliedOne) {
  if (!optimised()) GTEST_SKIP() << "not optimised";
  const auto start = avi::Kepler::pericentre(0.9);
  const auto monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
  auto supplied =
      avi::type2<3, avi::authors>(avi::poincare<2>(avi::Kepler{}, start, monitor), avi::simpson());
  auto automatic = avi::type2<3, avi::authors>(
      avi::poincare<2>(avi::Automatic{avi::Kepler{}}, start, monitor), avi::simpson());
  auto a = start, b = start;
  const auto times =
      experiment::interleaved_least_seconds({[&] {
                                               a = start;
                                               (void)avi::integrate(supplied, a, 0.1, {.steps = 500});
                                             },
                                             [&] {
                                               b = start;
                                               (void)avi::integrate(automatic, b, 0.1, {.steps = 500});
                                             }},
                                            41);
  EXPECT_LT(times[1], 4.0 * times[0]);
  EXPECT_NEAR((a.q - b.q).norm(), 0.0, 1e-9) << "and gives the same orbit";
}

}  // namespace
