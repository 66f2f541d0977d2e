#include "avi/transform/time_dependent.hpp"

#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>

// Physical time of a problem that depends on time: it is a coordinate, and fictive time is another thing.

namespace time_dependent_test {

/// H = p^2 / 2 + (1 + t)^2 q^2 / 2.
const auto stiffening = [](const auto& q, const auto& t, const auto& p) {
  const auto frequency = 1.0 + t;
  return 0.5 * (p[0] * p[0]) + 0.5 * (frequency * frequency) * (q[0] * q[0]);
};

const auto slower = [](const auto&, const auto& t, const auto&) { return 1.0 / (1.0 + t); };

const avi::State<1> start{.q = {1.0}, .p = {0.3}, .t = 0.25};

auto method(auto monitor) {
  return avi::type2<3>(avi::time_dependent(stiffening, start, monitor), avi::gauss(2));
}

TEST(TimeDependent, TimeIsPhysicalInTheState) {
  auto m = method(slower);
  avi::State<2> z = extended(m.problem(), start);
  ASSERT_EQ(m.step(z, 0.1).outcome, avi::Outcome::ok);
  const double exact = std::sqrt(1.25 * 1.25 + 0.2) - 1.0;  // dt/dtau = 1 / (1 + t)
  EXPECT_NEAR(z.t, exact, 2e-6) << "measured 1.1e-6";
  EXPECT_EQ(z.t, z.q[1]);
}

TEST(TimeDependent, TakesTheMonitorsOfAutonomousProblems) {
  const auto of_q = [](const auto& q) { return 1.0 / (1.0 + q[0] * q[0]); };
  const auto of_qp = [](const auto& q, const auto&) { return 1.0 / (1.0 + q[0] * q[0]); };
  const auto of_qtp = [](const auto& q, const auto&, const auto&) { return 1.0 / (1.0 + q[0] * q[0]); };
  auto a = method(of_q);
  auto b = method(of_qp);
  auto c = method(of_qtp);
  avi::State<2> x = extended(a.problem(), start), y = extended(b.problem(), start),
                z = extended(c.problem(), start);
  for (int k = 0; k < 10; ++k) {
    ASSERT_EQ(a.step(x, 0.1).outcome, avi::Outcome::ok);
    ASSERT_EQ(b.step(y, 0.1).outcome, avi::Outcome::ok);
    ASSERT_EQ(c.step(z, 0.1).outcome, avi::Outcome::ok);
  }
  EXPECT_TRUE(x.q == z.q && x.p == z.p && x.t == z.t);
  EXPECT_TRUE(y.q == z.q && y.p == z.p && y.t == z.t);
  EXPECT_LT(z.t, 0.25 + 0.9) << "the monitor slows time down";
}

TEST(TimeDependent, RefusesAStartWithTwoTimes) {
  auto m = method(slower);
  const auto answer = [&](double t) {
    avi::State<2> z = extended(m.problem(), start);
    z.t = t;
    return refusal([&] { (void)avi::integrate(m, z, 0.1, {.time = 7.0}); });
  };
  EXPECT_EQ(answer(5.0), "Time t of the start is 5; it must be that among its coordinates, 0.25.");
  EXPECT_EQ(answer(-5.0), "Time t of the start is -5; it must be that among its coordinates, 0.25.");
  EXPECT_EQ(answer(start.t), "accepted");
  EXPECT_EQ(answer(std::nextafter(start.t, 1.0)), "accepted");
}

}  // namespace time_dependent_test
