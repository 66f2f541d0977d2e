#include "avi/avi.hpp"

#include <gtest/gtest.h>

#include <cmath>

// Monitors that are of no use where a run starts: each ends as a named outcome, and the state stays.

namespace bad_monitor_test {

using avi::Kepler, avi::Outcome, avi::State;

const State<2> start = Kepler::pericentre(0.5);

/// Of |q - q_0|^2 about the start (1/2, 0) of an orbit of eccentricity 1/2.
struct Monitor {
  enum { good, vanishing, infinite, no_number, negative } kind;
  template <class Q>
  auto operator()(const Q& q) const {
    using std::sqrt;
    using S = std::decay_t<decltype(q[0] * q[0])>;
    const S away = (q[0] - 0.5) * (q[0] - 0.5) + q[1] * q[1];
    return kind == good        ? S(q[0] * q[0] + q[1] * q[1])
           : kind == vanishing ? away
           : kind == infinite  ? S(1.0 / away)
           : kind == negative  ? S(-1.0 - away)
                               : S(sqrt(q[0] - 2.0));
  }
};

/// check(method, whether it is collocation) for methods of every kind that take a monitor.
void for_each_method(const Monitor& monitor, const auto& check) {
  const auto problem = avi::poincare(Kepler(), start, monitor);
  for (const int order : {2, 8, 16})
    check(avi::collocation(problem, order), true);
  for (const int r : {0, 3, 7})
    check(avi::htvi_of_order<avi::Generating::type2>(r, problem, avi::gauss(4)), false);
}

TEST(BadMonitor, LetsNoTimePass) {
  for (const auto& [monitor, outcome] : {std::pair{Monitor{Monitor::vanishing}, Outcome::bad_monitor},
                                         {Monitor{Monitor::negative}, Outcome::bad_monitor},
                                         {Monitor{Monitor::infinite}, Outcome::non_finite},
                                         {Monitor{Monitor::no_number}, Outcome::non_finite}})
    for_each_method(monitor, [&, outcome = outcome](auto method, bool collocation) {
      State<2> z = start;
      const avi::Run run = integrate(method, z, 0.1, {.time = 1.0, .steps = 100});
      EXPECT_TRUE(run.outcome == outcome || (run.outcome == Outcome::non_finite && !collocation))
          << run.message;
      EXPECT_NE(run.message.find(avi::name(run.outcome)), std::string::npos) << run.message;
      EXPECT_EQ(run.steps, 0);
      EXPECT_EQ(z, start);
    });
}

TEST(BadMonitor, IsNotBlamedForAStepOfNoLength) {
  for (const double h : {0.0, -0.0, 5e-324, -5e-324, 1e-320, 1e-300}) {
    for_each_method({Monitor::good}, [&](auto method, bool) {
      auto fresh = method;
      State<2> z = start, once = start;
      EXPECT_TRUE(method.step(z, h).ok()) << h;
      EXPECT_LE(avi::largest_entry(z.q - start.q) + avi::largest_entry(z.p - start.p) + std::abs(z.t),
                10.0 * std::abs(h))
          << h;
      EXPECT_TRUE(method.step(z, h).ok()) << h;
      EXPECT_TRUE(method.step(z, 0.01).ok()) << h;
      EXPECT_TRUE(fresh.step(once, 0.01).ok());
      EXPECT_LT((z.q - once.q).norm() + (z.p - once.p).norm(), 1e-13) << h;
    });
    for_each_method({Monitor::vanishing}, [&](auto method, bool collocation) {
      State<2> z = start;
      if (collocation) {
        EXPECT_FALSE(method.step(z, h == 0.0 ? 1e-300 : h).ok()) << h;
      }
      EXPECT_FALSE(method.step(z, 0.01).ok()) << h;
    });
  }
}

}  // namespace bad_monitor_test
