#include "avi/avi.hpp"
#include "common/problems/perturbed_kepler.hpp"
#include "tries.hpp"

#include <utility>
#include <vector>

// Entry points of the library against arguments that they cannot use, where a test of their own does not try
// them: each is refused in one sentence; what is found out during a run only ends it with a name. Those of
// HTVI are in bad_htvi_input_test.cpp, those of optimisers in bad_optimiser_input_test.cpp, those of the
// programs in tests/reproduction/common/front_door_test.cpp.

namespace bad_input_test {

using namespace avi;
using experiment::PerturbedKepler, tries::all, tries::not_finite, tries::not_positive;

/// g = a + q_1, or one over it: one type for both, so that collocation is compiled once.
struct Monitor {
  double a;
  bool inverse;
  template <class Q>
  auto operator()(const Q& q) const {
    using S = std::decay_t<decltype(q[0] * q[0])>;
    const S g = a + q[0];
    return inverse ? S(1.0 / g) : g;
  }
};

TEST(BadInput, OfMonitors) {
  all("a", std::vector{-1.0, tries::nan, tries::inf}, [](double a) { bounded(Gamma{}, a, 2.0); });
  all("b", std::vector{0.0, 0.5, tries::nan, tries::inf}, [](double b) { bounded(Gamma{}, 0.5, b); });
  all("p^t", not_finite, [](double pt) { EulerB<2, Kepler, Gamma>(Kepler{}, Gamma{}, pt); });
  all("p^t", not_finite, [](double pt) { LogHamiltonian<Kepler>(Kepler{}, pt); });
}

// Good at the start; zero, and infinite, farther on.
TEST(BadInput, OfMonitorsOnTheWay) {
  const auto steps = [](const Monitor& monitor, double h) {
    auto z = Kepler::pericentre(0.5);
    auto method = collocation(poincare(Kepler{}, z, monitor), 8);
    return integrate(method, z, h, {.steps = 100});
  };
  tries::run("g", "q_1", [&] { return steps({.a = 0.0, .inverse = false}, 3.0); });
  tries::run("g", "1/(1 + q_1)", [&] { return steps({.a = 1.0, .inverse = true}, 0.1); });
}

TEST(BadInput, OfProblems) {
  all("t", not_finite, [](double t) { (void)Kepler::exact(0.5, t); });
  all("epsilon", std::vector{-1.0, tries::nan, tries::inf}, [](double e) { PerturbedKepler{e}; });
  all("amplitude", std::vector{-0.1, 4.0, tries::nan}, [](double a) { (void)Pendulum::start(a); });
  all("amplitude", std::vector{-0.1, 4.0, tries::nan}, [](double a) { (void)Pendulum::period(a); });
  all("mass", not_positive, [](double m) { NBody<2>({1.0, m}); });
  tries::one("bodies", 1, [] { NBody<dynamic>(Vector<double, dynamic>::Ones(1)); });
  all("energy", std::vector{-1.0, tries::nan, tries::inf},
      [](double e) { (void)HenonHeiles::on_section(e, 0.1, 0.0); });
}

TEST(BadInput, AStepTooSmallForTheClockEndsTheRun) {
  auto method = stormer_verlet<2>([](const auto& q) { return Kepler::potential_gradient(q); });
  const auto run = [&](double t, double h) {
    auto z = Kepler::pericentre(0.5);
    z.t = t;
    const avi::Run end = integrate(method, z, h, {.time = 2.0, .steps = 3 << 20});
    EXPECT_TRUE(z.finite());
    return std::pair(end.outcome, end.steps);
  };
  // A step below the rounding of t; and one that is above it at first, at t = 0, but would never arrive.
  EXPECT_EQ(run(1.0, 1e-20), std::pair(Outcome::stalled, 1L << 20));
  EXPECT_EQ(run(0.0, 1e-300), std::pair(Outcome::stalled, 1L << 20));
  EXPECT_EQ(run(0.0, 1.5e-16), std::pair(Outcome::stalled, 1L << 20));
  // 2e15 steps: nobody will wait for them, but they are that many.
  EXPECT_EQ(run(0.0, 1e-15), std::pair(Outcome::step_limit, 3L << 20));
}

/// Not a number anywhere is not a number at the end, never a small defect.
TEST(BadInput, DiagnosticsOfWhatIsNotANumber) {
  const auto broken = [](const VectorX& z) { return VectorX(VectorX::Constant(z.size(), tries::nan)); };
  EXPECT_TRUE(std::isnan(symplecticity_defect(broken, VectorX(VectorX::Ones(2)))));
  EXPECT_TRUE(std::isnan(
      fit_order(std::vector{1.0, 2.0, 3.0}, std::vector{tries::nan, tries::nan, tries::nan}).order));
}

void expect_to_end_as_non_finite(const char* name, auto method) {
  const State<2> at_rest{.q = {0.0, 0.0}, .p = {0.0, 0.0}}, good = Kepler::pericentre(0.5);
  for (const auto& [start, h] : {std::pair{at_rest, 0.1}, {good, tries::nan}, {good, tries::inf}}) {
    State<2> z = start;
    EXPECT_EQ(method.step(z, h).outcome, Outcome::non_finite) << name << ", h = " << h;
    EXPECT_EQ(z, start) << name << ", h = " << h;
  }
  State<2> z = good, other = good;
  z.q[1] = tries::nan;
  EXPECT_EQ(method.step(z, 0.1).outcome, Outcome::non_finite) << name;
  auto fresh = method;
  ASSERT_TRUE(method.step(other, 0.1).ok());
  z = good;
  ASSERT_TRUE(fresh.step(z, 0.1).ok());
  EXPECT_EQ(z, other) << name;
}

TEST(BadInput, OfExplicitSteps) {
  const auto force = [](const Vector<double, 2>& q) { return Kepler::potential_gradient(q); };
  const auto verlet = stormer_verlet<2>(force);
  expect_to_end_as_non_finite("stormer_verlet", verlet);
  expect_to_end_as_non_finite("composition", Composition(verlet, compositions::yoshida4));
  expect_to_end_as_non_finite("splitting", splitting(Separable(Kepler()), compositions::suzuki4));
  expect_to_end_as_non_finite("in more digits",
                              splitting<Summation::compensated>(Separable(Kepler()), compositions::suzuki4));
  expect_to_end_as_non_finite("euler_b", EulerB<2, Kepler>(Kepler(), Unit(), 0.0));
  expect_to_end_as_non_finite("with a monitor",
                              EulerB<2, Kepler, Monitor>(Kepler(), {.a = 1.0, .inverse = false}, 0.5));
}

}  // namespace bad_input_test
