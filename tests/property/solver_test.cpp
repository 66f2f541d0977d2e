#include "avi/avi.hpp"
#include "common/methods/printed_htvi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

// The implicit equation of a step: how fast it is solved, and what is said when it is not.

using avi::State;

namespace solver_test {

/// A stiff spring with a quartic term, H = p^2 / 2 + w^2 q^2 / 2 + q^4 / 4.
struct Stiff {
  double w;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const auto square = q[0] * q[0];
    return 0.5 * (p[0] * p[0]) + (0.5 * w * w) * square + 0.25 * (square * square);
  }
};

const State<1> start{.q = {0.3}, .p = {0.1}};
constexpr double h = 0.1;

auto method_for(double w, int r, avi::SolverSettings solver) {
  return avi::htvi_of_order<avi::Generating::type2>(r, avi::poincare<1>(Stiff{w}, start), avi::gauss(3),
                                                    solver);
}
avi::Run hundred_steps(double w, int r) {
  auto z = start;
  auto method = method_for(w, r, {});
  return avi::integrate(method, z, h, {.steps = 100});
}
double per_step(const avi::Run& run) {
  return static_cast<double>(run.evaluations) / static_cast<double>(run.steps);
}

// At h w = 1 and above the plain iteration no longer contracts; Broyden's method takes over.
TEST(Solver, ConvergesWhereThePlainIterationDoesNot) {
  for (const auto& [w, r] : {std::pair{10.0, 1}, {14.0, 1}, {20.0, 2}, {25.0, 1}}) {
    const auto run = hundred_steps(w, r);
    ASSERT_EQ(run.outcome, avi::Outcome::ok) << w << ": " << run.message;
    EXPECT_LT(per_step(run), 10.0) << w;  // 4.8 to 6.6
    EXPECT_LT(avi::symplecticity_defect(method_for(w, r, {}), start, h), 1e-10) << w;
  }
}

TEST(Solver, LearnsFromEarlierEvaluationsAndSteps) {
  auto z = avi::Kepler::pericentre(0.9);
  auto method = avi::htvi<8>(avi::poincare<2>(avi::Kepler{}, z, avi::bounded(avi::NormSquared{}, 0.01, 8.0)));
  const auto run = avi::integrate(method, z, 0.64, {.time = 10.0});
  EXPECT_EQ(run.outcome, avi::Outcome::ok);
  EXPECT_LT(per_step(run), 6.0);  // 5.2; 8.2 where nothing is learnt
}

TEST(Predictor, ContinuesTheLineThroughTheLastTwoValues) {
  using Vec = avi::Vector<double, 2>;
  const Vec zero = Vec::Zero(), here(1.0, 2.0), there(3.0, 4.0), first(0.5, -0.25), second(0.75, 1.0);
  avi::Predictor<2> predictor;
  EXPECT_FALSE(predictor.goes_on(0.1, zero));
  predictor.remember(first, 0.1, here, false);
  EXPECT_TRUE(predictor.goes_on(0.1, here));
  EXPECT_EQ(predictor.guess(0.1, here), zero) << "one value is no line";
  predictor.remember(second, 0.1, there, true);
  EXPECT_EQ(predictor.guess(0.1, there), Vec(1.0, 2.25));
  EXPECT_FALSE(predictor.goes_on(0.2, there) || predictor.goes_on(0.1, here));
  EXPECT_EQ(predictor.guess(0.2, there), zero);
  EXPECT_EQ(predictor.guess(0.1, here), zero);
  predictor.remember(first, 0.2, here, false);
  EXPECT_EQ(predictor.guess(0.2, here), zero) << "the step before had another size";
  predictor.remember(second, 0.2, there, false);
  EXPECT_EQ(predictor.guess(0.2, there), zero) << "the step before was of another orbit";
}

TEST(Broyden, SolvesALinearSystemInTwiceAsManyStepsAsItHasUnknowns) {
  using Vec = avi::Vector<double, 2>;
  avi::Matrix<double, 2> a;
  a << 2.5, -1.0, 0.75, -1.5;  // the plain iteration would grow
  const Vec b(1.0, -2.0);
  experiment::Broyden<2> broyden;
  Vec u = Vec::Zero();
  for (int k = 0; k < 5; ++k) {
    const Vec residual = b - a * u;
    u += broyden.shift(residual, residual, k > 0);
  }
  EXPECT_LT((b - a * u).norm(), 1e-13);
}

TEST(Broyden, LearnsNothingFromAShiftThatChangedNothing) {
  const avi::Vector<double, 2> residual(0.3, -0.2);
  experiment::Broyden<2> broyden;
  EXPECT_EQ(broyden.shift(residual, residual, false), residual) << "not yet at work";
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(broyden.shift(residual, residual, true), residual);
}

