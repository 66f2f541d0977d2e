#include "avi/avi.hpp"
#include "common/methods/printed_htvi.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

using avi::Kepler, avi::State;

namespace htvi_order_test {

const Kepler kepler;

/// Slope of the position error, against the exact orbit at the method's own time, over steps h, h/2, h/4, ...
template <class MethodFor>
avi::OrderFit kepler_order(double e, double h, MethodFor method_for) {
  std::vector<double> steps, errors;
  for (int k = 0; k < 5; ++k) {
    auto z = Kepler::pericentre(e);
    auto method = method_for(z);
    const auto run = avi::integrate(method, z, std::ldexp(h, -k), {.time = 2.0});
    EXPECT_EQ(run.outcome, avi::Outcome::ok) << run.message;
    steps.push_back(std::ldexp(h, -k));
    errors.push_back((z.q - Kepler::exact(e, z.t).q).norm());
  }
  return avi::fit_order(steps, errors, {.floor = 1e-12, .at_least = 3, .at_most = 3});
}

template <int r, class Construction, avi::Generating type = avi::Generating::type2, class G>
double htvi_order(const avi::Quadrature& rule, const G& monitor, double h) {
  const auto fit = kepler_order(0.5, h, [&](const State<2>& z) {
    const auto problem = avi::poincare<2>(kepler, z, monitor);
    return avi::Htvi<type, std::remove_const_t<decltype(problem)>, r, Construction>(problem, rule);
  });
  EXPECT_GE(fit.points, 3);
  return fit.order;
}

// The theorem promises min(r + 1, s) at least.
TEST(TypeII, PrintedConstructionHasOrderFourWithSimpson) {
  EXPECT_NEAR((htvi_order<3, experiment::Printed>(avi::simpson(), avi::NormSquared{}, 0.1)), 4.0, 0.3);
  EXPECT_NEAR((htvi_order<3, experiment::Printed>(avi::simpson(), avi::Unit{}, 0.1)), 4.0, 0.3);
}

TEST(TypeII, AuthorsConstructionHasOrderFour) {
  EXPECT_NEAR((htvi_order<3, experiment::Authors>(avi::simpson(), avi::NormSquared{}, 0.1)), 4.0, 0.3);
  EXPECT_NEAR((htvi_order<3, experiment::Authors>(avi::simpson(), avi::Unit{}, 0.1)), 4.0, 0.3);
}

TEST(TypeIII, HasTheOrderOfTypeII) {
  constexpr auto type3 = avi::Generating::type3;
  EXPECT_NEAR((htvi_order<3, experiment::Authors, type3>(avi::simpson(), avi::NormSquared{}, 0.1)), 4.0, 0.3);
  EXPECT_NEAR((htvi_order<1, experiment::Printed, type3>(avi::simpson(), avi::Unit{}, 0.05)), 2.0, 0.3);
}

TEST(TypeII, QuadratureLimitsTheOrder) {
  EXPECT_NEAR((htvi_order<3, experiment::Printed>(avi::midpoint(), avi::Unit{}, 0.05)), 2.0, 0.3);
  EXPECT_NEAR((htvi_order<1, experiment::Printed>(avi::simpson(), avi::Unit{}, 0.05)), 2.0, 0.3);
}

TEST(TypeII, StationaryConstructionHasTwiceTheOrder) {
  EXPECT_NEAR((htvi_order<3, avi::Stationary>(avi::gauss(4), avi::NormSquared{}, 0.3)), 8.0, 0.3);
  EXPECT_NEAR((htvi_order<1, avi::Stationary>(avi::gauss(2), avi::Unit{}, 0.1)), 4.0, 0.3);
}

// The force q_2 q_1^(q_2 - 1) is zero at the start, and not a moment later.
TEST(Htvi, HasItsOrderWhereAnExponentBeginsAtZero) {
  const auto power = [](const auto& q, const auto& p) {
    using std::pow;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + pow(q[0], q[1]);
  };
  const auto exponential = [](const auto& q, const auto& p) {
    using std::exp, std::log;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + exp(q[1] * log(q[0]));
  };
  const State<2> start{.q = {2.0, 0.0}, .p = {0.1, 1.0}};
  const auto end = [&](const auto& h) {
    auto method = avi::htvi<6>(avi::poincare(h, start));
    State<2> z = start;
    EXPECT_TRUE(avi::integrate(method, z, 0.05, {.steps = 20}).ok());
    return z.q;
  };
  EXPECT_LT((end(power) - end(exponential)).norm(), 1e-14);
}

TEST(Htvi, KnowsItsOrder) {
  const auto problem = avi::poincare<2>(kepler, Kepler::pericentre(0.5));
  EXPECT_EQ(avi::htvi<8>(problem).order(), 8);
  EXPECT_EQ((avi::type2<3>(problem).order()), 8);
  EXPECT_EQ((avi::type2<1>(problem, avi::gauss(8)).order()), 4) << "2r + 2 at most";
  EXPECT_EQ((avi::type2<3>(problem, avi::boole()).order()), 6) << "as the rule's between r + 1 and 2r + 2";
  EXPECT_EQ((avi::type2<3>(problem, avi::simpson()).order()), 4);
  EXPECT_EQ((avi::type3<3>(problem, avi::midpoint()).order()), 4) << "r + 1 with any rule";
  EXPECT_EQ((avi::type2<3, experiment::Printed>(problem).order()), 4);
  EXPECT_EQ((avi::type2<3, experiment::Authors>(problem, avi::midpoint()).order()), 2);
}

/// Two springs with a bond, of which every unit of length and momentum makes the same problem.
const auto springs = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) + 0.25 * q[0] * q[1];
};

