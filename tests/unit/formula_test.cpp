#include "avi/autodiff/formula.hpp"

#include "avi/avi.hpp"

#include "refusal.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace formula_test {

using avi::Formula, avi::State, avi::VectorX;

TEST(Formula, IsAFunctionOfAPoint) {
  int calls = 0;
  const Formula f = Formula::of_point(
      [&](const auto& x) {
        ++calls;
        return x[0] * x[0] * x[1] + exp(x[2]);
      },
      3);
  const VectorX x{{3.0, 2.0, 0.5}};
  EXPECT_EQ(f.inputs(), 3);
  EXPECT_EQ(f.value(x), 18.0 + std::exp(0.5));
  EXPECT_EQ(f.gradient(x), (VectorX{{12.0, 9.0, std::exp(0.5)}}));
  EXPECT_EQ(f.gradient(x), Formula(f).gradient(x)) << "a copy is the same formula";
  EXPECT_EQ(&Formula(f).graph(), &f.graph());
  EXPECT_EQ(calls, 1);
}

TEST(Formula, IsAHamiltonian) {
  const Formula energy = Formula::of_phase<2>(avi::Kepler());
  const VectorX q{{0.6, 0.8}}, p{{3.0, 4.0}}, z{{0.6, 0.8, 3.0, 4.0}};
  EXPECT_EQ(energy(q, p), 12.5 - 1.0);
  const VectorX slope = energy.gradient(z);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(slope[i], q[i], 4e-16);
    EXPECT_EQ(slope[2 + i], p[i]);
  }
  using Number = avi::Partials<avi::Pack<4>, 1>;
  const avi::Vector<Number, 2> along{Number::variable(0.6, 0), Number(0.8)}, still{Number(3.0), Number(4.0)};
  EXPECT_NEAR(energy(along, still).partial(0)[3], 0.6, 4e-16);
}

TEST(Formula, MayDependOnTime) {
  const Formula driven = Formula::of_phase_and_time(
      [](const auto& q, const auto& t, const auto& p) { return p[0] * p[0] - q[1] * t + 7.0 * p[1]; }, 2);
  const VectorX q{{1.0, 2.0}}, p{{3.0, 4.0}};
  EXPECT_EQ(driven.at(q, 5.0, p), 9.0 - 10.0 + 28.0);
  EXPECT_EQ(driven.gradient(VectorX{{1.0, 2.0, 3.0, 4.0, 5.0}}), (VectorX{{0.0, -5.0, 6.0, 7.0, -2.0}}));
}

TEST(Formula, HasParametersThatChangeWithoutRecording) {
  int calls = 0;
  const Formula spring = Formula::of_phase(
      [&](const auto& q, const auto& p, const auto& c) {
        ++calls;
        return 0.5 * (p[0] * p[0] / c[0] + c[1] * q[0] * q[0]);
      },
      1, {1.0, 1.0});
  const VectorX q{{2.0}}, p{{4.0}}, z{{2.0, 4.0}};
  EXPECT_EQ(spring.inputs(), 2);
  EXPECT_EQ(spring(q, p), 10.0);
  const Formula stiff = spring.with({2.0, 9.0});
  EXPECT_EQ(stiff(q, p), 4.0 + 18.0);
  EXPECT_EQ(stiff.gradient(z), (VectorX{{18.0, 2.0}}));
  EXPECT_EQ(spring.gradient(z), (VectorX{{2.0, 4.0}})) << "the other one stays as it is";
  EXPECT_EQ(&stiff.graph(), &spring.graph());
  EXPECT_EQ(stiff.with_constants().graph().inputs(), 2);
  EXPECT_EQ(stiff.with_constants()(q, p), 22.0);
  // Its frequency is the root of 4.5.
  const auto orbit = avi::solve(stiff, systems::at(1.0, 0.0), 10.0, 1e-10);
  EXPECT_TRUE(orbit.kept()) << orbit.report();
  EXPECT_NEAR(orbit.state.q[0], std::cos(10.0 * std::sqrt(4.5)), 2e-10);
  EXPECT_EQ(calls, 1);
}

TEST(Formula, IsSolvedLikeItsCallable) {
  const avi::State<2> start = avi::Kepler::pericentre(0.5);
  const auto one = avi::solve(avi::Automatic{avi::Kepler()}, start, 20.0, 1e-9);
  const auto other = avi::solve(Formula::of_phase<2>(avi::Kepler()), start, 20.0, 1e-9);
  EXPECT_EQ(one.state.q, other.state.q);
  EXPECT_EQ(one.state.p, other.state.p);
  EXPECT_EQ(one.choice.name, other.choice.name);
}

TEST(Formula, MayChoose) {
  const auto f = [](const auto& q, const auto& p) {
    using avi::select;
    return select(q[0] <= p[0], sqrt(q[0]), min(p[0], 2.0)) + p[0];
  };
  const Formula recorded = Formula::of_phase(f, 1);
  for (const double q : {0.25, 1.0, 4.0}) {
    const double expected = (q <= 1.0 ? std::sqrt(q) : 1.0) + 1.0,
                 slope = q <= 1.0 ? 0.5 / std::sqrt(q) : 0.0;
    EXPECT_EQ(recorded(VectorX{{q}}, VectorX{{1.0}}), expected);
    EXPECT_EQ(recorded.gradient(VectorX{{q, 1.0}})[0], slope);
    using P = avi::Partials<avi::Pack<4>, 1>;
    const P z = recorded(avi::Vector<P, 1>(P::variable(q, 0)), avi::Vector<P, 1>(P(1.0)));
    EXPECT_EQ(z.value[3], expected);
    EXPECT_EQ(z.partial(0)[3], slope);
    avi::ExpressionGraph graph(2);
    const auto again =
        recorded(avi::recorded_inputs(graph, 0, 1), avi::recorded_inputs(graph, 1, 1)).node_in(graph);
    EXPECT_EQ(Formula(graph, again)(VectorX{{q}}, VectorX{{1.0}}), expected);
  }
}

