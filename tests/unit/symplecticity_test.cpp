#include "avi/avi.hpp"
#include "avi/diagnostics/symplecticity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

using avi::State;
using Point = avi::Vector<double, avi::dynamic>;

namespace symplecticity_test {

/// Heun's second-order Runge-Kutta method: the control that is not symplectic.
struct Heun {
  avi::StepReport step(State<1>& z, double h) const {
    const double q = z.q[0], p = z.p[0];
    const double q1 = q + h * p, p1 = p - h * std::sin(q);
    z.q[0] = q + 0.5 * h * (p + p1);
    z.p[0] = p - 0.5 * h * (std::sin(q) + std::sin(q1));
    return {};
  }
};

/// Of this mass in a field with this gradient of its potential.
struct Heavy {
  static constexpr int dimension = 2;
  double mass;
  std::function<avi::Vector<double, 2>(const avi::Vector<double, 2>&)> potential_gradient;
  [[nodiscard]] avi::Vector<double, 2> velocity(const avi::Vector<double, 2>& p) const { return p / mass; }
};

TEST(DifferenceJacobian, MatchesAClosedForm) {
  const auto map = [](const Point& z) -> Point {
    return Point{{std::sin(z[0]) * std::exp(z[1]), 1.0 / (1.0 + z[0] * z[0])}};
  };
  const auto j = avi::difference_jacobian(map, Point{{0.7, 0.3}});
  const double square = 1.0 + 0.7 * 0.7;
  avi::Matrix<double, 2> exact;
  exact << std::cos(0.7) * std::exp(0.3), std::sin(0.7) * std::exp(0.3), -1.4 / (square * square), 0.0;
  EXPECT_LT((j - exact).norm(), 4e-13);
}

TEST(DifferenceJacobian, IsExactForPolynomialsOfDegree16) {
  // About 0 odd powers alone count, and 15 is the highest; x^17 is off by -(8!)^2 s^16.
  const auto power = [](int exponent) {
    return [exponent](const Point& z) -> Point { return Point{{std::pow(z[0], exponent)}}; };
  };
  const auto slope = [](const auto& map) {
    return avi::difference_jacobian(map, Point{{0.0}}, {.largest = 0.5, .smallest = 0.5})(0, 0);
  };
  EXPECT_NEAR(slope(power(1)), 1.0, 1e-14);
  for (const int exponent : {3, 5, 7, 9, 11, 13, 15})
    EXPECT_NEAR(slope(power(exponent)), 0.0, 1e-12 * std::pow(4.0, exponent)) << exponent;
  const double factorial = std::tgamma(9.0);
  EXPECT_NEAR(slope(power(17)) / (factorial * factorial * std::pow(0.5, 16)), -1.0, 1e-6);
}

TEST(DifferenceJacobian, TakesTheSpacingWhereTheFormulasAgreeBest) {
  // Rounding at 1e-6, so that the longest spacing is the best; a short wave, so that it is the worst.
  const auto rounded = [](const Point& z) -> Point { return Point{{std::round(1e6 * z[0]) / 1e6}}; };
  EXPECT_NEAR(avi::difference_jacobian(rounded, Point{{0.3}})(0, 0), 1.0, 1e-4);
  const auto wave = [](const Point& z) -> Point { return Point{{std::sin(20.0 * z[0]) / 20.0}}; };
  EXPECT_NEAR(avi::difference_jacobian(wave, Point{{0.3}})(0, 0), std::cos(6.0), 1e-10);
  std::vector<double> tried;
  const auto watched = [&](const Point& z) -> Point {
    tried.push_back(std::abs(z[0]));
    return z;
  };
  (void)avi::difference_jacobian(watched, Point{{0.0}});
  EXPECT_EQ(tried.size(), 16u * 10u) << "from 1/16 to 1/8192";
  EXPECT_EQ(*std::max_element(tried.begin(), tried.end()), 8.0 / 16.0);
  EXPECT_EQ(*std::min_element(tried.begin(), tried.end()), 1.0 / 8192.0);
}

TEST(DifferenceJacobian, DoesNotTrustASpacingAtWhichTheMapStandsStill) {
  // The second entry changes by less than its rounding at the small spacings: there all slopes of it are
  // zero.
  const auto weak = [](const Point& z) -> Point { return Point{{z[0], 1e6 + 1e-3 * std::sin(z[0])}}; };
  EXPECT_NEAR(avi::difference_jacobian(weak, Point{{0.3, 1.0}}, {.smallest = 0x1p-40})(1, 0),
              1e-3 * std::cos(0.3), 1e-8);
}

TEST(DifferenceJacobian, RefusesSpacingsOutOfOrder) {
  const auto map = [](const Point& z) { return z; };
  for (const avi::Spacings bad : {avi::Spacings{0.1, 0.0}, {0.1, 0.2}, {HUGE_VAL, 0.1}, {0.1, std::nan("")}})
    EXPECT_THROW(avi::difference_jacobian(map, Point{{0.0}}, bad), std::invalid_argument);
}

TEST(SymplecticityDefect, VanishesForStormerVerlet) {
  const auto pendulum = avi::stormer_verlet<1>(&avi::Pendulum::potential_gradient<double>);
  const auto kepler = avi::stormer_verlet<2>(&avi::Kepler::potential_gradient<double>);
  for (double h : {0.4, 0.1, 0.025}) {
    EXPECT_LT(avi::symplecticity_defect(pendulum, avi::Pendulum::start(1.5), h), 2e-12);
    EXPECT_LT(avi::symplecticity_defect(kepler, avi::Kepler::pericentre(0.3), h), 1e-11);
  }
}

TEST(SymplecticityDefect, IsTheSameInAnyUnits) {
  for (const double unit : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {  // of length; that of velocity is 1
    const auto kepler = avi::stormer_verlet<2>([unit](const avi::Vector<double, 2>& q) {
      return avi::Vector<double, 2>(avi::Kepler::potential_gradient<double>(q / unit) / unit);
    });
    auto z = avi::Kepler::pericentre(0.3);
    z.q *= unit;
    EXPECT_LT(avi::symplecticity_defect(kepler, z, 0.1 * unit), 1e-11) << unit;
  }
}

TEST(SymplecticityDefect, IsTheSameInUnitsOfAnySize) {
  // The Earth round the Sun in metres, kilograms and seconds, where momenta are 1e29, and powers of ten.
  for (const auto& [length, mass] : {std::pair{1.496e11, 5.972e24},
                                     {1.0, 1e30},
                                     {1e30, 1.0},
                                     {1e-30, 1e30},
                                     {1e30, 1e-30},
                                     {1e60, 1e60}}) {
    const double time = length * 2e-5;
    const double size = length, unit = mass * length / (time * time);
    const auto gradient = [&](const avi::Vector<double, 2>& q) {
      return avi::Vector<double, 2>(avi::Kepler::potential_gradient<double>(q / size) * unit);
    };
    const avi::Separable flows(Heavy{mass, gradient});
    auto z = avi::Kepler::pericentre(0.3);
    z.q *= length;
    z.p *= mass * length / time;
    EXPECT_LT(avi::symplecticity_defect(avi::splitting(flows, avi::compositions::strang), z, 0.1 * time),
              1e-11)
        << length << ' ' << mass;
  }
}

/// Two pendulums that do not know of each other, one with this mass.
struct Pair {
  static constexpr int dimension = 2;
  using Vec = avi::Vector<double, 2>;
  double mass;
  [[nodiscard]] Vec potential_gradient(const Vec& q) const { return {std::sin(q[0]), mass * std::sin(q[1])}; }
  [[nodiscard]] Vec velocity(const Vec& p) const { return {p[0], p[1] / mass}; }
};
/// Heun's method for them.
struct PairByHeun {
  Pair pair;
  avi::StepReport step(State<2>& z, double h) const {
    const Pair::Vec v = pair.velocity(z.p), f = -pair.potential_gradient(z.q);
    const Pair::Vec q = z.q + h * v, p = z.p + h * f;
    z.q += 0.5 * h * (v + pair.velocity(p));
    z.p += 0.5 * h * (f - pair.potential_gradient(q));
    return {};
  }
};

TEST(SymplecticityDefect, IsThatOfALightBodyBesideAHeavyOne) {
  const auto start = [](double mass) { return State<2>{.q = {0.3, 2.0}, .p = {1.0, 0.5 * mass}}; };
  const double of_heun = avi::symplecticity_defect(PairByHeun{{1.0}}, start(1.0), 0.2);
  EXPECT_GT(of_heun, 1e-4);
  // At 1e-3 and at 1e-4 the second one turns by 2 pi and by 20 pi, nearly, in the largest spacing.
  for (const double mass : {1e8, 1e4, 1.0, 1e-2, 1e-3, 1e-4, 2e-4, 1e-5, 1e-6, 1e-8, 1e-12}) {
    const auto leapfrog = avi::splitting(avi::Separable(Pair{mass}), avi::compositions::strang);
    EXPECT_LT(avi::symplecticity_defect(leapfrog, start(mass), 0.2), 1e-13) << mass;
    EXPECT_NEAR(avi::symplecticity_defect(PairByHeun{{mass}}, start(mass), 0.2), of_heun, 1e-12) << mass;
  }
}

TEST(SymplecticityDefect, IsThatOfAPointAtRest) {
  // Where all of q or of p is zero at both ends its unit is 1.
  const auto free = avi::stormer_verlet<1>([](const avi::Vector<double, 1>& q) { return 0.0 * q; });
  EXPECT_LT(avi::symplecticity_defect(free, State<1>{.q = {1.0}, .p = {0.0}}, 0.1), 1e-12);
  EXPECT_LT(avi::symplecticity_defect(free, State<1>{.q = {0.0}, .p = {0.0}}, 0.1), 1e-12);
}

TEST(SymplecticityDefect, GrowsWithTheStepOfAMethodThatIsNot) {
  const double coarse = avi::symplecticity_defect(Heun{}, avi::Pendulum::start(1.5), 0.2);
  const double fine = avi::symplecticity_defect(Heun{}, avi::Pendulum::start(1.5), 0.1);
  EXPECT_GT(fine, 1e-7);
  EXPECT_GT(coarse / fine, 6.0);
}

TEST(SymplecticityDefect, ServesAPlainCallable) {
  // A stretch by s in q and 1 / s in p is symplectic; by s in both it changes Omega to s^2 Omega.
  const auto squeeze = [](const Point& z) -> Point {
    return Point{{1.1 * z[0], 0.9 * z[1], z[2] / 1.1, z[3] / 0.9}};
  };
  const auto swell = [](const Point& z) -> Point { return 1.1 * z; };
  const Point z{{0.2, -0.4, 1.0, 0.3}};
  EXPECT_LT(avi::symplecticity_defect(squeeze, z), 4e-12);
  EXPECT_NEAR(avi::symplecticity_defect(swell, z), 2.0 * 0.21, 1e-11);
  // q_1 moves with q_2 and p does not follow: J^T Omega J - Omega has the entries 0.5 and -0.5.
  const auto shear = [](const Point& x) -> Point { return Point{{x[0] + 0.5 * x[1], x[1], x[2], x[3]}}; };
  EXPECT_NEAR(avi::symplecticity_defect(shear, z), 0.5 * std::sqrt(2.0), 1e-11);
  EXPECT_THROW(avi::symplecticity_defect(swell, Point{{1.0, 2.0, 3.0}}), std::invalid_argument);
  EXPECT_THROW(avi::symplecticity_defect(swell, Point()), std::invalid_argument);
  for (const int size : {2, 6}) {
    const auto other = [=](const Point&) -> Point { return Point::Ones(size); };
    EXPECT_THROW(avi::symplecticity_defect(other, z), std::invalid_argument) << size;
  }
}

TEST(SymplecticityDefect, RefusesAPointWithoutPairs) {
  struct Stands {
    avi::StepReport step(State<avi::dynamic>&, double) const { return {}; }
  };
  for (const State<avi::dynamic>& z : {State<avi::dynamic>{}, {.q = {1.0, 2.0}, .p = {1.0}}})
    EXPECT_THROW(avi::symplecticity_defect(Stands{}, z, 0.1), std::invalid_argument);
}

}  // namespace symplecticity_test
