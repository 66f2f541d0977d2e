#include "avi/core/integrate.hpp"
#include "avi/solve.hpp"
#include "kept.hpp"
#include "refusal.hpp"
#include "src/features/divisors.hpp"
#include "src/features/poles.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

// The monitor that is made of the poles of H.

namespace poles_test {

using avi::State, avi::VectorX, avi::detail::PointField, avi::detail::Poles, avi::detail::Sketch;

/// The constants w, e of all poles of H(q, p), found on an orbit of some radians.
template <class H>
std::vector<double> constants(const H& hamiltonian, const std::vector<double>& start) {
  const auto n = static_cast<Eigen::Index>(start.size() / 2);
  const avi::Formula h = avi::Formula::of_phase(hamiltonian, n);
  PointField field(h.graph(), h.node(), {});
  const VectorX z = Eigen::Map<const VectorX>(start.data(), 2 * n), metric = field.metric(z);
  const Sketch sketch(field, z, 5.0, metric);
  return Poles(h.graph(), h.node()).constants(sketch, metric, n);
}

void expect_near(const std::vector<double>& found, const std::vector<double>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], wanted[i], 1e-5 * wanted[i]) << i;
}

/// The power of q with which a formula of one coordinate vanishes at q = 0, or is infinite if negative.
template <class H>
double power_of_q(const H& formula) {
  const auto f = avi::Formula::of_phase<1>(formula);
  return avi::detail::power_in(f.graph(), f.node(), 0);
}

TEST(Poles, HaveThePowerOfTheirDistance) {
  EXPECT_EQ(power_of_q([](const auto& q, const auto&) { return sin(sqrt(q[0])); }), 0.5);
  EXPECT_EQ(power_of_q([](const auto& q, const auto& p) { return p[0] / (q[0] * tanh(q[0])); }), -2.0);
  EXPECT_EQ(power_of_q([](const auto& q, const auto&) { return pow(abs(q[0]), -1.5) * q[0]; }), -0.5);
  EXPECT_EQ(power_of_q([](const auto& q, const auto&) { return q[0] + q[0] * q[0]; }), 1.0);
  EXPECT_EQ(power_of_q([](const auto& q, const auto&) { return cos(q[0]); }), 0.0);
  EXPECT_EQ(power_of_q([](const auto& q, const auto& p) { return sin(p[0] / q[0]); }), 0.0);
  const double of_log = power_of_q([](const auto& q, const auto&) { return log(q[0]); });
  EXPECT_TRUE(of_log < 0.0 && of_log > -0.1) << of_log;
}

// d^2 H / ds^2 over the reduced mass is w^2 s^-2-a, |s dH/ds| is e s^-a: closed forms of each, however it is
// written.
TEST(Poles, HaveTheFrequencyAndEnergyOfTheirTerm) {
  const double mu = 3.0;
  const auto kepler = [=](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - mu / sqrt(q[0] * q[0] + q[1] * q[1]);
  };
  expect_near(constants(kepler, {1.0, 0.2, 0.1, 1.5}), {std::sqrt(2.0 * mu), mu});
  const auto by_power = [=](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - mu * pow(q[0] * q[0] + q[1] * q[1], -0.5);
  };
  expect_near(constants(by_power, {1.0, 0.2, 0.1, 1.5}), {std::sqrt(2.0 * mu), mu});
  // Two bodies on a line: the reduced mass is m M / (m + M).
  const double m = 1e-6, M = 2.0;
  const auto bodies = [=](const auto& q, const auto& p) {
    return p[0] * p[0] / (2.0 * m) + p[1] * p[1] / (2.0 * M) + m * M / (q[1] - q[0]);
  };
  expect_near(constants(bodies, {0.0, 1.0, 0.0, 0.0}), {std::sqrt(2.0 * (m + M)), m * M});
  // An angle from a pole of the coordinates: p^2 / 2 sin^2, a = 2.
  const auto angle = [](const auto& q, const auto& p) {
    const auto x = p[1] / sin(q[0]);
    return 0.5 * p[0] * p[0] + 0.5 * x * x;
  };
  EXPECT_NEAR(constants(angle, {M_PI / 2, 0.0, 0.0, 0.5})[1], 0.25, 1e-5);
  // A logarithm: w^2 s^-2, and the same energy everywhere.
  const auto logarithm = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.7 * log(q[0] * q[0] + 0.01 + q[1] * q[1]);
  };
  EXPECT_NEAR(constants(logarithm, {1.0, 0.2, 0.1, 0.5})[1], 1.4, 1e-5);
}

