#include "src/choice/sketch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sketch_test {

using avi::VectorX, avi::detail::PointField, avi::detail::Sketch;

/// The field of H(q, p) of n degrees of freedom.
template <class H>
PointField field_of(int n, const H& hamiltonian) {
  avi::ExpressionGraph graph(2 * n);
  const auto q = avi::recorded_inputs(graph, 0, n), p = avi::recorded_inputs(graph, n, n);
  const int energy = avi::Recorded(hamiltonian(q, p)).node_in(graph);
  return {graph, energy, {}};
}
VectorX point(auto... entries) { return VectorX{{entries...}}; }

/// Oscillators of the frequencies 2 and 3, whose masses are 1/4 and 9.
PointField oscillators() {
  return field_of(2, [](const auto& q, const auto& p) {
    return 0.5 * (4.0 * p[0] * p[0] + q[0] * q[0]) + 0.5 * (p[1] * p[1] / 9.0 + 81.0 * q[1] * q[1]);
  });
}

TEST(PointField, IsHamiltonsEquations) {
  PointField field = oscillators();
  const VectorX z = point(1.0, 2.0, 0.5, 18.0);
  VectorX dz(4);
  EXPECT_EQ(field(z, dz), 0.5 * (1.0 + 1.0) + 0.5 * (36.0 + 324.0));
  EXPECT_EQ(dz, point(2.0, 2.0, -1.0, -162.0));
  field.sense = -1.0;
  field(z, dz);
  EXPECT_EQ(dz, point(-2.0, -2.0, 1.0, 162.0));
  // After many evaluations a program of H alone takes over.
  for (int k = 0; k < 100; ++k)
    EXPECT_EQ(field.energy(z.data(), z.data() + 2), 181.0) << k;
}

TEST(PointField, FindsTheDiagonalOfTheKineticEnergy) {
  const VectorX z = point(1.0, 2.0, 0.5, 18.0);
  EXPECT_LT((oscillators().metric(z) - point(4.0, 1.0 / 9.0)).norm(), 1e-15);
  // What is not positive counts as the largest entry that is; where none is, as 1.
  EXPECT_EQ(field_of(2, [](const auto& q, const auto& p) { return 3.0 * p[0] * p[0] - p[1] * p[1] + q[0]; })
                .metric(z),
            point(6.0, 6.0));
  EXPECT_EQ(field_of(2, [](const auto& q, const auto&) { return q[0] * q[0] + q[1]; }).metric(z),
            point(1.0, 1.0));
}

TEST(PointField, FindsTheFastestOscillation) {
  PointField field = oscillators();
  const VectorX z = point(1.0, 2.0, 0.5, 18.0);
  const double fastest = field.fastest(z, field.metric(z));
  EXPECT_LE(fastest, 3.0);
  EXPECT_GT(fastest, 2.9999) << "after eight iterations that divide what is slower by (3/2)^2 each";
  PointField free = field_of(1, [](const auto&, const auto& p) { return 0.5 * p[0] * p[0]; });
  EXPECT_EQ(free.fastest(point(1.0, 1.0), point(1.0)), 0.0);
}

TEST(PointField, TellsWhatRelativeErrorsOfTheStateDoToItsSlopes) {
  // Of the field of an oscillator, exactly that; 5e-8 is what rounding leaves of differences over 1e-7.
  PointField field = oscillators();
  const VectorX z = point(1.0, 2.0, 0.5, 18.0);
  VectorX dz(4);
  field(z, dz);
  const Sketch::Sample::Numbers at(z.data(), 4), slope(dz.data(), 4);
  for (const unsigned draw : {0u, 1u, 7u}) {
    VectorX most = VectorX::Zero(4);
    field.add_sensitivity(at, slope, draw, most);
    EXPECT_LT((most - dz.cwiseAbs()).norm(), 1e-7) << draw;
  }
}

/// Of frequency 5.
PointField spring() {
  return field_of(1, [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0] + 25.0 * q[0] * q[0]); });
}
const VectorX unit = point(1.0);

// In the middle of a well no force acts, and after a long step none is left.
TEST(Sketch, OfWhatNoForcePushesAtFirstFollowsTheMotion) {
  PointField springs = oscillators();
  VectorX dz(4);
  const VectorX metric = point(4.0, 1.0 / 9.0), z = point(0.0, 2.0, 0.5, 18.0);
  springs(z, dz);
  EXPECT_DOUBLE_EQ(springs.frequency_of_unpushed(z, dz, metric), 2.0);
  springs(point(1.0, 2.0, 0.5, 18.0), dz);
  EXPECT_EQ(springs.frequency_of_unpushed(point(1.0, 2.0, 0.5, 18.0), dz, metric), 0.0);
  const auto morse = [](const auto& q, const auto& p) {
    const auto x = 1.0 - exp(-q[0]);
    return 0.5 * p[0] * p[0] + x * x;
  };
  for (const double span : {5e4, 1e9}) {
    PointField field = field_of(1, morse);
    const Sketch sketch(field, point(0.0, 1.3), span, point(1.0));
    EXPECT_LT(sketch.time, 100.0) << span;
    EXPECT_GT(sketch.radians, 6.0) << span;
  }
}

