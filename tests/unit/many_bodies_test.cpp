#include "avi/avi.hpp"
#include "common/problems/double_pendulum.hpp"
#include "common/problems/outer_solar_system.hpp"
#include "difference.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using avi::dynamic, avi::State, avi::Vector, experiment::OuterSolarSystem;

namespace many_bodies_test {

/// Largest difference between what H supplies and differences of fourth order, over the largest derivative.
template <class H, int n>
double gradient_defect(const H& h, const State<n>& z, const Vector<double, n>& d_dq,
                       const Vector<double, n>& d_dp) {
  const auto of_q = [&](const Vector<double, n>& q) { return h(q, z.p); };
  const auto of_p = [&](const Vector<double, n>& p) { return h(z.q, p); };
  return std::max(
      ::gradient_defect(of_q, z.q, d_dq, 1e-3 * z.q.cwiseAbs().maxCoeff()) / d_dq.cwiseAbs().maxCoeff(),
      ::gradient_defect(of_p, z.p, d_dp, 1e-3 * z.p.cwiseAbs().maxCoeff()) / d_dp.cwiseAbs().maxCoeff());
}

template <class H, int n>
State<n> after(const H& h, State<n> z, double step, long steps) {
  auto method =
      avi::splitting<avi::Summation::compensated>(avi::Separable<H>{h}, avi::compositions::kahan_li8);
  EXPECT_EQ(avi::integrate(method, z, step, {.steps = steps}).outcome, avi::Outcome::ok);
  return z;
}

TEST(OuterSolarSystem, SuppliesTheGradientOfItsEnergy) {
  const auto problem = OuterSolarSystem::problem();
  const auto z = OuterSolarSystem::start();
  EXPECT_LT(gradient_defect(problem, z, problem.d_dq(z.q, z.p), problem.d_dp(z.q, z.p)), 1e-6);
  const avi::NBody<dynamic, 3> free(problem.masses());
  EXPECT_EQ(problem.d_dq(z.q, z.p), free.d_dq(Vector<double, dynamic>(z.q), Vector<double, dynamic>()));
}

TEST(OuterSolarSystem, KeepsEnergyMomentumAndAngularMomentum) {
  const auto problem = OuterSolarSystem::problem();
  const auto start = OuterSolarSystem::start(), z = after(problem, start, 100.0, 1000);  // 270 years
  EXPECT_NEAR(problem(z.q, z.p) / problem(start.q, start.p), 1.0, 1e-10);
  using Bodies = avi::NBody<6, 3>;
  EXPECT_LT((Bodies::momentum(z) - Bodies::momentum(start)).norm(), 4e-15 * start.p.norm());
  for (const auto& [k, l] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{2, 0}})
    EXPECT_NEAR(Bodies::angular_momentum(z, k, l) / Bodies::angular_momentum(start, 0, 1),
                Bodies::angular_momentum(start, k, l) / Bodies::angular_momentum(start, 0, 1), 1e-13);
  EXPECT_GT((z.q - start.q).norm(), 1.0);
  const State<6> three{.q = {}, .p = {1.0, 10.0, 2.0, 20.0, 4.0, 40.0}};
  EXPECT_EQ(avi::NBody<3>::momentum(three), (Vector<double, 2>(7.0, 70.0)));
}