TEST(Formula, GivesZeroNoSign) {
  const auto sign = Formula::of_phase<1>([](const auto& q, const auto&) { return sign_of(q[0]); });
  for (const double x : {0.0, -0.0, 2.0, -2.0})
    EXPECT_EQ(sign(avi::Vector<double, 1>(x), avi::Vector<double, 1>(1.0)), 0.5 * x) << x;
}

TEST(Formula, IsAMonitorOfPositionAndMomentum) {
  const State<2> start = avi::Kepler::pericentre(0.5);
  const Formula g =
      Formula::of_phase<2>([](const auto& q, const auto&) { return q[0] * q[0] + q[1] * q[1]; });
  const auto problem = avi::poincare(Formula::of_phase<2>(avi::Kepler()), start, g);
  EXPECT_FALSE(decltype(problem)::position_monitor);
  EXPECT_EQ(problem.rate(start.q, start.p), 0.25);
}

TEST(Formula, IsMinimised) {
  const auto valley = [](const auto& x, const auto& c) {
    const auto bend = x[1] - x[0] * x[0];
    return (x[0] - c[0]) * (x[0] - c[0]) + 10.0 * bend * bend;
  };
  const Formula f = Formula::of_point(valley, 2, {1.0});
  for (const double c : {1.0, 0.5}) {
    const auto run = avi::minimise(f.with({c}), {-1.0, 1.0});
    EXPECT_TRUE(run.ok());
    EXPECT_NEAR(run.last.x[0], c, 1e-6);
    EXPECT_NEAR(run.last.x[1], c * c, 4e-6);
  }
  EXPECT_EQ(refusal([&] { (void)avi::minimise(f, {1.0}); }),
            "Size of x0 is 1; it must be the number of arguments of f, 2.");
}

TEST(Formula, LeavesBehindWhatItDoesNotNeed) {
  avi::ExpressionGraph graph(2);
  graph.unary(avi::Operation::exp, 0);
  const int root = graph.unary(avi::Operation::sqrt, 1);
  graph.unary(avi::Operation::sin, root);
  const Formula f(graph, root);
  EXPECT_EQ(f.graph().size(), 3);
  EXPECT_EQ(f.value(VectorX{{1.0, 4.0}}), 2.0);
  EXPECT_EQ(Formula(graph, 1).value(VectorX{{1.0, 4.0}}), 4.0) << "an argument alone";
}

TEST(Formula, RefusesWhatDoesNotFit) {
  const auto square = [](const auto& x) { return x[0] * x[0]; };
  const Formula f = Formula::of_point(square, 2);
  EXPECT_EQ(refusal([&] { (void)Formula::of_point(square, 0); }),
            "Number of arguments to record is 0; it must be at least 1.");
  EXPECT_EQ(refusal([&] { (void)f.value(VectorX::Ones(3)); }),
            "Number of arguments of a formula is 3; it must be 2.");
  EXPECT_EQ(refusal([&] { (void)f.gradient(VectorX::Ones(1)); }),
            "Number of arguments of a formula is 1; it must be 2.");
  EXPECT_EQ(refusal([&] {
              (void)Formula::of_phase([](const auto& q, const auto& p) { return q[0] * p[0]; },
                                      2)(VectorX::Ones(1), VectorX::Ones(3));
            }),
            "Number of momenta of a formula is 3; it must be that of the positions, 1.");
  EXPECT_EQ(refusal([&] {
              (void)Formula::of_phase_and_time(
                  [](const auto& q, const auto& t, const auto& p) { return q[0] * t * p[0]; }, 2)
                  .at(VectorX::Ones(3), 0.0, VectorX::Ones(1));
            }),
            "Number of momenta of a formula is 1; it must be that of the positions, 3.");
  const auto energy = [](const auto& q, const auto& p) { return p[0] * p[0] + q[0]; };
  EXPECT_EQ(refusal([&] { (void)Formula::of_phase<3>(energy, 2); }),
            "Number of degrees of freedom to record is 2; it must be 3.");
  EXPECT_EQ(refusal([&] { (void)avi::record<2>(energy, 3); }),
            "Number of degrees of freedom to record is 3; it must be 2.");
  EXPECT_EQ(refusal([&] {
              (void)Formula::of_phase_and_time([](const auto&, const auto& t, const auto&) { return t * t; },
                                               0);
            }),
            "Number of degrees of freedom to record is 0; it must be at least 1.");
  EXPECT_EQ(refusal([&] { (void)f.with({1.0}); }), "Number of parameters is 1; it must be 0.");
  EXPECT_EQ(refusal([&] { Formula(f.graph(), f.graph().size()); }),
            "Node of a formula is 3; it must be a node of the graph.");
  EXPECT_EQ(refusal([&] {
              Formula(f.graph(), 0, {1.0, 2.0});
            }),
            "Number of parameters is 2; it must be less than that of the inputs, 2.");
  EXPECT_EQ(refusal([&] { (void)avi::solve(f, avi::Kepler::pericentre(0.5), 1.0, 1e-6); }),
            "Number of arguments of H is 2; it must be 4, or 5 where it depends on time.");
}

}  // namespace formula_test