// Squares of numbers below 1e-154 are not normal ones.
TEST(Htvi, HasTheSameBitsInEveryUnit) {
  const auto run = [](int exponent) {
    const double unit = std::ldexp(1.0, exponent);
    State<2> z{.q = {0.7 * unit, -0.3 * unit}, .p = {0.2 * unit, 0.9 * unit}};
    auto method = avi::htvi<4>(avi::poincare(springs, z));
    EXPECT_EQ(avi::integrate(method, z, 0.1, {.steps = 50}).outcome, avi::Outcome::ok) << exponent;
    return std::vector<double>{z.q[0] / unit, z.q[1] / unit, z.p[0] / unit, z.p[1] / unit};
  };
  const auto known = run(0);
  for (const int exponent : {-900, -530, -515, -300, 500})
    EXPECT_EQ(run(exponent), known) << exponent;
}

/// Two pendulums side by side, of masses 1 and m, which know nothing of each other.
struct TwoPendulums {
  double m;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    return 0.5 * p[0] * p[0] - cos(q[0]) + (0.5 / m) * (p[1] * p[1]) - m * cos(q[1]);
  }
};

// The largest error of the second one's energy was 4.4 at m = 1e-15, with ok; and after one step of 0.77
// with the monitor |q|^2 the equations of Kepler's problem were left with a residual of 1e20.
TEST(Htvi, SolvesForLightBodiesAsForHeavyOnes) {
  const auto worst = [](double m, auto method_for, double h) {
    State<2> z{.q = {0.3, 2.0}, .p = {1.0, 0.5 * m}};
    auto method = method_for(avi::poincare(TwoPendulums{m}, z));
    double most = 0.0;
    const auto run = avi::integrate(method, z, h, {.steps = 2000}, [&](const State<2>& now, long) {
      const double v = now.p[1] / m;
      most = std::max(most, std::abs(0.5 * v * v - std::cos(now.q[1]) - 0.125 + std::cos(2.0)));
    });
    EXPECT_EQ(run.outcome, avi::Outcome::ok) << m << run.message;
    return most;
  };
  const auto second = [](const auto& problem) { return avi::htvi<2>(problem); };
  const auto sixth = [](const auto& problem) { return avi::htvi<6>(problem); };
  const double low = worst(1.0, second, 0.1), high = worst(1.0, sixth, 0.35);
  for (const double m : {1e-3, 1e-9, 1e-12, 1e-15, 1e-20, 1e6}) {
    EXPECT_NEAR(worst(m, second, 0.1) / low, 1.0, 1e-6) << m;
    EXPECT_NEAR(worst(m, sixth, 0.35) / high, 1.0, 1e-6) << m;
  }
}

TEST(Htvi, TakesTheGaussRuleOfItsOrderUnlessToldOtherwise) {
  const auto start = Kepler::pericentre(0.5);
  const auto problem = avi::poincare<2>(kepler, start, avi::NormSquared{});
  const auto expect_same = [&](auto a, auto b) {
    auto x = start, y = start;
    ASSERT_EQ(a.step(x, 0.3).outcome, avi::Outcome::ok);
    ASSERT_EQ(b.step(y, 0.3).outcome, avi::Outcome::ok);
    EXPECT_EQ(x, y);
  };
  expect_same(avi::type2<2>(problem), avi::type2<2>(problem, avi::gauss(3)));
  expect_same(avi::type3<2>(problem), avi::type3<2>(problem, avi::gauss(3)));
  expect_same(avi::htvi<6>(problem), avi::type2<2>(problem, avi::gauss(3)));
  const auto of_order = [&](int r) {
    return avi::htvi_of_order<avi::Generating::type2>(r, problem, avi::gauss(3));
  };
  expect_same(of_order(2), avi::type2<2>(problem));
  EXPECT_NO_THROW(of_order(0));
  EXPECT_NO_THROW(of_order(15));
  EXPECT_THROW(of_order(-1), std::invalid_argument);
  EXPECT_THROW(of_order(16), std::invalid_argument);
}

// r = 0: with any rule the discrete Hamiltonian is that of adaptive Euler-B, whose closed form must agree.
TEST(TypeII, WithRZeroIsClosedFormEulerB) {
  for (double h : {0.02, 0.005}) {
    auto a = Kepler::pericentre(0.9), b = a;
    const auto monitor = avi::bounded(avi::NormSquared{}, 0.01, 8.0);
    auto generic =
        avi::type2<0, experiment::Printed>(avi::poincare<2>(kepler, a, monitor), avi::rectangle_left());
    auto closed = avi::euler_b<2>(kepler, a, monitor);
    double worst = 0.0;
    for (int k = 0; k < 200; ++k) {
      ASSERT_EQ(generic.step(a, h).outcome, avi::Outcome::ok);
      ASSERT_EQ(closed.step(b, h).outcome, avi::Outcome::ok);
      worst = std::max({worst, (a.q - b.q).norm(), (a.p - b.p).norm() / a.p.norm(), std::abs(a.t - b.t)});
    }
    EXPECT_LT(worst, 2e-13) << h;
  }
}

}  // namespace htvi_order_test
