#include "avi/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// @file
/// Orbits on which two runs meet by chance, and a third one does not.

namespace confirmed_test {

using avi::solve, avi::State;

/// The error of the end over the tolerance, relative to the ranges of a coordinate and of a momentum.
template <int n, class H>
double error(const H& h, const State<n>& start, double end, double tolerance, double range_q,
             double range_p) {
  const auto orbit = solve(h, start, end, tolerance), exact = solve(h, start, end, 1e-12);
  EXPECT_TRUE(orbit.kept() && exact.kept()) << orbit.report() << exact.report();
  return std::max((orbit.state.q - exact.state.q).cwiseAbs().maxCoeff() / range_q,
                  (orbit.state.p - exact.state.p).cwiseAbs().maxCoeff() / range_p) /
         tolerance;
}

// One of two pendulums rests near the top while the other one falls: both runs erred by 491 tolerances.
TEST(Confirmed, AreOrbitsOfWhichAPartRestsAtASaddle) {
  const auto pendulums = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - cos(q[0]) - cos(q[1]) -
           0.00018935226792097065 * cos(q[0] - q[1]);
  };
  const State<2> start{.q = {3.1415787328360172, 3.13642128566359}, .p = {0.0, 0.0}};
  EXPECT_LT(error(pendulums, start, 19.370381556334927, 1e-5, 6.0, 2.0), 0.3);  // measured 0.14
}

// Two runs erred by 368 tolerances, and, of a heavy spring that swings over its top, by 133.
TEST(Confirmed, AreOrbitsThatHardlyPassABarrier) {
  const auto barrier = [](const auto& q, const auto& p) {
    const auto s = exp(-0.5 * q[0] * q[0]), off = q[1] - 0.14320988359216499 * s;
    constexpr double w = 0.96963831840896275;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + s + 0.5 * (w * w) * off * off;
  };
  const State<2> passing{.q = {-5.4088624743629241, 0.0}, .p = {1.4142142324893996, 0.0}};
  EXPECT_LT(error(barrier, passing, 24.760294075247263, 1e-7, 1.0, 0.5), 0.1);  // measured 0.04
  const auto elastic = [](const auto& q, const auto& p) {
    const auto longer = sqrt(q[0] * q[0] + q[1] * q[1]) - 1.0;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * 3.1118162530323228 * longer * longer + q[1];
  };
  const State<2> swinging{.q = {0.32209062719362963, 1.1171373255013517}, .p = {0.059363998950735936, 0.0}};
  EXPECT_LT(error(elastic, swinging, 52.586935847132139, 1e-4, 2.0, 2.0), 0.002);  // measured 0.0008
}

// A momentum moves by a forty-thousandth of what it is, and what the sweeps left is relative to that.
TEST(Confirmed, AreOrbitsWhoseMomentaHardlyMove) {
  const auto bottle = [](const auto& q, const auto& p) {
    const auto f = 0.5 * 4.0614971909054827 * (1.0 + q[2] * q[2] - 0.25 * (q[0] * q[0] + q[1] * q[1]));
    const auto x = p[0] + f * q[1], y = p[1] - f * q[0];
    return 0.5 * (x * x + y * y + p[2] * p[2]);
  };
  const State<3> start{.q = {-0.12930086633176424, -0.31678068448645519, 0.033179066766149456},
                       .p = {0.63935876790881407, -0.2551817070742321, 0.94750331138008781}};
  const double end = 0.033238349728416307;
  const auto orbit = solve(bottle, start, end, 1e-7), exact = solve(bottle, start, end, 1e-12);
  EXPECT_TRUE(orbit.kept()) << orbit.report();
  EXPECT_LT(std::abs(orbit.state.p[0] - exact.state.p[0]),
            1e-9 * std::abs(exact.state.p[0] - start.p[0]));  // the same
}

}  // namespace confirmed_test
