#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/splitting.hpp"
#include "avi/solve.hpp"
#include "kept.hpp"
#include "refusal.hpp"
#include "src/features/separable.hpp"
#include "src/steps/builds.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

using avi::dynamic, avi::State, avi::Vector, avi::VectorX, avi::detail::Formulas, avi::detail::Stepper;

namespace splitting_steps_test {

using systems::at, systems::spring;

/// Two coupled oscillators, of different masses.
struct Coupled {
  static constexpr int dimension = 2;
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::sqrt;
    return 0.5 * p[0] * p[0] + 0.25 * (p[1] * p[1]) + sqrt(1.0 + q[0] * q[0]) + 0.5 * q[1] * q[1] +
           0.1 * q[0] * q[1];
  }
  [[nodiscard]] Vector<double, 2> potential_gradient(const Vector<double, 2>& q) const {
    return {q[0] / std::sqrt(1.0 + q[0] * q[0]) + 0.1 * q[1], q[1] + 0.1 * q[0]};
  }
  [[nodiscard]] Vector<double, 2> velocity(const Vector<double, 2>& p) const { return {p[0], 0.5 * p[1]}; }
};

template <class H>
avi::Recording recording(const H& h, int n) {
  avi::ExpressionGraph graph(2 * n);
  const auto q = avi::recorded_inputs(graph, 0, n), p = avi::recorded_inputs(graph, n, n);
  const avi::Recorded energy = h(q, p);
  const int node = energy.node_in(graph);
  return {std::move(graph), node};
}

std::shared_ptr<const Formulas> coupled() {
  avi::ExpressionGraph graph(4);
  const auto q = avi::recorded_inputs(graph, 0, 2), p = avi::recorded_inputs(graph, 2, 2);
  const avi::Recorded energy = Coupled{}(q, p);
  const int node = energy.node_in(graph);
  const int one = graph.constant(1.0);
  return std::make_shared<const Formulas>(Formulas::of(graph, node, one));
}

struct Orbit {
  std::vector<double> z{1.0, 0.3, -0.2, 0.7};
  double t = 0.0;
  bool operator==(const Orbit&) const = default;
};

// The template that users have, with the same coefficients, is another way to the same numbers: 1.5e-15
// apart.
TEST(SplittingSteps, AreThoseOfTheSplittingByHand) {
  auto by_hand = avi::splitting<avi::Summation::compensated>(avi::Separable<Coupled>{},
                                                             avi::splittings::blanes_moan6_nystrom);
  const auto steps = avi::detail::splitting_steps(coupled());
  Orbit run;
  State<2> z{.q = {1.0, 0.3}, .p = {-0.2, 0.7}};
  for (int k = 0; k < 300; ++k) {
    ASSERT_TRUE(by_hand.step(z, 0.4).ok());
    const avi::StepReport report = steps->step(run.z.data(), run.t, 0.4);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report.evaluations, 14);
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(run.z[static_cast<std::size_t>(i)], z.q[i], 3e-15);
    EXPECT_NEAR(run.z[static_cast<std::size_t>(2 + i)], z.p[i], 3e-15);
  }
  EXPECT_EQ(run.t, z.t);
}

TEST(SplittingSteps, HaveTheSameBitsWhateverTheyAreBuiltForAndBesideAnother) {
  const auto go = [](Stepper& steps, double h, int count) {
    Orbit run;
    for (int k = 0; k < count; ++k)
      EXPECT_TRUE(steps.step(run.z.data(), run.t, h).ok());
    return run;
  };
  const auto reference = avi::detail::splitting_steps_portable(coupled());
  const Orbit fine = go(*reference, 0.3, 40);
  const Orbit coarse = go(*avi::detail::splitting_steps_portable(coupled()), 0.375, 40);
  for (const auto& build : avi::detail::builds()) {
    if (!build.runs) continue;
    EXPECT_EQ(go(*build.splitting(coupled()), 0.3, 40), fine) << build.name;
    const auto formulas = coupled();
    const auto one = build.splitting(formulas), other = build.splitting(formulas);
    ASSERT_TRUE(one->can_go_beside());
    Orbit a, b;
    for (int k = 0; k < 40; ++k) {
      const auto [first, second] =
          one->step_beside({a.z.data(), &a.t, 0.3}, *other, {b.z.data(), &b.t, 0.375});
      EXPECT_TRUE(first.ok() && second.ok());
    }
    EXPECT_EQ(a, fine) << build.name;
    EXPECT_EQ(b, coarse) << build.name;
    const auto clone = one->clone();
    EXPECT_TRUE(one->step(a.z.data(), a.t, 0.3).ok());
    Orbit again = fine;
    EXPECT_TRUE(clone->step(again.z.data(), again.t, 0.3).ok());
    EXPECT_EQ(again, a) << build.name;
  }
}