TEST(SecantModel, KnowsALinearFunctionFromAsManyShiftsAsItHasVariables) {
  // w(u) = A u + b with three results of two variables: u = w is at (I - A_top) u = b_top.
  avi::Matrix<double, 3, 2> a;
  a << 0.2, -0.1, 0.05, 0.3, 1.0, -2.0;
  const auto w = [&](const avi::Vector<double, 2>& u) -> avi::Vector<double, 3> {
    return a * u + avi::Vector<double, 3>(0.7, -0.4, 0.1);
  };
  avi::SecantModel<2, 3> model;
  const avi::Vector<double, 2> x(1.0, 0.0), y(0.0, 1.0), unit(1.0, 1.0);
  EXPECT_NEAR(model.learn(x, w(x) - w(0.0 * x), unit), a.col(0).norm(), 1e-15) << "it knew nothing";
  EXPECT_NEAR(model.learn(y, w(y) - w(0.0 * y), unit), a.col(1).norm(), 1e-15);
  EXPECT_NEAR(model.learn(x + y, w(x + y) - w(0.0 * x), unit), 0.0, 1e-15);
  const avi::Vector<double, 2> u(0.3, 0.8), shift = model.shift(w(u).head<2>() - u);
  EXPECT_NEAR((w(u + shift).head<2>() - u - shift).norm(), 0.0, 1e-15);
  EXPECT_NEAR((w(u + shift) - w(u) - model.change(shift)).norm(), 0.0, 1e-15);
}

// When the residual counts as round-off: with the least tolerance the iteration has to notice that it
// stagnates.
TEST(Solver, SeesAnEquilibriumAtOnce) {
  const State<1> rest{.q = {0.0}, .p = {0.0}};
  for (const int r : {1, 3}) {
    auto z = rest;
    auto method = method_for(1.0, r, {});
    const avi::Run run = avi::integrate(method, z, h, {.steps = 10});
    EXPECT_EQ(run.outcome, avi::Outcome::ok) << run.message;
    EXPECT_EQ(run.evaluations, 10) << "one a step";
    EXPECT_EQ(z.q, rest.q);
    EXPECT_EQ(z.p, rest.p);
  }
}

TEST(Solver, EndsAtRoundOff) {
  const struct {
    double tolerance, step;
    long expansions;  // measured
  } runs[] = {{8.0, 0.05, 400}, {8.0, 0.2, 598}, {1.0, 0.05, 400}, {1.0, 0.2, 602}};
  for (const auto& [tolerance, step, expansions] : runs) {
    auto z = avi::Kepler::pericentre(0.6);
    auto method = avi::htvi_of_order<avi::Generating::type2>(
        3, avi::poincare<2>(avi::Kepler{}, z, avi::NormSquared{}), avi::gauss(4), {.tolerance = tolerance});
    const auto run = avi::integrate(method, z, step, {.steps = 200});
    ASSERT_EQ(run.outcome, avi::Outcome::ok);
    EXPECT_LE(run.evaluations, 1.01 * expansions) << "tolerance " << tolerance << ", h = " << step;
  }
}

// What a step adds after its last expansion, by the derivative it has learnt, belongs to time and the
// conjugate variable, too: all of a step is as exact as the residual accepted.
TEST(Solver, StepsAreAsExactAsTheToleranceInTimeToo) {
  auto z = avi::Kepler::pericentre(0.6);
  const auto problem = avi::poincare<2>(avi::Kepler{}, z, avi::NormSquared{});
  auto loose = avi::type2<1>(problem, avi::gauss(2), {.tolerance = 1e4});
  double motion = 0.0, time = 0.0;
  for (int i = 0; i < 100; ++i) {
    auto exact = z;
    auto strict = avi::type2<1>(problem, avi::gauss(2));
    ASSERT_EQ(strict.step(exact, 0.4).outcome, avi::Outcome::ok);
    ASSERT_EQ(loose.step(z, 0.4).outcome, avi::Outcome::ok);
    motion = std::max({motion, (z.q - exact.q).norm(), (z.p - exact.p).norm()});
    time = std::max(time, std::abs(z.t - exact.t));
  }
  EXPECT_LT(motion, 6e-12);  // measured 3.1e-12, accepted 2.2e-12
  EXPECT_LT(time, 5e-13);    // measured 2.5e-13
}

TEST(Solver, SaysWithStateAndResidualWhenNothingConverges) {
  auto z = start;
  auto method = method_for(10.0, 1, {.max_iterations = 2});
  const auto run = avi::integrate(method, z, h, {.steps = 100});
  EXPECT_EQ(run.outcome, avi::Outcome::not_converged);
  EXPECT_EQ(run.steps, 0);
  EXPECT_EQ(z.q, start.q) << "the last good state";
  const std::string expected = "The run ended as not_converged after 0 steps, at t = 0, q = "
                               "(0.3), p = (0.1), with residual ";
  EXPECT_TRUE(run.message.starts_with(expected)) << run.message;
  EXPECT_GT(std::stod(run.message.substr(expected.size())), 1e-12) << run.message;
}

// What it refuses is in bad_htvi_input_test.cpp.
TEST(Solver, HasItsUsualSettings) {
  EXPECT_NO_THROW(method_for(1.0, 1, {.max_iterations = 1}));
  const avi::SolverSettings usual;
  EXPECT_EQ(usual.tolerance, 8.0);
  EXPECT_EQ(usual.max_iterations, 50);
}

}  // namespace solver_test