TEST(Poles, AreThoseOfPositionsAlone) {
  const auto none = [](const auto& hamiltonian) {
    const avi::Formula h = avi::Formula::of_phase(hamiltonian, 2);
    return Poles(h.graph(), h.node()).none();
  };
  EXPECT_TRUE(
      none([](const auto& q, const auto& p) { return p[0] * p[0] + p[1] / 3.0 + q[0] * q[1] * q[1]; }));
  EXPECT_TRUE(
      none([](const auto& q, const auto& p) { return q[0] / sqrt(1.0 + p[0] * p[0]) + q[1] * p[1]; }));
  EXPECT_TRUE(none([](const auto& q, const auto& p) { return p[0] * p[1] + q[1] / exp(q[0]); }));
  EXPECT_FALSE(none([](const auto& q, const auto& p) { return p[0] * p[1] + 1.0 / q[0]; }));
  // A factor that vanishes as fast takes the pole away.
  EXPECT_TRUE(none([](const auto& q, const auto& p) { return p[0] * p[1] + q[0] * q[0] / q[0]; }));
}

// Arenstorf's orbit in a turning frame: energies know nothing of the moon (fifty steps against eight times as
// many).
TEST(Poles, AreTakenWhereTheyPay) {
  const double mu = 0.012277471;
  const auto h = systems::restricted(mu);
  const State<2> start{.q = {0.994, 0.0}, .p = {0.0, -2.00158510637908252 + 0.994}};
  const double period = 17.06521656015796255;
  const auto orbit = kept(solve(h, start, period, 1e-9));
  EXPECT_EQ(orbit.choice.name, "poles");
  EXPECT_NEAR((orbit.state.q - start.q).norm(), 0.0,
              2e-6);  // unstable: it moves 4e5 times a change of the start
  const auto by_energy = solve(h, start, period, 1e-9, {.monitor = "energy^1.5"});
  EXPECT_LT(3 * orbit.run.steps, by_energy.run.steps) << by_energy.report();
  // The monitor by hand: along the orbit 1/rho^2.
  const avi::Formula g = monitor_of(orbit.choice, avi::Formula::of_phase<2>(h), h(start.q, start.p));
  const std::vector<double>& c = orbit.choice.poles;
  ASSERT_EQ(c.size(), 6u);
  const double earth = std::pow(start.q[0] + mu, -1.5),
               moon = std::pow(std::abs(start.q[0] - (1.0 - mu)), -1.5);
  const bool moon_first = c[3] < c[5];  // as the compiler has it
  const double near = c[2] * (moon_first ? moon : earth) + c[4] * (moon_first ? earth : moon);
  EXPECT_NEAR(1.0 / g(start.q, start.p), std::pow(std::sqrt(c[0]) + std::sqrt(near), 2), 1e-9);
  EXPECT_EQ(solve(h, start, period, 1e-9, {.monitor = "poles"}).choice.poles, c);
}

// Each product has its factor twice: as many ways lead to the first one as 2 to the power of 60.
TEST(Poles, OfLongProductsAreFoundOnce) {
  const auto h = [](const auto& q, const auto& p) {
    auto product = q[0];
    for (int k = 0; k < 60; ++k)
      product = product * (product * cos(q[0]));
    return 0.5 * p[0] * p[0] + 1.0 / product;
  };
  const avi::Formula formula = avi::Formula::of_phase<1>(h);
  EXPECT_EQ(avi::detail::Poles(formula.graph(), formula.node()).size(), 2u);
}

TEST(Poles, OfAChoiceAreRefusedForAnotherHamiltonian) {
  const auto h = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + 1.0 / q[0]; };
  const avi::Formula line = avi::Formula::of_phase<1>(h);
  const auto refused = [&](const avi::Choice& choice) {
    EXPECT_THROW((void)monitor_of(choice, line, 1.0), std::invalid_argument) << choice.name;
  };
  refused({.name = "pole"});
  refused({.name = "given"});
  refused({.name = "poles", .poles = {1.0, 1.0}});
  refused({.name = "acceleration", .accelerations = {1.0, 1.0, 1.0}});
  refused({.name = "energy", .drifts = {1.0, 1.0, 1.0}});
  EXPECT_EQ(monitor_of({.name = "fixed"}, line, 1.0).inputs(), 2);
}

