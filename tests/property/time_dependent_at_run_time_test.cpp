#include "avi/adaptive/time_dependent.hpp"
#include "avi/htvi/htvi.hpp"
#include "property/run_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>

// A Hamiltonian that depends on time, its dimension known to the compiler and only at run time.

namespace {

/// Two pendulums, driven, one hung on the other by a spring.
struct Driven {
  template <class Q, class S, class P>
  S operator()(const Q& q, const S& t, const P& p) const {
    using std::cos, std::sin;
    const S gap = q[0] - q[1];
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - cos(q[0]) - cos(q[1]) + 0.3 * gap * gap +
           0.1 * q[0] * sin(1.5 * t);
  }
};
struct Monitor {
  template <class Q, class S, class P>
  S operator()(const Q& q, const S&, const P&) const {
    return 1.0 / (1.0 + q[0] * q[0]);
  }
};

TEST(TimeDependent, GivesTheSameStepsAtRunTimeDimension) {
  const avi::State<2> start{.q = {1.0, -0.5}, .p = {0.2, 0.4}, .t = 0.3};
  const auto same = run_time(start);
  const auto problem = avi::time_dependent<2>(Driven{}, Monitor{});
  const auto free_problem = avi::time_dependent<avi::dynamic>(Driven{}, Monitor{}, 2);
  auto fixed = extended(problem, start);
  auto free = extended(free_problem, same);
  ASSERT_EQ(free.q.size(), 3);
  auto a = avi::htvi_of_order<avi::Generating::type2>(3, problem, avi::gauss(2));
  auto b = avi::htvi_of_order<avi::Generating::type2>(3, free_problem, avi::gauss(2));
  double worst = 0.0;
  for (int k = 0; k < 50; ++k) {
    ASSERT_EQ(a.step(fixed, 0.1).outcome, avi::Outcome::ok);
    ASSERT_EQ(b.step(free, 0.1).outcome, avi::Outcome::ok);
    worst = std::max(worst, gap(fixed, free));
  }
  EXPECT_LT(worst, 5e-15) << "measured 2e-15";
  const auto end = avi::reduced(free);
  EXPECT_EQ(end.q.size(), 2);
  EXPECT_GT(end.t, start.t + 1.0);
}

}  // namespace