// Heliocentric orbits from the start, against the masses, sidereal years and mean elements of the planets in
// textbooks: what they do to each other moves the eccentricities by some thousandths.
TEST(OuterSolarSystem, HasTheMassesAndElementsOfThePlanets) {
  EXPECT_NEAR(std::sqrt(OuterSolarSystem::gravity), 0.01720209895, 1e-13) << "Gauss' constant";
  const auto masses = OuterSolarSystem::problem().masses();
  EXPECT_NEAR(masses[0] / OuterSolarSystem::gravity - 1.0,
              1.0 / 6023600.0 + 1.0 / 408523.7 + 1.0 / 328900.56 + 1.0 / 3098708.0, 1e-9)
      << "Mercury, Venus, Earth with Moon, and Mars are in the Sun";
  struct Elements {
    double years, inverse_mass, eccentricity, perihelion, inclination, node;  // angles in degrees
  };
  const Elements known[] = {{11.86, 1047.35, 0.0485, 14.7, 1.303, 100.5},
                            {29.46, 3497.9, 0.0555, 92.6, 2.489, 113.7},
                            {84.01, 22902.9, 0.0460, 170.9, 0.773, 74.0},
                            {164.8, 19412.2, 0.0086, 44.9, 1.770, 131.8},
                            {247.9, 1.35e8, 0.2488, 224.1, 17.14, 110.3}};
  constexpr double degree = M_PI / 180.0, tilt = 23.4393 * degree;  // of the equator against the ecliptic
  const auto z = OuterSolarSystem::start();
  EXPECT_EQ(z.q.head<3>().norm() + z.p.head<3>().norm(), 0.0) << "the Sun, from which all is measured";
  for (int planet = 1; planet <= 5; ++planet) {
    const Elements& of = known[planet - 1];
    EXPECT_NEAR(masses[0] / masses[planet] / of.inverse_mass, 1.0, 0.04) << planet;
    const Eigen::Vector3d x = z.q.segment<3>(3 * planet), v = z.p.segment<3>(3 * planet) / masses[planet];
    const double pull = masses[0] + masses[planet], axis = 1.0 / (2.0 / x.norm() - v.squaredNorm() / pull);
    EXPECT_NEAR(2.0 * M_PI * std::sqrt(axis * axis * axis / pull) / 365.25 / of.years, 1.0, 0.015) << planet;
    const auto ecliptic = [&](const Eigen::Vector3d& w) -> Eigen::Vector3d {
      return Eigen::AngleAxisd(-tilt, Eigen::Vector3d::UnitX()) * w;
    };
    const Eigen::Vector3d turn = x.cross(v), pole = ecliptic(turn.normalized()),
                          shape = ecliptic(v.cross(turn) / pull - x.normalized());
    EXPECT_NEAR(std::acos(pole[2]) / degree, of.inclination, 0.02) << planet;
    EXPECT_NEAR(std::atan2(pole[0], -pole[1]) / degree, of.node, 0.1) << planet;
    // To where the perihelion is, as long as the eccentricity: angles add up along the orbit.
    const double node = std::atan2(pole[0], -pole[1]);
    const Eigen::Vector3d line(std::cos(node), std::sin(node), 0.0);
    const double perihelion = node + std::atan2(line.cross(shape).dot(pole), line.dot(shape));
    EXPECT_LT(
        std::abs(std::polar(shape.norm(), perihelion) - std::polar(of.eccentricity, of.perihelion * degree)),
        0.008)
        << planet;
  }
}

/// Seven stars of masses 1, 2, ... 7 in the plane with several close encounters until t = 3, the nearest at a
/// distance of 0.034 (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, Section
/// II.10).
struct Pleiades {
  static constexpr double horizon = 3.0;  ///< End of the time interval of the source.
  static avi::NBody<7> problem() {
    return avi::NBody<7>(avi::NBody<7>::Masses{{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}});
  }
  /// Four of the stars are at rest.
  static State<14> start() {
    State<14> z{.q = Vector<double, 14>::Zero(), .p = Vector<double, 14>::Zero()};
    z.q << 3.0, 3.0, 3.0, -3.0, -1.0, 2.0, -3.0, 0.0, 2.0, 0.0, -2.0, -4.0, 2.0, 4.0;
    z.p[7] = 4.0 * -1.25;
    z.p[9] = 5.0 * 1.0;
    z.p[10] = 6.0 * 1.75;
    z.p[12] = 7.0 * -1.5;
    return z;
  }
};

