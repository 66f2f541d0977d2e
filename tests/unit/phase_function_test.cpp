#include "avi/automatic/phase_function.hpp"

#include "avi/autodiff/jet.hpp"
#include "avi/autodiff/pack.hpp"

#include "refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phase_function_test {

using avi::State;
using avi::VectorX;

template <class F>
double work(const F& f, int lanes) {
  return avi::phase_function<1>(f).work(lanes);
}

TEST(PhaseFunction, SaysWhatACallCosts) {
  for (const int lanes : {1, 4, 8}) {
    const double by_lane = 4.0 * lanes;
    EXPECT_EQ(work([](const auto& q, const auto& p) { return q[0] + p[0]; }, lanes), 1.0);
    EXPECT_EQ(work([](const auto& q, const auto& p) { return (q[0] - p[0]) * q[0]; }, lanes), 2.0);
    EXPECT_EQ(work([](const auto& q, const auto& p) { return q[0] / p[0]; }, lanes), 2.0);
    EXPECT_EQ(work([](const auto& q, const auto&) { return sqrt(q[0]); }, lanes), 2.0);
    EXPECT_EQ(work([](const auto& q, const auto&) { return exp(q[0]); }, lanes), by_lane);
    EXPECT_EQ(work([](const auto& q, const auto&) { return pow(q[0], 1.25); }, lanes), 4.0) << "roots";
    EXPECT_EQ(work([](const auto& q, const auto&) { return pow(q[0], 1.3); }, lanes), by_lane);
    EXPECT_EQ(work([](const auto& q, const auto&) { return q[0]; }, lanes), 0.0);
  }
}

TEST(PhaseFunction, TakesPositionsAndMomenta) {
  const auto f = avi::phase_function<2>(
      [](const auto& q, const auto& p) { return q[0] + 10.0 * q[1] + 100.0 * p[0] - pow(p[1], 3.0); });
  EXPECT_EQ(f.size(), 2);
  EXPECT_EQ(f(VectorX{{1.0, 2.0}}, VectorX{{3.0, 4.0}}), 321.0 - 64.0);
}

// What a branch becomes is understood by every scalar.
TEST(PhaseFunction, MayChoose) {
  const auto f = [](const auto& q, const auto& p) {
    using avi::select;
    return select(q[0] <= p[0], sqrt(q[0]), min(p[0], 2.0)) + p[0];
  };
  const auto recorded = avi::phase_function<1>(f);
  for (const double q : {0.25, 1.0, 4.0}) {
    const double expected = (q <= 1.0 ? std::sqrt(q) : 1.0) + 1.0,
                 slope = q <= 1.0 ? 0.5 / std::sqrt(q) : 0.0;
    EXPECT_EQ(recorded(VectorX{{q}}, VectorX{{1.0}}), expected);
    using P = avi::Partials<avi::Pack<4>, 1>;
    const P z = recorded(avi::Vector<P, 1>(P::variable(q, 0)), avi::Vector<P, 1>(P(1.0)));
    EXPECT_EQ(z.value[3], expected);
    EXPECT_EQ(z.partial(0)[3], slope);
    using Lane = avi::Lanes<1>;
    using Jet = avi::Jet<Lane, 2>;
    avi::JetTape<Lane, 2> tape;
    const Lane series[] = {Lane(q), Lane(1.0), Lane(0.0)};
    const Jet y = recorded(avi::Vector<Jet, 1>(Jet(series, &tape)), avi::Vector<Jet, 1>(Jet(1.0)));
    tape.run(1, tape.size());
    EXPECT_EQ(y[0].value(), expected);
    EXPECT_EQ(y[1].value(), slope);
    EXPECT_TRUE(tape.branched) << "at other points it is another formula";
    avi::ExpressionGraph graph(2);
    const auto again =
        recorded(avi::recorded_inputs(graph, 0, 1), avi::recorded_inputs(graph, 1, 1)).node_in(graph);
    EXPECT_EQ(avi::PhaseFunction(graph, again)(VectorX{{q}}, VectorX{{1.0}}), expected);
  }
}

TEST(Orbit, IsRefusedWhereItHasNoFiniteStart) {
  const auto said = [](const VectorX& q, const VectorX& p, double t) {
    const auto energy = [](const auto& at, const auto& by) { return 0.5 * by[0] * by[0] - 1.0 / at[0]; };
    return refusal([&] { avi::detail::Orbit(energy, State<avi::dynamic>{.q = q, .p = p, .t = t}); });
  };
  const VectorX one = VectorX::Ones(1), zero = VectorX::Zero(1);
  EXPECT_EQ(said(one, one, 0.0), "accepted");
  const std::string not_finite = "The energy at the start is not finite; an orbit needs one that is.";
  EXPECT_EQ(said(zero, one, 0.0), not_finite);
  EXPECT_EQ(said(one, one, HUGE_VAL), not_finite);
  EXPECT_EQ(said(one, VectorX::Ones(2), 0.0), "Dimension of p at the start is 2; it must be that of q, 1.");
}

}  // namespace phase_function_test
