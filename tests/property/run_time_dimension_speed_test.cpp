// alone: compares times
#include "frame/timing.hpp"

#include "avi/adaptive/monitors.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

/// Least time of steps with the dimension 2 known at run time over that with it known to the compiler.
template <int r>
double time_ratio(const avi::Quadrature& rule, double bound) {
  const avi::Automatic energy{avi::Kepler{}};
  const auto monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
  const auto start = avi::Kepler::pericentre(0.9);
  const avi::State<avi::dynamic> same{.q = start.q, .p = start.p};
  auto fixed = avi::type2<r>(avi::poincare<2>(energy, start, monitor), rule);
  auto free = avi::type2<r>(avi::poincare<avi::dynamic>(energy, same, monitor), rule);
  const auto steps = [](auto& method, const auto& from) {
    auto z = from;
    for (int k = 0; k < 200; ++k)
      EXPECT_EQ(method.step(z, 0.1).outcome, avi::Outcome::ok);
  };
  double least[2] = {1.0, 1.0};
  for (int turn = 0; turn < 40 && (turn < 2 || least[0] > bound * least[1]); ++turn) {
    const auto times =
        experiment::interleaved_least_seconds({[&] { steps(free, same); }, [&] { steps(fixed, start); }}, 11);
    for (std::size_t i : {0u, 1u})
      least[i] = std::min(least[i], times[i]);
  }
  return least[0] / least[1];
}

TEST(RunTimeDimension, TakesUpToThreeTimesAsLongAtDimensionTwo) {
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
  const double fourth = time_ratio<3>(avi::simpson(), 3.0), eighth = time_ratio<7>(avi::gauss(4), 3.0);
  RecordProperty("order_4", std::to_string(fourth));
  RecordProperty("order_8", std::to_string(eighth));
  EXPECT_LT(fourth, 3.0);  // 1.6 to 1.9
  EXPECT_LT(eighth, 3.0);  // 1.4
#else
  GTEST_SKIP() << "Times are compared in optimised builds only.";
#endif
}

}  // namespace