// The positions at t = 3 of the Bari test set for initial value solvers (problem PLEI), all of whose digits
// but the last ones agree.
TEST(Pleiades, EndWhereOthersFoundThem) {
  const double x[] = {0.3706139143970502, 3.237284092057233, -3.222559032418324, 0.6597091455775310,
                      0.3425581707156584, 1.562172101400631, -0.7003092922212495};
  const double y[] = {-3.943437585517392, -3.271380973972550,  5.225081843456543, -2.590612434977470,
                      1.198213693392275,  -0.2429682344935824, 1.091449240428980};
  const auto problem = Pleiades::problem();
  const auto start = Pleiades::start();
  const long steps = 40000;
  double nearest = std::numeric_limits<double>::infinity();
  auto z = start;
  auto method = avi::splitting<avi::Summation::compensated>(avi::Separable<avi::NBody<7>>{problem},
                                                            avi::compositions::kahan_li8);
  const auto look = [&](const State<14>& now, long) {
    for (int j = 1; j < 7; ++j)
      for (int i = 0; i < j; ++i)
        nearest = std::min(nearest, problem.distance_squared(now.q, i, j));
  };
  ASSERT_TRUE(avi::integrate(method, z, Pleiades::horizon / steps, {.steps = steps}, look).ok());
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(z.q[2 * i], x[i], 1e-9) << i;
    EXPECT_NEAR(z.q[2 * i + 1], y[i], 1e-9) << i;
  }
  EXPECT_NEAR(problem(z.q, z.p) / problem(start.q, start.p), 1.0, 1e-12);
  EXPECT_LT((avi::NBody<7>::momentum(z) - avi::NBody<7>::momentum(start)).norm(), 1e-12);
  EXPECT_NEAR(std::sqrt(nearest), 0.0336, 1e-4);
}

TEST(DoublePendulum, HasTheEquationsOfMotionOfTheTextbook) {
  // q' from p = M(q) q' with the mass matrix ((2, cos), (cos, 1)) of the angles.
  const State<2> z{.q = {0.9, -0.4}, .p = {0.7, 1.1}};
  avi::detail::RecordedFormula<double> formula{avi::record<2>(experiment::DoublePendulum{}).gradient()};
  formula.run(z.q, z.p);
  const double c = std::cos(z.q[0] - z.q[1]), s = std::sin(z.q[0] - z.q[1]);
  const double first = formula.partial(2), second = formula.partial(3);
  EXPECT_NEAR(2.0 * first + c * second, z.p[0], 1e-15);
  EXPECT_NEAR(c * first + second, z.p[1], 1e-15);
  // Lagrange's form of p' = dL/dq
  EXPECT_NEAR(formula.partial(0), first * second * s + 2.0 * std::sin(z.q[0]), 1e-15);
  EXPECT_NEAR(formula.partial(1), -first * second * s + std::sin(z.q[1]), 1e-15);
  const Vector<double, 2> d_dq(formula.partial(0), formula.partial(1)), d_dp(first, second);
  EXPECT_LT(gradient_defect(experiment::DoublePendulum{}, z, d_dq, d_dp), 1e-11);
  const auto rest = experiment::DoublePendulum::released(1.0, 2.0);
  EXPECT_EQ(experiment::DoublePendulum{}(rest.q, rest.p), -2.0 * std::cos(1.0) - std::cos(2.0));
}

// A chain that is plucked in one place: q_d = J_2d(2 t) until a wave comes to an end (Schroedinger 1914).
// Ahead of it entries move by 1e-14, 1e-300 and less, which is not what steps are for.
TEST(ManyBodies, AChainThatIsPluckedInOnePlace) {
  constexpr int n = 500;
  const auto chain = [](const auto& q, const auto& p) {
    auto h = 0.5 * p[0] * p[0];
    for (int i = 1; i < n; ++i)
      h = h + 0.5 * p[i] * p[i] + 0.5 * (q[i] - q[i - 1]) * (q[i] - q[i - 1]);
    return h;
  };
  avi::State<avi::dynamic> start{.q = avi::VectorX::Zero(n), .p = avi::VectorX::Zero(n)};
  start.q[n / 2] = 1.0;
  for (const char* monitor : {"", "fixed"}) {
    const auto orbit = avi::solve(chain, start, 100.0, 1e-6, {.monitor = monitor});
    EXPECT_TRUE(orbit.kept()) << orbit.report();
    EXPECT_LT(orbit.run.evaluations,
              30'000);  // measured 7840 and 18 694; a million where nothing is too small
    for (const int d : {0, 3, 90, -40})
      EXPECT_NEAR(orbit.state.q[n / 2 + d], std::cyl_bessel_j(2.0 * std::abs(d), 200.0), 1e-6) << d;
  }
}

}  // namespace many_bodies_test
