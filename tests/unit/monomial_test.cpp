#include "beyond/speed/automatic_monitors/monomial.hpp"

#include "avi/autodiff/formula.hpp"

#include <gtest/gtest.h>

namespace monomial_test {

using avi::Recorded;
using experiment::Monomial;

/// Two formulas of (q, p) in one graph, and what the first becomes as a power of parts of the second.
template <class F, class Whole>
std::pair<avi::Formula, avi::Formula> simplified(const F& formula, const Whole& whole,
                                                 const std::vector<double>& near = {0.3, -0.8, 0.4, 1.1}) {
  avi::ExpressionGraph graph(4);
  avi::Vector<Recorded, 2> q, p;
  for (int i = 0; i < 2; ++i)
    q[i] = Recorded(graph, i), p[i] = Recorded(graph, 2 + i);
  const int last = whole(q, p).node_in(graph), before = formula(q, p).node_in(graph);
  const int after = Monomial(graph, near).simplified(before, last);
  return {{graph, before}, {graph, after}};
}

const auto distance = [](const auto& q) { return sqrt(q[0] * q[0] + q[1] * q[1]); };
const avi::Vector<double, 2> there{1.7, 0.4}, moving{-0.6, 0.9};

TEST(Monomial, FindsThePowerOfADistanceInSquaredSecondDerivatives) {
  const auto [before, after] = simplified(
      [](const auto& q, const auto&) {
        const auto r2 = q[0] * q[0] + q[1] * q[1], r5 = r2 * r2 * sqrt(r2);  // of 1/r
        const auto xx = (3.0 * q[0] * q[0] - r2) / r5, yy = (3.0 * q[1] * q[1] - r2) / r5,
                   xy = 3.0 * q[0] * q[1] / r5;
        return xx * xx + yy * yy + 2.0 * xy * xy;
      },
      [](const auto& q, const auto&) { return 1.0 / distance(q); });
  EXPECT_NEAR(after(there, moving) / before(there, moving), 1.0, 1e-13);
  EXPECT_LT(after.work(4), 0.5 * before.work(4));
}

TEST(Monomial, FindsLargePowersBesideTheSquareOfTheWhole) {
  // p^2 / q^20, of which the second derivative squared is 420^2 (p^2 / q^20)^2 q^-4.
  const auto [before, after] = simplified(
      [](const auto& q, const auto& p) {
        const auto bend = 420.0 * p[1] * p[1] * pow(q[0], -22.0);
        return bend * bend + 0.0 * q[1];
      },
      [](const auto& q, const auto& p) { return p[1] * p[1] * pow(q[0], -20.0); });
  EXPECT_NEAR(after(there, moving) / before(there, moving), 1.0, 1e-13);
  // The base is negative on one side, where odd powers would be.
  EXPECT_NEAR(after(-there, moving) / before(-there, moving), 1.0, 1e-13);
}

TEST(Monomial, TakesPowersUpToEightAtOnceAndNoneAbove64) {
  const auto sum = [](const auto& q, const auto&) { return q[0] + q[1]; };
  const auto [direct, again] =
      simplified([](const auto& q, const auto&) { return 3.0 * pow(q[0], -8.0) + 0.0 * q[1]; }, sum);
  EXPECT_EQ(again.work(4), direct.work(4));
  const auto [large, same] = simplified([](const auto& q, const auto&) { return pow(q[0], -68.0); }, sum);
  EXPECT_EQ(same.work(4), large.work(4));
}

TEST(Monomial, LooksBesideAPointAtRest) {
  const auto [before, after] =
      simplified([](const auto&,
                    const auto& p) { return p[0] * p[0] * (p[0] * p[0]) + 2.0 * p[0] * p[0] * p[0] * p[0]; },
                 [](const auto&, const auto& p) { return p[0] * p[0]; }, {0.3, -0.8, 0.0, 0.0});
  EXPECT_NEAR(after(there, moving) / before(there, moving), 1.0, 1e-14);
  EXPECT_LT(after.work(4), before.work(4));
  // At rest it would be a power of q.
  const auto [mixed, same] =
      simplified([](const auto& q, const auto& p) { return pow(q[0], -6.0) * (1.0 + p[0] * p[0]); },
                 [](const auto& q, const auto& p) { return q[0] + p[0]; }, {0.3, -0.8, 0.0, 0.0});
  EXPECT_EQ(same(there, moving), mixed(there, moving));
}

TEST(Monomial, LeavesZeroAndNegativeFormulasAsTheyAre) {
  const auto whole = [](const auto& q, const auto&) { return q[0] * q[0]; };
  const auto [zero, none] = simplified([](const auto& q, const auto&) { return q[0] - q[0]; }, whole);
  EXPECT_EQ(none(there, moving), 0.0);
  const auto [negative, same] =
      simplified([](const auto& q, const auto&) { return -1.0 * pow(q[0], 4.0); }, whole);
  EXPECT_EQ(same(there, moving), negative(there, moving));
}

TEST(Monomial, LeavesOtherFormulasAsTheyAre) {
  const auto [before, after] =
      simplified([](const auto& q, const auto&) { return exp(q[0]) + pow(distance(q), -6.0); },
                 [](const auto& q, const auto&) { return 1.0 / distance(q); });
  EXPECT_EQ(after(there, moving), before(there, moving));
  EXPECT_EQ(after.work(4), before.work(4));
}

}  // namespace monomial_test
