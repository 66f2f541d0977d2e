#include "avi/optim/run_updates.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "common/rules/update_rules.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <limits>

using avi::Outcome, avi::run_updates, avi::VectorX, experiment::GradientDescent;

namespace run_updates_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// |x|^2 / 2, with a switch that makes the k-th evaluation return what is not a number.
struct Bowl {
  enum class Fault { none, value, gradient } fault = Fault::none;
  long at = 0;
  mutable long calls = 0;
  double operator()(const VectorX& x, VectorX& gradient) const {
    gradient = x;
    const bool now = ++calls == at;
    if (now && fault == Fault::gradient) gradient[0] = nan;
    return now && fault == Fault::value ? nan : 0.5 * avi::dot(x, x);
  }
};

TEST(RunUpdates, StopsAtTheFirstPassageAndCounts) {
  // x halves every time: f = 2^-(2k+1), |g| = 2^-k; |f_k - f_(k-1)| = 3 f_k.
  const auto run = run_updates(Bowl{}, GradientDescent{.h = 0.5}, VectorX::Ones(1), {.delta = 1e-3});
  EXPECT_TRUE(run.ok());
  EXPECT_EQ(run.iterations, 10);  // 2^-10 < 1e-3 <= 2^-9
  EXPECT_EQ(run.gradient_evaluations, 11);
  EXPECT_EQ(run.function_evaluations, 11);
  EXPECT_EQ(run.last.value, 0.5 * std::pow(2.0, -20));
  EXPECT_EQ(run.message, "");
}

TEST(Stopping, HasThePapersLimitsUnlessToldOtherwise) {
  const avi::Stopping stopping;
  EXPECT_EQ(stopping.delta, 1e-10);
  EXPECT_EQ(stopping.iterations, 10'000'000);
  EXPECT_EQ(stopping.growth, 1e30);
  // Both below delta, and neither at it.
  const auto holds = [&](double change, double slope) {
    return avi::Stopping{.delta = 0.5}.holds(change, {.x = {}, .gradient = VectorX::Constant(1, slope)});
  };
  EXPECT_TRUE(holds(-0.4, 0.4));
  EXPECT_FALSE(holds(-0.5, 0.4));
  EXPECT_FALSE(holds(0.4, -0.5));
  EXPECT_NO_THROW((avi::Stopping{.delta = 0.0, .iterations = 1, .growth = 1.0}.validate()));
  EXPECT_THROW(avi::Stopping{.growth = 0.5}.validate(), std::invalid_argument);
}

TEST(RunUpdates, SaysWhenTheCapEndsIt) {
  const auto run =
      run_updates(Bowl{}, GradientDescent{.h = 0.5}, VectorX::Ones(1), {.delta = 0.0, .iterations = 7});
  EXPECT_EQ(run.outcome, Outcome::step_limit);
  EXPECT_EQ(run.iterations, 7);
  EXPECT_NE(run.message.find("step_limit at iteration 7"), std::string::npos) << run.message;
}

TEST(RunUpdates, NamesIterationAndValueOfWhatIsNotANumber) {
  const GradientDescent method{.h = 0.5};
  const auto value = run_updates(Bowl{.fault = Bowl::Fault::value, .at = 5}, method, VectorX::Ones(3));
  EXPECT_EQ(value.outcome, Outcome::non_finite);
  EXPECT_EQ(value.message, "The run ended as non_finite at iteration 4, where f = nan: the objective's value "
                           "is not a number.");
  const auto gradient = run_updates(Bowl{.fault = Bowl::Fault::gradient, .at = 5}, method, VectorX::Ones(3));
  EXPECT_EQ(gradient.outcome, Outcome::non_finite);
  EXPECT_EQ(gradient.iterations, 5);
  // The last good iterates are x_3 and x_4, of 2^-k in every entry.
  EXPECT_EQ(value.last.x, VectorX::Constant(3, 0.125));
  EXPECT_EQ(gradient.last.x, VectorX::Constant(3, 0.0625));
  EXPECT_EQ(gradient.last.gradient, VectorX::Constant(3, 0.0625));
  EXPECT_EQ(gradient.last.value, 1.5 * 0.0625 * 0.0625);
  const auto start =
      refusal([&] { run_updates(Bowl{.fault = Bowl::Fault::value, .at = 1}, method, VectorX::Ones(3)); });
  EXPECT_EQ(start, "Value of the objective at x0 is nan; it must be finite.");
}

TEST(RunUpdates, ReportsDivergenceAtOnce) {
  // x_k = (-9)^k: 9^k > 1e30 first at k = 32; the values, 81^k / 2, already at k = 16.
  const auto run = run_updates(Bowl{}, GradientDescent{.h = 10.0}, VectorX::Ones(2));
  EXPECT_EQ(run.outcome, Outcome::diverged);
  EXPECT_EQ(run.iterations, 16);
  EXPECT_EQ(run.last.x, VectorX::Constant(2, std::pow(-9.0, 15))) << "the last good one";
  EXPECT_EQ(run.last.value, std::pow(81.0, 15));
  const auto quartic =
      run_updates(experiment::CorrelatedQuartic{}, GradientDescent{.h = 1.0}, VectorX::Constant(50, 5.0));
  EXPECT_EQ(quartic.outcome, Outcome::diverged);
  EXPECT_LT(quartic.iterations, 100);
}

