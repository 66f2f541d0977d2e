#include "avi/autodiff/pack.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "beyond/speed/automatic_monitors/automatic_monitor.hpp"
#include "beyond/speed/automatic_monitors/choose_monitor.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace automatic_monitor_test {

using avi::Kepler;
using avi::State;

/// H with other units of length, time and mass, in coordinates that are turned and moved.
struct Moved {
  double length, time, mass, angle;
  avi::Vector<double, 2> shift;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const double c = std::cos(angle), s = std::sin(angle), momentum = mass * length / time;
    Q x = q;
    P y = p;
    x[0] = (c * (q[0] - shift[0]) + s * (q[1] - shift[1])) / length;
    x[1] = (c * (q[1] - shift[1]) - s * (q[0] - shift[0])) / length;
    y[0] = (c * p[0] + s * p[1]) / momentum;
    y[1] = (c * p[1] - s * p[0]) / momentum;
    return mass * length * length / (time * time) * Kepler()(x, y);
  }
  [[nodiscard]] State<2> of(const State<2>& z) const {
    const double c = std::cos(angle), s = std::sin(angle), momentum = mass * length / time;
    return {
        .q = {length * (c * z.q[0] - s * z.q[1]) + shift[0], length * (c * z.q[1] + s * z.q[0]) + shift[1]},
        .p = {momentum * (c * z.p[0] - s * z.p[1]), momentum * (c * z.p[1] + s * z.p[0])}};
  }
};

/// Attraction and repulsion whose second derivatives cancel on the way.
struct LennardJones {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const auto s = avi::power(q[0], -6.0);
    return 0.5 * (p[0] * p[0]) + 4.0 * (s * s - s);
  }
};

struct Quartic {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return 0.5 * (p[0] * p[0]) + 0.25 * ((q[0] * q[0]) * (q[0] * q[0]));
  }
};
struct Free {
  template <class Q, class P>
  auto operator()(const Q&, const P& p) const {
    return 0.5 * (p[0] * p[0]);
  }
};
struct Light {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return sqrt(p[0] * p[0] + p[1] * p[1]) + 0.5 * (q[0] * q[0]);
  }
};
State<1> at(double q, double p) {
  State<1> z;
  z.q[0] = q;
  z.p[0] = p;
  return z;
}

TEST(AutomaticMonitor, IsThePowerOfTheRadiusOnKepler) {
  for (const double e : {0.0, 0.5, 0.9, 0.999}) {
    const State<2> start = Kepler::pericentre(e);
    const avi::Formula g = experiment::automatic_monitor(Kepler(), start);
    const double low = experiment::Monitors({Kepler(), start}).scales().frequency / 8.0;
    for (const double r : {1.0 - e, 0.5, 1.0, 1.0 + e}) {
      const avi::Vector<double, 2> q{0.6 * r, -0.8 * r};
      // V'' has the eigenvalues 2 / r^3 and -1 / r^3.
      const double n0 = 5.0 * std::pow(r, -6.0) + std::pow(0.5 * low, 4.0);
      EXPECT_NEAR(g(q, start.p) * std::sqrt(std::sqrt(n0) + low * low), 1.0, 1e-13) << e << " " << r;
    }
  }
}

TEST(AutomaticMonitor, OffersOneBelowTheMeanTimeToo) {
  experiment::Monitors monitors({Kepler(), Kepler::pericentre(0.6)});
  const avi::Formula g = monitors.gentle().monitor;
  const double mean = monitors.scales().frequency;
  for (const double r : {0.4, 1.0, 1.6, 50.0}) {
    const avi::Vector<double, 2> q{0.6 * r, -0.8 * r};
    const double n0 = 5.0 * std::pow(r, -6.0) + std::pow(0.25 * mean, 4.0);
    EXPECT_NEAR(g(q, q) * (std::pow(n0, 0.25) + mean), 1.0, 1e-13) << r;
  }
}

TEST(AutomaticMonitor, OffersPowersOfTheKineticEnergyToo) {
  const State<2> start = Kepler::pericentre(0.6);
  experiment::Monitors monitors({Kepler(), start});
  const avi::Formula g = monitors.energy("energy", 1.5).monitor;
  const State<2> z{.q = {-0.4, 0.9}, .p = {0.3, -0.2}};  // off the orbit
  const double half = 0.5 * (Kepler()(z.q, z.p) + Kepler()(start.q, start.p));
  const double lively = monitors.scales().kinetic + half + 1.0 / z.q.norm();
  EXPECT_NEAR(g(z.q, z.p) * std::pow(lively, 1.5), 1.0, 1e-13);
}