// A ball between two walls, free for most of its way: without a constant beside the poles, and the root of
// it, as many steps as fixed ones.
TEST(Poles, HaveAConstantBesideThemWhereTheOrbitIsFree) {
  const auto h = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 1e-3 * (pow(1.0 - q[0], -2.0) + pow(1.0 + q[0], -2.0));
  };
  const State<1> start{.q = {0.0}, .p = {1.0}};
  const auto orbit = solve(h, start, 60.0, 1e-8, {.monitor = "poles"});
  const auto fixed = solve(h, start, 60.0, 1e-8, {.monitor = "fixed"});
  EXPECT_TRUE(orbit.kept() && fixed.kept());
  EXPECT_NEAR(orbit.state.q[0], fixed.state.q[0], 2e-7);
  EXPECT_LT(3 * orbit.run.steps, fixed.run.steps);  // measured 361 and 1568
  const std::vector<double>& c = orbit.choice.poles;
  EXPECT_GT(c[0], 0.0);
  const avi::Formula g = monitor_of(orbit.choice, avi::Formula::of_phase<1>(h), h(start.q, start.p));
  EXPECT_NEAR(1.0 / g(start.q, start.p), std::pow(std::sqrt(c[0]) + std::sqrt(c[2] + c[4]), 2), 1e-12);
  // Beside the orbit the term with H - H_0: f(p) = rho^2 + rho / sqrt(phi) (H - H_0) / E phi.
  const avi::Vector<double, 1> other(1.1);
  const double phi = c[2] + c[4], rho = std::sqrt(c[0]) + std::sqrt(phi), energy = c[1] + c[3] + c[5];
  EXPECT_NEAR(1.0 / g(start.q, other), rho * rho + rho * std::sqrt(phi) * (0.105 / energy), 1e-12);
}

// Two suns throw a planet out: far away, seen from the frame that turns with them, energies take a million
// steps, of which the beginning shows nothing. Measured: 216 to 399; it was given up.
TEST(Poles, AreTakenWhenTheOrbitLeavesWhatTheMenuWasMadeFor) {
  const State<2> start{.q = {0.0142, 0.0872}, .p = {-0.0895, 1.1005}};
  const avi::Vector<double, 2> end(65.86185872, -104.34014895);  // by 2e6 fixed steps of order 16
  for (const double tolerance : {1e-4, 1e-7, 1e-9}) {
    const auto orbit = kept(solve(systems::restricted(0.5), start, 180.0, tolerance));
    EXPECT_LT(orbit.run.steps, 1000);
    EXPECT_LT((orbit.state.q - end).norm(), 10.0 * tolerance * 123.0) << orbit.report();
  }
}

TEST(Poles, AreRefusedWhereThereAreNone) {
  expect_refusal(
      [&] { (void)solve(systems::spring, systems::at(1.0, 0.0), 10.0, 1e-6, {.monitor = "poles"}); },
      "divides by no function of q alone");
}

// In other units of length, time and mass: the same steps.
TEST(Poles, FollowUnits) {
  const auto in = [](double length, double time, double mass) {
    const double mu = length * length * length / (time * time), l = length;
    const auto h = [=](const auto& q, const auto& p) {
      const auto a = q[0] + 0.1 * l, b = q[0] - 0.9 * l;
      return (p[0] * p[0] + p[1] * p[1]) / (2.0 * mass) -
             mass * mu * (0.9 / sqrt(a * a + q[1] * q[1]) + 0.1 / sqrt(b * b + q[1] * q[1]));
    };
    const double v = length / time;
    return solve(h, State<2>{.q = {0.5 * l, 0.1 * l}, .p = {0.0, 0.9 * mass * v}}, 200.0 * time, 1e-6,
                 {.check = false, .monitor = "poles"});
  };
  const auto here = in(1.0, 1.0, 1.0), there = in(0x1p40, 0x1p-30, 0x1p-20);
  EXPECT_EQ(here.run.steps, there.run.steps);
  EXPECT_NEAR(there.choice.h / here.choice.h, 1.0, 1e-6);
}

}  // namespace poles_test