TEST(RunUpdates, BoundsTheValueAndNotX) {
  const auto level = [](const VectorX& x, VectorX& g) {
    g[0] = -1.0 / (1.0 + x[0] * x[0]);
    return -std::atan(x[0]);
  };
  const auto run = run_updates(level, GradientDescent{.h = 10.0}, VectorX::Zero(1),
                               {.delta = 0.0, .iterations = 2000, .growth = 10.0});
  EXPECT_EQ(run.outcome, Outcome::step_limit);
  EXPECT_GT(run.last.x[0], 30.0);
}

TEST(RunUpdates, AnInfiniteValueIsOutOfEveryBound) {
  // f starts at a thousandth of the largest double, so that 1e30 times it, the bound, overflows.
  const auto steep = [](const VectorX& x, VectorX& g) { return g = x, 0.5e305 * avi::dot(x, x); };
  const auto run = run_updates(steep, GradientDescent{.h = 10.0}, VectorX::Ones(1));
  EXPECT_EQ(run.outcome, Outcome::diverged);
  EXPECT_EQ(run.iterations, 2);  // f = 0.5e305 81^k
  EXPECT_EQ(run.last.x[0], -9.0);
}

TEST(RunUpdates, ShowsEveryIterateAndMayBeStopped) {
  long seen = 0;
  const auto run = run_updates(Bowl{}, GradientDescent{.h = 0.5}, VectorX::Ones(1), {},
                               [&](const avi::Iterate& at, long k, long gradients) {
                                 EXPECT_EQ(k, seen++);
                                 EXPECT_EQ(gradients, k + 1);
                                 EXPECT_EQ(at.x[0], std::pow(2.0, -static_cast<double>(k)));
                                 return k < 3;
                               });
  EXPECT_EQ(run.outcome, Outcome::stopped);
  EXPECT_EQ(run.iterations, 3);
}

TEST(RunUpdates, RefusesBadInput) {
  const GradientDescent method{.h = 0.5};
  const VectorX one = VectorX::Ones(1);
  EXPECT_EQ(refusal([&] { run_updates(Bowl{}, method, VectorX()); }),
            "Size of x0 is 0; it must be at least 1.");
  EXPECT_EQ(refusal([&] { run_updates(Bowl{}, method, VectorX::Constant(1, nan)); }),
            "Largest entry of x0 is nan; it must be finite.");
  EXPECT_EQ(refusal([&] { run_updates(Bowl{}, method, one, {.delta = -1.0}); }),
            "Tolerance delta is -1; it must be finite and at least 0.");
  EXPECT_EQ(refusal([&] { run_updates(Bowl{}, method, one, {.delta = nan}); }),
            "Tolerance delta is nan; it must be finite and at least 0.");
  EXPECT_EQ(refusal([&] { run_updates(Bowl{}, method, one, {.iterations = 0}); }),
            "Cap on iterations is 0; it must be at least 1.");
  EXPECT_EQ(refusal([&] { run_updates(Bowl{}, GradientDescent{.h = 0.0}, one); }),
            "Step size h is 0; it must be finite and positive.");
  EXPECT_EQ(refusal([&] { run_updates(experiment::CorrelatedQuartic{7}, method, one); }),
            "Size of x is 1; it must be the objective's dimension, 7.");
  const auto wrong = [](const VectorX&, VectorX& g) { return g.setZero(2), 1.0; };
  EXPECT_EQ(refusal([&] { run_updates(wrong, method, one); }),
            "Size of the gradient is 2; it must be the size of x0, 1.");
  int calls = 0;
  const auto changing = [&](const VectorX& x, VectorX& g) {
    g = 2.0 * x.head(++calls > 3 ? 1 : 3);
    return avi::dot(x, x);
  };
  EXPECT_EQ(refusal([&] { run_updates(changing, GradientDescent{.h = 0.1}, VectorX::Ones(3)); }),
            "Size of the gradient is 1; it must be the size of x0, 3.");
  const auto forgotten = [](const VectorX& x, VectorX&) { return x[0]; };
  EXPECT_EQ(refusal([&] { run_updates(forgotten, method, one); }),
            "Norm of the gradient at x0 is nan; it must be finite.");
}

TEST(RunUpdates, GivesUpWhereNoStepIsAccepted) {
  // The gradient points uphill, so no radius helps.
  const auto wrong = [](const VectorX& x, VectorX& g) { return g = -x, 0.5 * avi::dot(x, x); };
  const auto run = run_updates(wrong, experiment::TrustRegion{}, VectorX::Ones(2));
  EXPECT_EQ(run.outcome, Outcome::not_converged);
  EXPECT_EQ(run.iterations, 1);
}

}  // namespace run_updates_test