TEST(AutomaticMonitor, KnowsNoUnitsNoPlaceAndNoDirection) {
  const State<2> start = Kepler::pericentre(0.6);
  const avi::Formula plain = experiment::automatic_monitor(Kepler(), start);
  const Moved moved{.length = 3.0, .time = 0.02, .mass = 7.0, .angle = 0.7, .shift = {5.0, -2.0}};
  const State<2> there = moved.of(start);
  const avi::Formula same = experiment::automatic_monitor(moved, there);
  const State<2> z{.q = {-0.4, 0.9}, .p = {0.3, -0.2}};
  const State<2> image = moved.of(z);
  // Rounding along the run.
  EXPECT_NEAR(same(image.q, image.p) / (0.02 * plain(z.q, z.p)), 1.0, 1e-9);
}

TEST(AutomaticMonitor, SumsPairsOfBodies) {
  // A close pair and a third body far away, whose terms are small beside theirs.
  const avi::NBody<3> problem(avi::NBody<3>::Masses::Ones());
  State<6> z{.q = {}, .p = avi::Vector<double, 6>::Zero()};
  z.q << 0.0, 0.0, 1.0, 0.0, 30.0, 40.0;
  z.p[1] = -std::sqrt(0.5), z.p[3] = -z.p[1];  // on a circle about each other
  const avi::Formula g = experiment::automatic_monitor(problem, z);
  const double wide = g(z.q, z.p);
  z.q[2] = 0.25;
  EXPECT_NEAR(wide / g(z.q, z.p), 7.94, 0.06);  // 4^(3/2), less what the bound takes
}

TEST(AutomaticMonitor, StaysBetweenItsBounds) {
  const State<1> start = at(3.0, 0.0);
  experiment::Monitors monitors({LennardJones(), start});
  const avi::Formula g = experiment::automatic_monitor(LennardJones(), start);
  for (double q = 0.95; q < 20.0; q *= 1.001) {
    const double here = g(at(q, 0.0).q, start.p);
    EXPECT_GT(here, 0.0);
    EXPECT_LT(here, 8.0 / monitors.scales().frequency);
  }
  // Near the inflection, where V'' = 0, it is what it is beside it.
  EXPECT_NEAR(g(at(1.2444, 0.0).q, start.p) / g(at(1.2, 0.0).q, start.p), 1.29, 0.1);
}

TEST(AutomaticMonitor, TakesEveryScalar) {
  const State<2> start = Kepler::pericentre(0.7);
  const avi::Formula g = experiment::automatic_monitor(Kepler(), start);
  const avi::Vector<double, 2> q{0.3, 0.7};
  const double value = g(q, start.p);

  avi::Vector<avi::Pack<4>, 2> packs{avi::Pack<4>(q[0]), avi::Pack<4>(q[1])};
  EXPECT_DOUBLE_EQ(g(packs, packs)[2], value);

  using Slope = avi::Partials<double, 2>;
  const avi::Vector<Slope, 2> x{Slope::variable(q[0], 0), Slope::variable(q[1], 1)};
  const Slope slope = g(x, x);
  const double step = 1e-6;
  const avi::Vector<double, 2> right{q[0] + step, q[1]}, left{q[0] - step, q[1]};
  EXPECT_DOUBLE_EQ(slope.value, value);
  EXPECT_NEAR(slope.partial(0), (g(right, q) - g(left, q)) / (2.0 * step), 1e-8);

  avi::ExpressionGraph graph(2);
  const avi::Vector<avi::Recorded, 2> recorded{avi::Recorded(graph, 0), avi::Recorded(graph, 1)};
  const avi::Formula again(graph, g(recorded, recorded).node_in(graph));
  const avi::Vector<double, 1> first{q[0]}, second{q[1]};
  EXPECT_DOUBLE_EQ(again(first, second), value);
}

TEST(Formula, TakesTheSignOfZeroFromItsBit) {
  const auto sign = avi::Formula::of_phase<1>([](const auto& q, const auto&) { return sign_of(q[0]); });
  for (const double x : {0.0, -0.0, 2.0, -2.0})
    EXPECT_EQ(sign(avi::Vector<double, 1>(x), avi::Vector<double, 1>(1.0)), std::copysign(1.0, x)) << x;
}

TEST(AutomaticMonitor, StartsWhereTheCurvatureVanishes) {
  const avi::Formula g = experiment::automatic_monitor(Quartic(), at(0.0, 1.0));
  EXPECT_GT(g(at(0.0, 0.0).q, at(0.0, 0.0).p), 0.0);
  EXPECT_TRUE(std::isfinite(g(at(0.0, 0.0).q, at(0.0, 0.0).p)));
}

TEST(AutomaticMonitor, SaysWhyThereIsNone) {
  const auto expect = [](const auto& hamiltonian, const auto& start, const char* reason) {
    const std::string said = refusal([&] { experiment::automatic_monitor(hamiltonian, start); });
    EXPECT_NE(said.find(reason), std::string::npos) << said;
  };
  expect(Free(), at(0.0, 1.0), "no time scale");
  expect(Quartic(), at(0.0, 0.0), "no time scale");
  State<2> z = Kepler::pericentre(0.5);
  expect(Light(), z, "not positive definite");
  z.q.setZero();
  expect(Kepler(), z, "not finite");
}

}  // namespace automatic_monitor_test
