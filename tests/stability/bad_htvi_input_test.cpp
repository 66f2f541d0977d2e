#include "avi/avi.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

// HTVI against arguments and steps that it cannot use.

namespace bad_htvi_input_test {

using namespace avi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

const auto start = Kepler::pericentre(0.5);

auto method(int order = 3, Quadrature rule = gauss(2), SolverSettings solver = {}) {
  return htvi_of_order<Generating::type2>(order, poincare<2>(Kepler{}, start, NormSquared{}), std::move(rule),
                                          solver);
}

TEST(BadHtvi, Arguments) {
  EXPECT_EQ(refusal([] { method(-1); }), "Taylor order r is -1; it must be in [0, 15].");
  EXPECT_EQ(refusal([] { method(16); }), "Taylor order r is 16; it must be in [0, 15].");
  const auto by_rule = [](const Quadrature& rule) { return refusal([&] { method(3, rule); }); };
  EXPECT_EQ(by_rule({"empty", 1, {}, {}}), "Number of quadrature nodes is 0; it must be at least 1.");
  EXPECT_EQ(by_rule({"unequal", 1, {0.0, 1.0}, {1.0}}),
            "Number of quadrature weights is 1; it must be the number of nodes, 2.");
  EXPECT_EQ(by_rule({"light", 1, {0.0}, {0.5}}), "Sum of the quadrature weights is 0.5; it must be 1.");
  EXPECT_EQ(by_rule({"none", 1, {0.0}, {nan}}), "Sum of the quadrature weights is nan; it must be 1.");
  EXPECT_EQ(by_rule({"nowhere", 1, {inf}, {1.0}}), "A quadrature node is inf; it must be in [0, 1].");
  for (const auto& [call, least] :
       std::vector<std::pair<Quadrature (*)(int), int>>{{gauss, 1}, {lobatto, 2}, {radau, 1}})
    for (const int m : {least - 1, -5, 17})
      expect_refusal([&, call = call] { call(m); }, " is " + std::to_string(m) + "; it must be in [");
  for (const double tolerance : {0.0, 0.5, -1.0, nan, inf})
    expect_refusal([&] { method(3, gauss(2), {.tolerance = tolerance}); }, "Solver tolerance is ");
  EXPECT_EQ(refusal([] { method(3, gauss(2), {.max_iterations = 0}); }),
            "Iteration cap is 0; it must be at least 1.");
  State<2> broken = start;
  broken.q[0] = nan;
  expect_refusal([&] { (void)poincare<2>(Kepler{}, broken); }, "nan; it must be finite.");
  broken.q = {0.0, 0.0};
  EXPECT_EQ(refusal([&] { (void)poincare<2>(Kepler{}, broken); }),
            "H at the start is -inf; it must be finite.");
}

TEST(BadHtvi, StepsTooLargeKeepTheLastGoodState) {
  for (const int order : {0, 3, 7, 15})
    for (const double h : {1.0, 10.0, 1e10, 1e100, 1e300}) {
      auto bold = method(order, gauss(4));
      State<2> z = start, last = start;
      const avi::Run run =
          integrate(bold, z, h, {.steps = 100}, [&](const State<2>& now, long) { last = now; });
      if (run.outcome == Outcome::ok) continue;  // a number, if no good one
      EXPECT_TRUE(z.finite());
      EXPECT_TRUE(z.q == last.q && z.p == last.p && z.t == last.t) << order << ' ' << h;
      EXPECT_NE(run.message.find("The run ended as "), std::string::npos);
    }
  auto bold = method(3, gauss(2));
  State<2> z = start;
  EXPECT_NE(integrate(bold, z, 1e100, {.steps = 1}).outcome, Outcome::ok);
}

TEST(BadHtvi, APowerThatVanishesIsNoReasonToFail) {
  const auto quartic = [](const auto& q, const auto& p) {
    using std::pow;
    return 0.5 * p[0] * p[0] + 0.25 * pow(q[0], 4.0);
  };
  const State<1> middle{.q = {0.0}, .p = {1.0}};
  auto good = htvi<8>(poincare<1>(quartic, middle));
  State<1> z = middle;
  EXPECT_EQ(integrate(good, z, 0.05, {.steps = 40}).outcome, Outcome::ok);
  EXPECT_NEAR(quartic(z.q, z.p), 0.5, 1e-11);
}

}  // namespace bad_htvi_input_test