TEST(SplittingSteps, AreKnownInsideAsAtTheirEnds) {
  const auto steps = avi::detail::splitting_steps(coupled()),
             shorter = avi::detail::splitting_steps(coupled());
  Orbit run, part;
  ASSERT_TRUE(steps->step(run.z.data(), run.t, 0.5).ok());
  ASSERT_TRUE(shorter->step(part.z.data(), part.t, 0.3 * 0.5).ok());
  Orbit inside;
  steps->polynomial(0.3, inside.z.data(), inside.t);
  EXPECT_EQ(inside, part);
  steps->polynomial(1.0, inside.z.data(), inside.t);
  EXPECT_EQ(inside, run);
}

TEST(Parts, AreReadFromTheFormula) {
  using enum avi::detail::Parts;
  const auto of = [](const auto& h) { return avi::detail::parts_of(recording(h, 2)); };
  EXPECT_EQ(of(Coupled{}), nystrom);
  EXPECT_EQ(of([](const auto& q, const auto& p) {  // a full mass matrix
              return p[0] * p[0] + 0.3 * p[0] * p[1] + p[1] * p[1] / 3.0 + q[0] * q[0] * q[1];
            }),
            nystrom);
  EXPECT_EQ(of([](const auto& q, const auto& p) {  // a time and its momentum
              return 0.5 * p[0] * p[0] + cos(q[0] - q[1]) + p[1];
            }),
            nystrom);
  EXPECT_EQ(of([](const auto& q, const auto& p) {  // a magnetic field
              return 0.5 * ((p[0] - q[1]) * (p[0] - q[1]) + p[1] * p[1]) + q[0] * q[0];
            }),
            coupled);
  EXPECT_EQ(of([](const auto& q, const auto& p) {  // on a surface
              return 0.5 * p[0] * p[0] / (1.0 + q[0] * q[0]) + 0.5 * p[1] * p[1] + q[1];
            }),
            coupled);
  EXPECT_EQ(of([](const auto& q, const auto& p) {  // of special relativity
              return sqrt(1.0 + p[0] * p[0] + p[1] * p[1]) + q[0] * q[0] + q[1] * q[1];
            }),
            separate);
  EXPECT_EQ(
      of([](const auto& q, const auto& p) { return p[0] * p[0] * p[0] * p[0] + p[1] * p[1] + q[0] * q[1]; }),
      separate);
}

TEST(SplittingSteps, CanBeAskedFor) {
  const State<1> start = at(1.0, 0.0);
  for (const double tolerance : {1e-3, 1e-6, 1e-9})
    for (const double end : {-7.0, 1.0, 10.0, 300.0}) {
      const auto orbit = kept(avi::solve(spring, start, std::vector<double>{0.3 * end, end}, tolerance,
                                         {.monitor = "splitting", .dense = true}));
      EXPECT_EQ(orbit.choice.name, "splitting");
      EXPECT_EQ(orbit.choice.order, 6);
      EXPECT_LE(std::abs(orbit.state.q[0] - std::cos(end)), 2.0 * tolerance) << orbit.report();
      ASSERT_EQ(orbit.states.size(), 2u);
      EXPECT_LE(std::abs(orbit.states[0].q[0] - std::cos(0.3 * end)), 2.0 * tolerance);
      EXPECT_LE(std::abs(orbit(0.77 * end).p[0] + std::sin(0.77 * end)), 2.0 * tolerance);
    }
  const auto crossings = avi::solve(
      spring, start, 20.0, 1e-8,
      {.monitor = "splitting", .events = {avi::when([](const auto& q, const auto&) { return q[0]; })}});
  ASSERT_EQ(crossings.events.size(), 6u);
  EXPECT_NEAR(crossings.events[5].state.t, 5.5 * M_PI, 1e-7);
}

// A driven spring, q'' = -q + cos(2 t): time is a coordinate, and moves with the drifts.
TEST(SplittingSteps, FollowAnHThatDependsOnTime) {
  const auto driven = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] - q[0] * cos(2.0 * t);
  };
  const State<1> start = at(-1.0 / 3.0, 1.0);
  const auto orbit = kept(avi::solve(driven, start, 30.0, 1e-8, {.monitor = "splitting"}));
  EXPECT_NEAR(orbit.state.q[0], std::sin(30.0) - std::cos(60.0) / 3.0, 2e-8);
}

