#include "avi/adaptive/monitors.hpp"
#include "avi/adaptive/time_dependent.hpp"
#include "avi/core/integrate.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/htvi/landing.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

#include <vector>

using avi::Kepler;
using avi::State;

namespace {

auto method_for(const State<2>& z) {
  return avi::type2<3, avi::authors>(avi::poincare<2>(Kepler{}, z, avi::NormSquared{}), avi::simpson());
}

TEST(IntegrateTo, LandsOnTheRequestedTime) {
  for (double t_end : {0.001, 1.0, 7.3, 10.0}) {
    auto z = Kepler::pericentre(0.9);
    auto method = method_for(z);
    long shown = 0;
    double last = 0.0;
    const auto run = avi::integrate_to(method, z, 0.05, t_end, [&](const State<2>& s, long k) {
      EXPECT_EQ(k, ++shown);
      last = s.t;
    });
    EXPECT_EQ(run.outcome, avi::Outcome::ok);
    EXPECT_NEAR(z.t, t_end, 2e-15 * std::max(1.0, t_end));
    EXPECT_EQ(last, z.t) << "the landed state is the last one shown";
    EXPECT_NEAR((z.q - Kepler::exact(0.9, t_end).q).norm(), 0.0, 1.3e-5);
  }
  auto z = Kepler::pericentre(0.9);
  auto method = method_for(z);
  EXPECT_THROW(avi::integrate_to(method, z, 0.05, -1.0), std::invalid_argument);
  EXPECT_THROW(avi::integrate_to(method, z, -0.05, 1.0), std::invalid_argument);
}

TEST(IntegrateTo, StopsWhenItsObserverSaysSo) {
  const auto start = Kepler::pericentre(0.5);
  auto method = avi::type2<3>(avi::poincare<2>(Kepler{}, start, avi::NormSquared{}), avi::simpson());
  auto z = start;
  long shown = 0;
  const auto early = avi::integrate_to(method, z, 0.05, 3.0, [&](const State<2>&, long k) {
    shown = k;
    return k < 4;
  });
  EXPECT_EQ(early.outcome, avi::Outcome::stopped);
  EXPECT_EQ(early.steps, 4);
  EXPECT_EQ(shown, 4);
  EXPECT_LT(z.t, 3.0);
  z = start;
  const auto last =
      avi::integrate_to(method, z, 0.05, 3.0, [](const State<2>& now, long) { return now.t < 3.0; });
  EXPECT_EQ(last.outcome, avi::Outcome::stopped) << "at the end itself";
  EXPECT_NEAR(z.t, 3.0, 1e-14);
}

TEST(DenseOutput, HasLocalOrderRPlusOne) {
  std::vector<double> steps, errors;
  for (double h = 0.2; h > 0.01; h *= 0.5) {
    auto z = Kepler::pericentre(0.5);
    auto method = method_for(z);
    ASSERT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
    double worst = 0.0;
    for (double c : {0.0, 0.25, 0.5, 0.9, 1.0}) {
      const double t = c * z.t;
      const auto s = avi::dense_output(method, 0.0, t);
      EXPECT_EQ(s.t, t);
      const auto exact = Kepler::exact(0.5, t);
      worst = std::max({worst, (s.q - exact.q).norm(), (s.p - exact.p).norm()});
    }
    steps.push_back(h);
    errors.push_back(worst);
    EXPECT_THROW((void)avi::dense_output(method, 0.0, 2.0 * z.t), std::invalid_argument);
  }
  EXPECT_NEAR(avi::fit_order(steps, errors).order, 4.0, 0.3);  // r + 1
}

/// An oscillator whose frequency varies, H = p^2 / 2 + (1 + t) q^2 / 2: q = Ai(-(1 + t)) solves q'' = -(1 +
/// t) q. Its reference is a run with small steps of another method, so that the two routes share nothing.
struct Stiffening {
  template <class Q, class S, class P>
  S operator()(const Q& q, const S& t, const P& p) const {
    return 0.5 * (p[0] * p[0]) + 0.5 * (1.0 + t) * (q[0] * q[0]);
  }
};

State<1> runge_kutta(State<1> z, double t_end, int steps) {
  const double h = (t_end - z.t) / steps;
  const auto force = [](double t, double q) { return -(1.0 + t) * q; };
  for (int k = 0; k < steps; ++k) {
    const double q = z.q[0], p = z.p[0], t = z.t;
    const double a1 = p, b1 = force(t, q);
    const double a2 = p + 0.5 * h * b1, b2 = force(t + 0.5 * h, q + 0.5 * h * a1);
    const double a3 = p + 0.5 * h * b2, b3 = force(t + 0.5 * h, q + 0.5 * h * a2);
    const double a4 = p + h * b3, b4 = force(t + h, q + h * a3);
    z.q[0] += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    z.p[0] += h / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4);
    z.t += h;
  }
  return z;
}

TEST(TimeDependent, FollowsAnOscillatorOfVaryingFrequency) {
  const State<1> start{.q = avi::Vector<double, 1>(1.0), .p = avi::Vector<double, 1>(0.0), .t = 0.0};
  const auto exact = runge_kutta(start, 3.0, 20000);
  const auto monitor = [](const auto&, const auto& t, const auto&) {
    using std::sqrt;
    return 1.0 / sqrt(1.0 + t);
  };
  const auto problem = avi::time_dependent<1>(Stiffening{}, monitor);
  std::vector<double> steps, errors;
  for (double h : {0.2, 0.1, 0.05}) {
    auto z = avi::extended(problem, start);
    auto method = avi::type2<3, avi::printed>(problem, avi::gauss(2));
    const auto run = avi::integrate_to(method, z, h, 3.0);
    ASSERT_EQ(run.outcome, avi::Outcome::ok) << run.message;
    const auto end = avi::reduced(z);
    EXPECT_NEAR(end.t, 3.0, 1e-14);
    EXPECT_NEAR(z.p[1], -Stiffening{}(end.q, end.t, end.p), 20.0 * std::pow(h, 4))
        << "p^t is minus the energy";
    steps.push_back(h);
    errors.push_back(std::hypot(end.q[0] - exact.q[0], end.p[0] - exact.p[0]));
  }
  EXPECT_LT(errors.back(), 1e-5);
  EXPECT_NEAR(avi::fit_order(steps, errors).order, 4.0, 0.5);
}

}  // namespace
