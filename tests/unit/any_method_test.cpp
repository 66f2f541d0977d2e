#include "avi/core/any_method.hpp"

#include "avi/avi.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace any_method_test {

using avi::AnyMethod, avi::Kepler, avi::State;

const auto force = [](const avi::Vector<double, 2>& q) { return Kepler::potential_gradient(q); };

TEST(AnyMethod, StepsAsWhatIsInIt) {
  const State<2> start = Kepler::pericentre(0.5);
  auto verlet = avi::stormer_verlet<2>(force);
  auto gauss = avi::collocation(avi::poincare(Kepler(), start), 8);
  for (AnyMethod<2> any : {AnyMethod<2>(verlet), AnyMethod<2>(gauss)}) {
    State<2> one = start, other = start, third = start;
    const avi::Run run = integrate(any, one, 0.01, {.steps = 100});
    const bool is_verlet = run.evaluations == 100;
    const avi::Run direct = is_verlet ? avi::integrate(verlet, other, 0.01, {.steps = 100})
                                      : avi::integrate(gauss, other, 0.01, {.steps = 100});
    EXPECT_EQ(one, other);
    EXPECT_EQ(run.evaluations, direct.evaluations);
    long seen = 0;
    AnyMethod<2> fresh = is_verlet ? AnyMethod<2>(avi::stormer_verlet<2>(force))
                                   : AnyMethod<2>(avi::collocation(avi::poincare(Kepler(), start), 8));
    (void)avi::integrate(fresh, third, 0.01, {.steps = 100}, [&](const State<2>&, long k) { seen = k; });
    EXPECT_EQ(seen, 100) << "with an observer";
    EXPECT_EQ(third, one);
  }
}

/// A method that remembers how often it was asked.
struct Counter {
  int steps = 0;
  avi::StepReport step(State<2>& z, double h) {
    ++steps;
    z.t += h * steps;
    return {};
  }
};

TEST(AnyMethod, HasACopyOfItsOwn) {
  AnyMethod<2> first = Counter{}, second = first;
  State<2> z = Kepler::pericentre(0.5);
  (void)first.step(z, 1.0);
  (void)first.step(z, 1.0);
  EXPECT_EQ(z.t, 3.0);
  z.t = 0.0;
  (void)second.step(z, 1.0);
  EXPECT_EQ(z.t, 1.0);
  second = first;
  (void)second.step(z, 1.0);
  EXPECT_EQ(z.t, 4.0);
}

TEST(AnyMethod, EndsAtATime) {
  AnyMethod<2> any = avi::stormer_verlet<2>(force);
  State<2> z = Kepler::pericentre(0.5);
  const avi::Run run = avi::integrate_to(any, z, 0.01, 1.2345);
  EXPECT_TRUE(run.ok());
  EXPECT_EQ(z.t, 1.2345);
}

// Time as a coordinate ended beside the time asked for, and a start with another time was not refused.
TEST(AnyMethod, KnowsTheClockOfTheProblem) {
  const auto driven = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] - cos(q[0]) - 0.3 * q[0] * cos(t * (2.0 / 3.0));
  };
  const avi::State<1> start{.q = {0.5}, .p = {0.0}, .t = 0.1};
  const auto problem = avi::time_dependent(driven, start);
  for (double end = 1.03; end < 300.0; end += 0.37) {
    avi::AnyMethod<2> method = avi::collocation(problem, 8);
    auto z = avi::extended(problem, start);
    ASSERT_TRUE(avi::integrate_to(method, z, 0.3, end).ok());
    EXPECT_EQ(z.q[1], z.t);
    EXPECT_EQ(z.t, end);
  }
  avi::AnyMethod<2> method = avi::collocation(problem, 8);
  auto z = avi::extended(problem, start);
  z.t = 5.0;
  const auto watched = [](const avi::State<2>&, long) {};
  EXPECT_THROW((void)avi::integrate(method, z, 0.3, {.steps = 3}, watched), std::invalid_argument);
}

// The last step of a run forgot the rounding error that the others keep: other bits than inside AnyMethod.
TEST(AnyMethod, EndsCompensatedSplittingsAlike) {
  const avi::State<1> start{.q = {1.0}, .p = {0.3}};
  for (double end = 1.03; end < 100.0; end += 0.37) {
    auto method = avi::splitting<avi::Summation::compensated>(avi::Separable(avi::Pendulum()),
                                                              avi::compositions::kahan_li8);
    avi::AnyMethod<1> any = method;
    avi::State<1> z = start, other = start;
    ASSERT_TRUE(avi::integrate_to(method, z, 0.1, end).ok());
    ASSERT_TRUE(avi::integrate_to(any, other, 0.1, end).ok());
    EXPECT_EQ(z, other) << end;
  }
}

}  // namespace any_method_test
