#include "src/choice/distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace distance_test {

using avi::VectorX, avi::detail::Distance, avi::detail::Ranges;
using State = avi::State<avi::dynamic>;

VectorX vector(auto... entries) { return VectorX{{entries...}}; }
/// Of everything between two states.
Ranges between(const State& a, const State& b) {
  Ranges ranges(a);
  ranges.add(b);
  return ranges;
}
const VectorX metric = vector(1.0, 4.0);
/// Ranges of 2 and 1/2 of positions, 4 and 1 of momenta.
const Ranges usual = between({.q = {-1.0, 3.5}, .p = {0.0, 2.0}}, {.q = {1.0, 3.0}, .p = {4.0, 1.0}});

TEST(Distance, IsTheLargestDifferenceByTheRangeOfItsEntry) {
  const Distance distance(metric, 1e-6, 2);
  EXPECT_EQ(distance.scales(usual), vector(2.0, 0.5, 4.0, 1.0));
  const State here{.q = {0.0, 3.25}, .p = {1.0, 1.5}};
  EXPECT_EQ(distance(here, here, usual), 0.0);
  const auto moved = [&](double q0, double q1, double p0, double p1) {
    return distance(here, {.q = {q0, 3.25 + q1}, .p = {1.0 + p0, 1.5 + p1}}, usual);
  };
  EXPECT_EQ(moved(-0.5, 0.0, 0.0, 0.0), 0.25);
  EXPECT_EQ(moved(0.5, 0.25, 0.0, 0.0), 0.5);
  EXPECT_EQ(moved(0.5, 0.0, 1.5, 0.0), 0.375);
  EXPECT_EQ(moved(0.5, 0.0, 1.5, -0.75), 0.75);
  EXPECT_EQ(moved(0.0, 0.0, 0.0, NAN), avi::detail::infinity);
  EXPECT_EQ(distance(vector(0.5, -0.25, 1.0, 0.25), usual), 0.5) << "of a velocity";
  EXPECT_EQ(distance(vector(0.5, 0.0, 1.0, 0.75), usual), 0.75) << "of a velocity";
  // What is not seen does not count.
  const Distance of_first(metric, 1e-6, 1);
  EXPECT_EQ(of_first(here, {.q = {0.5, 100.0}, .p = {1.0, 100.0}}, usual), 0.25);
  EXPECT_EQ(of_first(vector(0.0, 100.0, 1.0, 100.0), usual), 0.25);
}

TEST(Distance, CountsAMomentumThatHardlyChangesByItsSize) {
  const Ranges ranges = between({.q = {-1.0, 3.5}, .p = {-64.0, 2.0}}, {.q = {1.0, 3.0}, .p = {-64.0, 1.0}});
  EXPECT_EQ(Distance(metric, 1e-4, 2).scales(ranges)[2], 64e-8);
  EXPECT_DOUBLE_EQ(Distance(metric, 1e-10, 2).scales(ranges)[2], 64.0 * 30.0 * 0x1p-52 / 1e-10)
      << "rounding is the tolerance";
}

TEST(Distance, CountsWhatIsAtRestByItsPlace) {
  const Ranges ranges = between({.q = {-1.0, -8.0}, .p = {0.0, 0.0}}, {.q = {1.0, -8.0}, .p = {4.0, 0.0}});
  Distance distance(metric, 1e-6, 2);
  EXPECT_EQ(distance.scales(ranges)[1], 8.0);
  // Its momentum is that of a motion through its place, once the frequency is known.
  EXPECT_LT(distance.scales(ranges)[3], 1e-12);
  distance.frequency = 3.0;
  EXPECT_EQ(distance.scales(ranges)[3], 3.0 * 8.0 / 4.0);
  EXPECT_EQ(distance.scales(usual), vector(2.0, 0.5, 4.0, 1.0)) << "where entries move that says nothing";
}

TEST(Distance, TakesTheRangeOfRoundingForNone) {
  // Near the origin, where its place says nothing, an entry moves by 1e-18.
  const Ranges ranges = between({.q = {-1.0, 0.0}, .p = {0.0, 0.0}}, {.q = {1.0, 1e-18}, .p = {4.0, 1e-18}});
  Distance distance(vector(4.0, 16.0), 1e-6, 2);
  EXPECT_DOUBLE_EQ(distance.scales(ranges)[1], 1e-14 * (2.0 / 2.0) * 4.0)
      << "of the largest motion, masses taken out";
  EXPECT_DOUBLE_EQ(distance.scales(ranges)[3], 1e-14 * (4.0 * 2.0) / 4.0);
  // Where rounding is known to be less, that is a motion; where more, the largest motion is its scale.
  distance.noise = vector(0.0, 1e-19, 0.0, 1e-19);
  EXPECT_DOUBLE_EQ(distance.scales(ranges)[1], 1e-18);
  EXPECT_DOUBLE_EQ(distance.scales(ranges)[3], 1e-18);
  distance.noise = vector(0.0, 1e-17, 0.0, 1e-17);
  EXPECT_EQ(distance.scales(ranges)[1], 4.0);
  EXPECT_EQ(distance.scales(ranges)[3], 2.0);
}

}  // namespace distance_test