TEST(Sketch, CountsTheRadiansOfASpring) {
  PointField field = spring();
  const Sketch sketch(field, point(1.0, 0.0), 3.0, unit);
  EXPECT_NEAR(sketch.time, 3.0, 1e-15);
  EXPECT_FALSE(sketch.stuck);
  EXPECT_NEAR(sketch.radians / sketch.time, 5.0, 0.6);
  double time = 0.0, radians = 0.0, last = 0.0;
  for (const Sketch::Sample& sample : sketch.samples) {
    EXPECT_NEAR(sample.frequency, 5.0, 0.8);
    EXPECT_NEAR(sample.energy, 0.5 * (sample.z[1] * sample.z[1] + 25.0 * sample.z[0] * sample.z[0]), 1e-14);
    EXPECT_LT((sample.slope - point(sample.z[1], -25.0 * sample.z[0])).norm(), 1e-14);
    EXPECT_NEAR(sample.z[0], std::cos(5.0 * time), 0.25) << "a rough run";
    time += sample.h;
    radians += sample.h * sample.frequency;
    EXPECT_NEAR(sketch.time_of(radians), time, 1e-14);
    EXPECT_NEAR(sketch.time_of(0.5 * (last + radians)), time - 0.5 * sample.h, 1e-14);
    last = radians;
  }
  EXPECT_NEAR(time, sketch.time, 1e-14);
  EXPECT_NEAR(radians, sketch.radians, 1e-14);
  EXPECT_NEAR(sketch.time_of(4.0 * sketch.radians), 4.0 * sketch.time, 1e-13) << "beyond its end as on it";
}

TEST(Sketch, EndsWhereTheOrbitComesAgain) {
  PointField field = spring();
  const Sketch once(field, point(1.0, 0.0), 100.0, unit, 512);
  EXPECT_GT(once.time, 2.0 * M_PI / 5.0);
  EXPECT_LT(once.time, 10.0);
  // Not one that goes on from elsewhere, nor one whose steps are counted.
  EXPECT_NEAR(Sketch(field, point(1.0, 0.0), 30.0, unit, 512, 5.0).time, 30.0, 1e-13);
  EXPECT_EQ(Sketch(field, point(1.0, 0.0), 100.0, unit, 20).samples.size(), 20u);
}

TEST(Sketch, IsStuckBeforeACollision) {
  // From rest at distance 1 a body falls into the centre in pi / sqrt(8).
  PointField field =
      field_of(1, [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - 1.0 / sqrt(q[0] * q[0]); });
  const Sketch sketch(field, point(1.0, 0.0), 10.0, unit, 512);
  EXPECT_TRUE(sketch.stuck);
  EXPECT_NEAR(sketch.time, M_PI / std::sqrt(8.0), 0.01);
  EXPECT_LT(sketch.samples.back().h, 1e-9);
}

TEST(Sketch, OfABodyAtRestHasNoFrequency) {
  PointField field = spring();
  const Sketch rest(field, point(0.0, 0.0), 10.0, unit);
  EXPECT_EQ(rest.time, 10.0);
  EXPECT_EQ(rest.radians, 0.0);
  EXPECT_EQ(rest.time_of(20.0), avi::detail::infinity);
  const Sketch none(field, point(1.0, 0.0), 0.0, unit);
  EXPECT_TRUE(none.samples.empty());
  EXPECT_EQ(none.time_of(20.0), avi::detail::infinity);
}

// Behind a pericentre of 0.007 a body has lost as much energy as all of its motion is: what would follow
// falls into the centre, where the orbit does not.
TEST(Sketch, EndsWhereAPoleHasTakenItsEnergy) {
  PointField field = field_of(2, [](const auto& q, const auto& p) {
    return 0.5 * p.squaredNorm() - 1.0 / sqrt(q.squaredNorm()) - 0.5 * q[0];
  });
  const Sketch sketch(field, point(0.5, 0.0, 0.0, std::sqrt(3.0)), 13.4, VectorX::Ones(2), 512);
  EXPECT_FALSE(sketch.stuck);
  EXPECT_NEAR(sketch.time, 2.53, 0.05);
  EXPECT_GT(sketch.samples.back().h, 1e-4);
}

}  // namespace sketch_test