TEST(SplittingSteps, StayWhereTheyAreUnlessAStepIsFinite) {
  const auto steps = avi::detail::splitting_steps(coupled());
  Orbit run;
  run.z[2] = 1e308;
  const Orbit before = run;
  EXPECT_EQ(steps->step(run.z.data(), run.t, 1e3).outcome, avi::Outcome::non_finite);
  EXPECT_EQ(run, before);
}

// Where steps are fixed and the tolerance is loose, it is chosen.
TEST(SplittingSteps, AreChosenForLooseTolerancesAlone) {
  const State<2> start{.q = {1.0, 0.3}, .p = {-0.2, 0.7}};
  const auto loose = avi::solve(Coupled{}, start, 5.0, 1e-3),
             tight = avi::solve(Coupled{}, start, 5.0, 1e-11);
  EXPECT_EQ(loose.choice.name, "splitting");
  EXPECT_NE(tight.choice.name, "splitting");
  EXPECT_LE((loose.state.q - tight.state.q).norm(), 2e-3);
}

TEST(SplittingSteps, AreRefusedWhereTheyHaveNoMeaning) {
  const auto sentence = [](const auto& h, const avi::SolveOptions& options) {
    return refusal([&] { (void)avi::solve(h, at(0.5, 0.3), 3.0, 1e-6, options); });
  };
  EXPECT_NE(sentence(systems::relativistic, {.monitor = "splitting"}).find("T quadratic in p"),
            std::string::npos);
  EXPECT_NE(sentence(spring, {.order = 8, .monitor = "splitting"}).find("is 8; it must be 6"),
            std::string::npos)
      << sentence(spring, {.order = 8, .monitor = "splitting"});
  EXPECT_EQ(sentence(spring, {.order = 6, .monitor = "splitting"}), "accepted");
}

/// Half the trace of a step for a spring, x radians of it: oscillations grow where it is beyond 1.
double half_trace(double x) {
  const auto& [order, a, b] = avi::splittings::blanes_moan6_nystrom;
  double q[] = {1.0, 0.0}, p[] = {0.0, 1.0};
  for (int k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < a.size(); ++i) {
      q[k] += static_cast<double>(a[i]) * x * p[k];
      if (i < b.size()) p[k] -= static_cast<double>(b[i]) * x * q[k];
    }
  return 0.5 * (q[0] + p[1]);
}

// The step that solve() takes at most is 5.5 over the fastest frequency.
TEST(SplittingSteps, KeepSmallOscillationsSmallUpToSixRadians) {
  double most = 0.0;
  for (double x = 1e-3; x < 5.5; x += 1e-4)
    most = std::fmax(most, std::abs(half_trace(x)) - 1.0);
  EXPECT_LT(most, 4e-7);  // 1.8e-7, within 1e-3 of pi: a growth by 6e-4 a step
  EXPECT_GT(most, 1e-8);
  EXPECT_GT(std::abs(half_trace(6.2)), 1.0 + 1e-4);
}

// What moves slowly in a chain is resolved by steps that its fastest part bounds.
TEST(SplittingSteps, AreAsLongAsAChainIsStable) {
  const auto chain = [](const auto& q, const auto& p) {
    auto energy = 0.5 * (q[0] * q[0] + q[15] * q[15]) + 0.5 * p[0] * p[0];
    for (int i = 1; i < 16; ++i)
      energy += 0.5 * p[i] * p[i] + 0.5 * (q[i] - q[i - 1]) * (q[i] - q[i - 1]);
    return energy;
  };
  State<dynamic> start{.q = VectorX::Zero(16), .p = VectorX::Zero(16)};
  const double slow = 2.0 * std::sin(0.5 * M_PI / 17.0);
  for (int i = 0; i < 16; ++i)
    start.q[i] = std::sin(M_PI * (i + 1) / 17.0);
  const auto orbit = kept(avi::solve(chain, start, 2000.0, 1e-3, {.monitor = "splitting"}));
  EXPECT_NEAR(orbit.state.q[8], start.q[8] * std::cos(slow * 2000.0), 1e-3);
  EXPECT_GT(1.99 * orbit.choice.h, 3.5) << orbit.report();  // radians of the fastest part
  EXPECT_LT(1.99 * orbit.choice.h, 5.5) << orbit.report();
}

}  // namespace splitting_steps_test
