#include "beyond/speed/automatic_monitors/orbit_scales.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace orbit_scales_test {

using avi::State;
using experiment::Curvature;
using experiment::OrbitScales;

/// The scales of H from (q, p), and monitors in its graph.
struct Measured {
  experiment::Orbit orbit;
  Curvature curvature{orbit};
  OrbitScales scales{orbit, curvature};
  template <class H>
  Measured(const H& h, double q, double p)
      : orbit(h, State<1>{.q = avi::Vector<double, 1>(q), .p = avi::Vector<double, 1>(p)}) {}
  template <class G>
  [[nodiscard]] static avi::Formula monitor(const G& g) {
    avi::ExpressionGraph graph(2);
    const int node = g(avi::Recorded(graph, 0)).node_in(graph);
    return {graph, node};
  }
};

// omega = 3: 64 steps of 0.3 / omega, each of four evaluations, on an ellipse of energy 9 / 2.
const auto oscillator = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0]) + 4.5 * (q[0] * q[0]);
};

TEST(OrbitScales, HasTheMeansOfAnOscillator) {
  const Measured at(oscillator, 1.0, 0.0);
  EXPECT_NEAR(at.scales.frequency, 3.0, 1e-14);
  EXPECT_NEAR(at.scales.time, 6.4, 1e-13);
  EXPECT_EQ(at.scales.evaluations, 1 + 64 * 4);
  EXPECT_NEAR(at.scales.squared_speed, 9.0, 4e-3);
  EXPECT_NEAR(at.scales.kinetic, 9.0 / 4.0, 0.1);
}

TEST(OrbitScales, LooksAtMonitors) {
  const Measured at(oscillator, 1.0, 0.0);
  const auto constant = at.monitor([](const auto& q) { return 0.5 + 0.0 * q; });
  EXPECT_NEAR(at.scales.range(constant).unevenness, 1.0, 1e-13);
  EXPECT_NEAR(at.scales.fictive_time(constant, 1.234), 2.468, 1e-13);
  EXPECT_NEAR(at.scales.fictive_time(constant, 100.0), 200.0, 1e-11) << "carried on";
  const auto uneven = at.monitor([](const auto& q) { return 1.0 / (1.0 + q * q); });
  const auto range = at.scales.range(uneven);
  EXPECT_NEAR(range.low, 0.5, 1e-3);
  EXPECT_NEAR(range.high, 1.0, 2e-2);
  EXPECT_NEAR(range.unevenness, 1.5, 0.03) << "the mean of 1 + q^2, times the largest g";
  const auto infinite = at.monitor([](const auto& q) { return 1.0 / (q - 1.0); });
  EXPECT_TRUE(std::isnan(at.scales.range(infinite).high));
}

TEST(OrbitScales, KnowsWhenAnAngleIsPassed) {
  const Measured at(oscillator, 1.0, 0.0);
  EXPECT_NEAR(at.scales.time_of(6.0), 2.0, 0.1 + 1e-12);
  EXPECT_NEAR(at.scales.time_of(30.0), 10.0, 1e-3) << "beyond the run as it was on it";
}

// Free flight into a wall: the local time scale says nothing of it, and steps are halved until H is kept.
TEST(OrbitScales, ShortensStepsWhereHChangesSteeply) {
  const auto wall = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0]) + exp(-8.0 * q[0]); };
  const Measured at(wall, 3.0, -1.0);
  EXPECT_NEAR(at.scales.time / 636973.0, 1.0, 0.01) << "nearly all of it free flight after the wall";
}

// The step grows by two at most, so that a run which comes from where n_0 is small sees where it is large.
TEST(OrbitScales, GoesThroughAWell) {
  const auto well = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0]) - 20.0 * exp(-1.0 * (q[0] * q[0])) + 0.005 * (q[0] * q[0]);
  };
  const Measured at(well, 6.0, -0.5);
  EXPECT_NEAR(at.scales.time, 34.72, 0.05);
  EXPECT_NEAR(at.scales.frequency, 0.4458, 0.001);
}

TEST(OrbitScales, BeginsWhereTheCurvatureVanishes) {
  const auto quartic = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0]) + 0.25 * (q[0] * q[0]) * (q[0] * q[0]);
  };
  EXPECT_NEAR(Measured(quartic, 0.0, 1.0).scales.frequency, 1.2046, 0.01);
}

TEST(OrbitScales, EndsBeforeItBeginsWhereTheCurvatureIsInfinite) {
  const auto cusp = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0]) + pow(q[0], 1.5); };
  const Measured at(cusp, 0.0, 1.0);
  EXPECT_EQ(at.scales.evaluations, 1);
  EXPECT_EQ(at.scales.time, 0.0);
}

}  // namespace orbit_scales_test
