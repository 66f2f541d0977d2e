#include "avi/avi.hpp"
#include "common/problems/perturbed_kepler.hpp"
#include "difference.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <string>

using avi::dynamic, avi::FigureEight, avi::State, avi::Vector;

namespace problems_test {

TEST(Problems, GradientsAreThoseOfThePotentials) {
  const auto defect = [](const auto& problem, const auto& q) {
    return gradient_defect([&](const auto& x) -> double { return problem.potential(x); }, q,
                           problem.potential_gradient(q), 1e-3);
  };
  const Vector<double, 2> q(0.8, 0.5);
  EXPECT_LT(defect(avi::Pendulum{}, avi::Pendulum::start(1.2).q), 1e-12);
  EXPECT_LT(defect(avi::HenonHeiles{}, Vector<double, 2>(0.31, -0.22)), 1e-12);
  EXPECT_LT(defect(avi::Kepler{}, q), 1e-10);
  EXPECT_LT(defect(experiment::PerturbedKepler(0.1), q), 1e-10);
  Vector<double, 6> bodies;
  bodies << 0.1, 0.2, 1.3, -0.4, -0.9, 0.8;
  EXPECT_LT(defect(avi::NBody<3>(Vector<double, 3>(1.0, 2.0, 0.5)), bodies), 1e-10);
  const auto defect_of_logarithm = [&](const auto& problem) {
    return gradient_defect([&](const auto& x) { return -1.3 * std::log(-problem.potential(x)); }, q,
                           problem.log_potential_gradient(q, -1.3), 1e-3);
  };
  EXPECT_LT(defect_of_logarithm(avi::Kepler{}), 1e-10);
  EXPECT_LT(defect_of_logarithm(experiment::PerturbedKepler(0.1)), 1e-10);
}

TEST(Pendulum, HasTheKnownPeriod) {
  // K(sin 45 degrees) = Gamma(1/4)^2 / (4 sqrt(pi)).
  const double gamma = std::tgamma(0.25);
  EXPECT_NEAR(avi::Pendulum::period(M_PI / 2), gamma * gamma / std::sqrt(M_PI), 1e-13);
  EXPECT_NEAR(avi::Pendulum::period(0.0), 2.0 * M_PI, 1e-15);
  EXPECT_NEAR(avi::Pendulum::period(3.0), 4.0 * std::comp_ellint_1(std::sin(1.5)), 1e-13);
  auto z = avi::Pendulum::start(1.0);
  auto method = avi::stormer_verlet<1>(&avi::Pendulum::potential_gradient<double>);
  EXPECT_TRUE(avi::integrate(method, z, avi::Pendulum::period(1.0) / 4000.0, {.steps = 4000}).ok());
  EXPECT_NEAR(z.q[0], 1.0, 1e-6);
  EXPECT_THROW(avi::Pendulum::start(M_PI), std::invalid_argument);
  EXPECT_THROW(avi::Pendulum::period(M_PI), std::invalid_argument);
  EXPECT_EQ(avi::Pendulum::start(0.0).q[0], 0.0);
}

TEST(HenonHeiles, StartsOnTheSectionAtTheEnergyAskedFor) {
  const auto z = avi::HenonHeiles::on_section(1.0 / 12.0, 0.1, 0.05);
  EXPECT_NEAR(avi::HenonHeiles{}(z.q, z.p), 1.0 / 12.0, 1e-16);
  EXPECT_EQ(z.q[0], 0.0);
  EXPECT_GT(z.p[0], 0.0);
  EXPECT_THROW(avi::HenonHeiles::on_section(1.0 / 12.0, 0.9, 0.0), std::invalid_argument);
  EXPECT_THROW(avi::HenonHeiles::on_section(0.0, 0.0, 0.0), std::invalid_argument) << "p_x = 0 is not above";
}

TEST(HenonHeiles, HasItsSaddlesAtEnergyOneSixth) {
  for (const Vector<double, 2>& saddle :
       {Vector<double, 2>(0.0, 1.0), Vector<double, 2>(std::sqrt(0.75), -0.5)}) {
    EXPECT_NEAR(avi::HenonHeiles::potential(saddle), 1.0 / 6.0, 1e-16);
    EXPECT_LT(avi::HenonHeiles::potential_gradient(saddle).norm(), 1e-15);
  }
}

TEST(PerturbedKepler, IsKeplerWithoutAndTurnsTheEllipseWith) {
  const Vector<double, 2> q(0.3, -0.7);
  EXPECT_NEAR(
      (experiment::PerturbedKepler(0.0).potential_gradient(q) - avi::Kepler::potential_gradient(q)).norm(),
      0.0, 1e-15);
  // First-order advance of the pericentre per revolution: 3 pi epsilon / (a (1 - e^2))^2.
  const double e = 0.3, epsilon = 1e-4;
  const auto laplace = [](const State<2>& s) {
    const double l = avi::Kepler::angular_momentum(s);
    return std::atan2(-l * s.p[0] - s.q[1] / s.q.norm(), l * s.p[1] - s.q[0] / s.q.norm());
  };
  const auto turn = [&](double quadrupole) {
    const experiment::PerturbedKepler other(quadrupole);
    auto run =
        avi::stormer_verlet<2>([&](const Vector<double, 2>& at) { return other.potential_gradient(at); });
    auto state = avi::Kepler::pericentre(e);
    EXPECT_EQ(avi::integrate(run, state, M_PI / 5000.0, {.steps = 100000}).outcome, avi::Outcome::ok);
    return laplace(state);
  };
  const double advance = (turn(epsilon) - turn(0.0)) / 10.0;
  EXPECT_NEAR(advance / (3.0 * M_PI * epsilon / std::pow(1.0 - e * e, 2)), 1.0, 1e-2);
  EXPECT_EQ(experiment::PerturbedKepler().potential(q), avi::Kepler::potential(q))
      << "none unless it is given";
}

TEST(NBody, OneCodePathForBothKindsOfDimension) {
  const avi::NBody<3> fixed(Vector<double, 3>(1.0, 2.0, 0.5));
  const avi::NBody<dynamic> free(Vector<double, dynamic>(Vector<double, 3>(1.0, 2.0, 0.5)));
  const auto z = FigureEight::start();
  const State<dynamic> w{.q = z.q, .p = z.p};
  EXPECT_EQ(fixed(z.q, z.p), free(w.q, w.p));
  EXPECT_EQ((fixed.potential_gradient(z.q) - free.potential_gradient(w.q)).norm(), 0.0);
  EXPECT_EQ((fixed.velocity(z.p) - free.velocity(w.p)).norm(), 0.0);
  EXPECT_NO_THROW(avi::NBody<dynamic>(Vector<double, dynamic>::Ones(2)));
}

TEST(NBody, RefusesAStateOfAnotherNumberOfBodies) {
  const avi::NBody<dynamic> three(Vector<double, dynamic>::Ones(3));
  const std::string of_q = "Number of entries of q is 8; it must be 2 for each of 3 bodies.",
                    of_p = "Number of entries of p is 8; it must be 2 for each of 3 bodies.";
  const Vector<double, dynamic> x = Vector<double, dynamic>::LinSpaced(8, 0.0, 1.0);
  EXPECT_EQ(refusal([&] { (void)three.potential(x); }), of_q);
  EXPECT_EQ(refusal([&] { (void)three.potential_gradient(x); }), of_q);
  EXPECT_EQ(refusal([&] { (void)three.kinetic(x); }), of_p);
  EXPECT_EQ(refusal([&] { (void)three.velocity(x); }), of_p);
  EXPECT_NE(refusal([&] { (void)avi::poincare(three, State<dynamic>{.q = x, .p = x}); }), "accepted");
}

TEST(NBody, TwoBodiesMoveAsKeplersProblem) {
  // Relative coordinate of masses 0.6 and 0.4 about their centre of mass: mu = 1.
  const avi::NBody<2> pair(Vector<double, 2>(0.6, 0.4));
  const auto relative = avi::Kepler::pericentre(0.5);
  Vector<double, 4> q, p;
  q << 0.4 * relative.q, -0.6 * relative.q;
  p << 0.24 * relative.p, -0.24 * relative.p;
  EXPECT_NEAR(pair(q, p), 0.24 * avi::Kepler{}(relative.q, relative.p), 1e-15);
  EXPECT_NEAR((pair.velocity(p).head<2>() - pair.velocity(p).tail<2>() - relative.p).norm(), 0.0, 1e-15);
  EXPECT_NEAR(
      (pair.potential_gradient(q).head<2>() - 0.24 * avi::Kepler::potential_gradient(relative.q)).norm(), 0.0,
      1e-14);
}

TEST(NBody, AddsUpTheMomentaOfAllBodies) {
  Vector<double, 4> q, p;
  q << 1.0, 2.0, 3.0, 5.0;
  p << 7.0, 11.0, 13.0, 17.0;
  const State<4> z{.q = q, .p = p};
  EXPECT_EQ(avi::NBody<2>::momentum(z), (Vector<double, 2>(20.0, 28.0)));
  const double moment = (1.0 * 11.0 - 2.0 * 7.0) + (3.0 * 17.0 - 5.0 * 13.0);
  EXPECT_EQ(avi::NBody<2>::angular_momentum(z), moment) << "about the only axis unless another is named";
  EXPECT_EQ(avi::NBody<2>::angular_momentum(z, 1, 0), -moment);
}

TEST(NBody, HasAngularMomentaOfItsCoordinatesAlone) {
  // Entry 2 of a body in the plane would be the first one of the next body.
  const auto z = FigureEight::start();
  EXPECT_EQ(refusal([&] { avi::NBody<3>::angular_momentum(z, 0, 2); }),
            "Coordinate of a body is 2; it must be at least 0 and below 2.");
  EXPECT_THROW(avi::NBody<3>::angular_momentum(z, -1, 1), std::invalid_argument);
  const State<dynamic> short_of_p{.q = Vector<double, dynamic>::Ones(6),
                                  .p = Vector<double, dynamic>::Ones(3)};
  EXPECT_EQ(refusal([&] { avi::NBody<dynamic, 3>::angular_momentum(short_of_p, 0, 2); }),
            "Number of entries of p is 3; it must be that of q, 6.");
}

TEST(FigureEight, ClosesAfterOnePeriodAndPermutesAfterAThird) {
  const auto problem = FigureEight::problem();
  const auto start = FigureEight::start();
  auto method =
      avi::stormer_verlet<6>([&](const Vector<double, 6>& q) { return problem.potential_gradient(q); });
  auto z = start;
  EXPECT_TRUE(avi::integrate(method, z, FigureEight::period / 30000.0, {.steps = 10000}).ok());
  // After a third of the period body 1 is where body 2 or 3 began.
  const double to_second = (z.q.segment<2>(0) - start.q.segment<2>(2)).norm();
  const double to_third = (z.q.segment<2>(0) - start.q.segment<2>(4)).norm();
  EXPECT_LT(std::min(to_second, to_third), 1e-6);
  EXPECT_TRUE(avi::integrate(method, z, FigureEight::period / 30000.0, {.steps = 20000}).ok());
  EXPECT_LT((z.q - start.q).norm(), 2e-6);
  EXPECT_NEAR(avi::NBody<3>::angular_momentum(z), 0.0, 1e-13);
  EXPECT_NEAR(problem(start.q, start.p), -1.2871419917663, 1e-8);
}

}  // namespace problems_test
