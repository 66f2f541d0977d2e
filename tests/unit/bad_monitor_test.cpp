#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/poincare.hpp"

#include <gtest/gtest.h>

#include <cmath>

// Monitors that are of no use where a run starts: each ends as a named outcome, and the state stays.

namespace bad_monitor_test {

using avi::Kepler, avi::Outcome;

/// Of |q - q_0|^2 about the start (1/2, 0) of an orbit of eccentricity 1/2.
struct Monitor {
  enum { vanishing, infinite, no_number, negative } kind;
  template <class Q>
  auto operator()(const Q& q) const {
    using std::sqrt;
    using S = std::decay_t<decltype(q[0] * q[0])>;
    const S away = (q[0] - 0.5) * (q[0] - 0.5) + q[1] * q[1];
    return kind == vanishing  ? away
           : kind == infinite ? S(1.0 / away)
           : kind == negative ? S(-1.0 - away)
                              : S(sqrt(q[0] - 2.0));
  }
};

void expect(Outcome outcome, const Monitor& monitor) {
  const avi::State<2> start = Kepler::pericentre(0.5);
  for (const int order : {2, 8, 16}) {
    auto method = avi::collocation(poincare(Kepler(), start, monitor), order);
    avi::State<2> z = start;
    const avi::Run run = integrate(method, z, 0.1, avi::Until{.time = 1.0});
    EXPECT_EQ(run.outcome, outcome) << order << ": " << run.message;
    EXPECT_NE(run.message.find(std::string(avi::name(outcome))), std::string::npos) << run.message;
    EXPECT_EQ(run.steps, 0);
    EXPECT_EQ(z, start);
  }
}

TEST(BadMonitor, LetsNoTimePass) {
  expect(Outcome::bad_monitor, {Monitor::vanishing});
  expect(Outcome::bad_monitor, {Monitor::negative});
  expect(Outcome::non_finite, {Monitor::infinite});
  expect(Outcome::non_finite, {Monitor::no_number});
}

TEST(BadMonitor, IsNotBlamedForAStepOfNoLength) {
  const auto distance = [](const auto& q) { return q[0] * q[0] + q[1] * q[1]; };
  const auto start = Kepler::pericentre(0.5);
  for (const double h : {0.0, 5e-324, -5e-324, 1e-320, 1e-300}) {
    auto method = avi::collocation(avi::poincare<2>(Kepler{}, start, distance), 8);
    auto z = start;
    EXPECT_EQ(method.step(z, h).outcome, Outcome::ok) << h;
    EXPECT_LE(avi::largest_entry(z.q - start.q) + avi::largest_entry(z.p - start.p) + std::abs(z.t),
              10.0 * std::abs(h))
        << h;
    auto vanishing = avi::collocation(avi::poincare<2>(Kepler{}, start, Monitor{Monitor::vanishing}), 8);
    EXPECT_NE(vanishing.step(z, h == 0.0 ? 1e-300 : h).outcome, Outcome::ok) << h;
  }
}

}  // namespace bad_monitor_test
