#include "avi/core/dense_output.hpp"

#include "avi/avi.hpp"
#include "common/methods/printed_htvi.hpp"
#include "refusal.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using avi::Kepler, avi::State;

namespace dense_output_test {

auto method_for(const State<2>& z) {
  return avi::type2<3, experiment::Authors>(avi::poincare(Kepler{}, z, avi::NormSquared{}), avi::simpson());
}

TEST(DenseOutput, HasLocalOrderRPlusOne) {
  std::vector<double> steps, errors;
  for (double h = 0.2; h > 0.01; h *= 0.5) {
    const auto start = Kepler::pericentre(0.5);
    auto z = start;
    auto method = method_for(z);
    ASSERT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
    double worst = 0.0;
    for (double c : {0.0, 0.25, 0.5, 0.9, 1.0}) {
      const double t = c * z.t;
      const auto s = avi::dense_output(method, start, z, t);
      EXPECT_EQ(s.t, t);
      const auto exact = Kepler::exact(0.5, t);
      worst = std::max({worst, (s.q - exact.q).norm(), (s.p - exact.p).norm()});
    }
    steps.push_back(h);
    errors.push_back(worst);
  }
  EXPECT_NEAR(avi::fit_order(steps, errors).order, 4.0, 0.3);  // r + 1
}

TEST(DenseOutput, RefusesTimesOutsideTheStepBesideItToo) {
  const auto start = Kepler::pericentre(0.5);
  auto method = method_for(start);
  auto z = start;
  for (const double h : {0.1, -0.1}) {
    const auto before = z;
    ASSERT_EQ(method.step(z, h).outcome, avi::Outcome::ok);
    const double length = z.t - before.t;
    EXPECT_EQ(avi::dense_output(method, before, z, before.t).q, before.q);
    EXPECT_EQ(avi::dense_output(method, before, z, z.t).q, z.q);
    for (const double part : {-1.0, -1e-6, 1.0 + 1e-6, 2.0})
      EXPECT_THROW((void)avi::dense_output(method, before, z, before.t + part * length),
                   std::invalid_argument)
          << part;
    EXPECT_THROW((void)avi::dense_output(method, before, z, std::nan("")), std::invalid_argument);
  }
}

template <class Method>
void expect_continuous(Method method, State<2> z) {
  double worst = 0.0;
  const auto run =
      avi::integrate(method, z, 0.2, {.steps = 20}, [&]<class M>(const avi::Step<M, State<2>>& step, long) {
        const double length = step.after.t - step.before.t;
        for (const auto& [end, t] : {std::pair{step.before, step.before.t + 1e-9 * length},
                                     {step.after, step.after.t - 1e-9 * length}}) {
          const auto near = avi::dense_output(step, t);
          worst = std::max({worst, (near.q - end.q).norm(), (near.p - end.p).norm()});
        }
      });
  EXPECT_EQ(run.outcome, avi::Outcome::ok);
  EXPECT_LT(worst, 1e-8) << "the motion over a billionth of the step";
}

TEST(DenseOutput, IsContinuousFromStepToStep) {
  const auto start = Kepler::pericentre(0.5);
  const auto problem = avi::poincare(Kepler{}, start, avi::NormSquared{});
  expect_continuous(method_for(start), start);
  expect_continuous(avi::type3<2>(problem, avi::simpson()), start);
  expect_continuous(avi::collocation(problem, 4), start);
}

template <class Method>
void expect_of_the_last_step_alone(Method method, const State<1>& before) {
  State<1> after = before;
  const Method never = method;
  ASSERT_TRUE(method.step(after, 0.5).ok());
  const auto middle = [&](const Method& of) { (void)avi::dense_output(of, before, after, 0.25); };
  EXPECT_EQ(refusal([&] { middle(method); }), "accepted");
  const std::string sentence =
      "Last step of the method of dense output is another one; it must be that from `before` to `after`.";
  EXPECT_EQ(refusal([&] { middle(never); }), sentence);
  State<1> later = after;
  ASSERT_TRUE(method.step(later, 0.5).ok());
  EXPECT_EQ(refusal([&] { middle(method); }), sentence);
}

TEST(DenseOutput, IsOfTheLastStepOfTheMethodAlone) {
  for (const State<1>& start : {systems::at(1.0, 0.0), systems::at(0.0, 1.0)}) {
    const auto problem = avi::poincare(systems::spring, start);
    expect_of_the_last_step_alone(avi::collocation(problem, 8), start);
    expect_of_the_last_step_alone(avi::type2<0>(problem), start);
    expect_of_the_last_step_alone(avi::type2<3>(problem), start);
    expect_of_the_last_step_alone(avi::type3<0>(problem), start);
    expect_of_the_last_step_alone(avi::type3<3>(problem), start);
  }
}

}  // namespace dense_output_test
