#include "avi/automatic/tour.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tour_test {

using avi::PhaseFunction;
using avi::State;
using avi::detail::Curvature;
using avi::detail::Tour;

/// The tour of H from (q, p), and monitors in its graph.
struct Toured {
  avi::detail::Orbit orbit;
  Curvature curvature{orbit};
  Tour tour{orbit, curvature};
  template <class H>
  Toured(const H& h, double q, double p)
      : orbit(h, State<1>{.q = avi::Vector<double, 1>(q), .p = avi::Vector<double, 1>(p)}) {}
  template <class G>
  [[nodiscard]] static PhaseFunction monitor(const G& g) {
    avi::ExpressionGraph graph(2);
    const int node = g(avi::Recorded(graph, 0)).node_in(graph);
    return {graph, node};
  }
};

// omega = 3: 64 steps of 0.3 / omega, each of four evaluations, on an ellipse of energy 9 / 2.
const auto oscillator = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0]) + 4.5 * (q[0] * q[0]);
};

TEST(Tour, HasTheMeansOfAnOscillator) {
  const Toured at(oscillator, 1.0, 0.0);
  EXPECT_NEAR(at.tour.frequency, 3.0, 1e-14);
  EXPECT_NEAR(at.tour.time, 6.4, 1e-13);
  EXPECT_EQ(at.tour.evaluations, 1 + 64 * 4);
  EXPECT_NEAR(at.tour.squared_speed, 9.0, 4e-3);
  EXPECT_NEAR(at.tour.kinetic, 9.0 / 4.0, 0.1);
}

TEST(Tour, LooksAtMonitors) {
  const Toured at(oscillator, 1.0, 0.0);
  const auto constant = at.monitor([](const auto& q) { return 0.5 + 0.0 * q; });
  EXPECT_NEAR(at.tour.look(constant).unevenness, 1.0, 1e-13);
  EXPECT_NEAR(at.tour.fictive_time(constant, 1.234), 2.468, 1e-13);
  EXPECT_NEAR(at.tour.fictive_time(constant, 100.0), 200.0, 1e-11) << "carried on";
  const auto uneven = at.monitor([](const auto& q) { return 1.0 / (1.0 + q * q); });
  const auto look = at.tour.look(uneven);
  EXPECT_NEAR(look.low, 0.5, 1e-3);
  EXPECT_NEAR(look.high, 1.0, 2e-2);
  EXPECT_NEAR(look.unevenness, 1.5, 0.03) << "the mean of 1 + q^2, times the largest g";
  const auto infinite = at.monitor([](const auto& q) { return 1.0 / (q - 1.0); });
  EXPECT_TRUE(std::isnan(at.tour.look(infinite).high));
}

TEST(Tour, KnowsWhenAnAngleIsPassed) {
  const Toured at(oscillator, 1.0, 0.0);
  EXPECT_NEAR(at.tour.time_of(6.0), 2.0, 0.1 + 1e-12);
  EXPECT_NEAR(at.tour.time_of(30.0), 10.0, 1e-3) << "beyond the tour as it was on it";
}

// Free flight into a wall: the local time scale says nothing of it, and steps are halved until H is kept.
TEST(Tour, ShortensStepsWhereHChangesSteeply) {
  const auto wall = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0]) + exp(-8.0 * q[0]); };
  const Toured at(wall, 3.0, -1.0);
  EXPECT_NEAR(at.tour.time / 636973.0, 1.0, 0.01) << "nearly all of it free flight after the wall";
}

// The step grows by two at most, so that a tour which comes from where n_0 is small sees where it is large.
TEST(Tour, GoesThroughAWell) {
  const auto well = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0]) - 20.0 * exp(-1.0 * (q[0] * q[0])) + 0.005 * (q[0] * q[0]);
  };
  const Toured at(well, 6.0, -0.5);
  EXPECT_NEAR(at.tour.time, 34.72, 0.05);
  EXPECT_NEAR(at.tour.frequency, 0.4458, 0.001);
}

TEST(Tour, BeginsWhereTheCurvatureVanishes) {
  const auto quartic = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0]) + 0.25 * (q[0] * q[0]) * (q[0] * q[0]);
  };
  EXPECT_NEAR(Toured(quartic, 0.0, 1.0).tour.frequency, 1.2046, 0.01);
}

TEST(Tour, EndsBeforeItBeginsWhereTheCurvatureIsInfinite) {
  const auto cusp = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0]) + pow(q[0], 1.5); };
  const Toured at(cusp, 0.0, 1.0);
  EXPECT_EQ(at.tour.evaluations, 1);
  EXPECT_EQ(at.tour.time, 0.0);
}

}  // namespace tour_test
