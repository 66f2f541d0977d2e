
#include "avi/collocation/collocation.hpp"
#include "avi/core/dot.hpp"
#include "avi/core/integrate.hpp"
#include "avi/diagnostics/drift.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/htvi/quadrature.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/problems/pendulum.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"
#include "avi/transform/poincare.hpp"
#include "common/problems/chain.hpp"
#include "common/problems/perturbed_kepler.hpp"

#include "tries.hpp"

#include <vector>

// Every entry point of the library against arguments that it cannot use: each is refused in one sentence;
// what is found out during a run only ends it with a name. Those of HTVI are in bad_htvi_input_test.cpp,
// those of optimisers in bad_optimiser_input_test.cpp, those of the programs in
// tests/reproduction/common/front_door_test.cpp.

namespace bad_input_test {

using namespace avi;
using experiment::Chain, experiment::PerturbedKepler;

/// g = a + b q_1, or one over it: one type for all monitors here, so that collocation is compiled once.
struct Monitor {
  double a = 1.0, b = 0.0;
  bool inverse = false;
  template <class Q>
  auto operator()(const Q& q) const {
    using S = std::decay_t<decltype(q[0] * q[0])>;
    const S g = a + b * q[0];
    return inverse ? S(1.0 / g) : g;
  }
};

TEST(BadInput, OfTheTimeLoop) {
  const auto start = Kepler::pericentre(0.5);
  const auto run = [&](double h, Until until) {
    auto method = stormer_verlet<2>([](const auto& q) { return Kepler::potential_gradient(q); });
    auto z = start;
    return integrate(method, z, h, until);
  };
  tries::all("h", std::vector{0.0, tries::nan, tries::inf, -tries::inf},
             [&](double h) { (void)run(h, {.time = 1.0}); });
  tries::one("h away from a time ahead", -0.1, [&] { (void)run(-0.1, {.time = 1.0}); });
  tries::one("h away from a time behind", 0.1, [&] { (void)run(0.1, {.time = -1.0}); });
  tries::one("end", tries::nan, [&] { (void)run(0.1, {.time = tries::nan}); });
  tries::one("no end", "not set", [&] { (void)run(0.1, {}); });
  tries::one("steps", -1, [&] { (void)run(0.1, {.steps = -1}); });
}

TEST(BadInput, OfMonitors) {
  tries::all("a", std::vector{-1.0, tries::nan, tries::inf}, [](double a) { bounded(Gamma{}, a, 2.0); });
  tries::all("b", std::vector{0.0, 0.5, tries::nan, tries::inf}, [](double b) { bounded(Gamma{}, 0.5, b); });
  tries::all("p^t", tries::not_finite, [](double pt) { EulerB<2, Kepler, Gamma>(Kepler{}, Gamma{}, pt); });
  tries::all("p^t", tries::not_finite, [](double pt) { LogHamiltonian<Kepler>(Kepler{}, pt); });
}

TEST(BadInput, OfQuadratureRules) {
  tries::all("Gauss nodes", std::vector{0, -5, 17}, [](int m) { (void)gauss(m); });
  tries::all("Lobatto nodes", std::vector{1, -5, 17}, [](int m) { (void)lobatto(m); });
  tries::all("Radau nodes", std::vector{0, -5, 17}, [](int m) { (void)radau(m); });
}

TEST(BadInput, OfCollocation) {
  const auto start = Kepler::pericentre(0.5);
  const auto steps = [](const Monitor& monitor, State<2> z, double h) {
    auto method = collocation(poincare(Kepler{}, Kepler::pericentre(0.5), monitor), 8);
    return integrate(method, z, h, {.steps = 100});
  };
  const auto problem = poincare(Kepler{}, start, Monitor{});
  tries::all("order", std::vector{-2, 0, 1, 3, 7, 33, 34}, [&](int order) { collocation(problem, order); });
  tries::all("tolerance", tries::not_positive, [&](double t) { collocation(problem, 8, {.tolerance = t}); });
  tries::all("sweeps", std::vector{0, -1}, [&](int n) { collocation(problem, 8, {.max_sweeps = n}); });
  tries::all("h", std::vector{0.0, tries::nan, tries::inf, -tries::inf},
             [&](double h) { (void)steps({}, start, h); });
  for (const double x : tries::not_finite) {
    auto from = start;
    from.q[0] = x;
    tries::run("q at the start", x, [&] { return steps({}, from, 0.1); });
    from = start;
    from.p[1] = x;
    tries::run("p at the start", x, [&] { return steps({}, from, 0.1); });
  }
  for (const double g : {0.0, -1.0, tries::nan, tries::inf})
    tries::run("g", g, [&] { return steps({.a = g}, start, 0.1); });
  // Good at the start; zero, and infinite, farther on.
  tries::run("g on the way", "q_1", [&] { return steps({.a = 0.0, .b = 1.0}, start, 3.0); });
  tries::run("g on the way", "1/(1 + q_1)", [&] { return steps({.b = 1.0, .inverse = true}, start, 0.1); });
  tries::one("size", 2, [&] {
    auto method = collocation(poincare(Chain{}, Chain::plucked(3)), 8);
    auto z = Chain::plucked(2);
    (void)method.step(z, 0.1);
  });
  auto uneven = Chain::plucked(3);
  uneven.p = Chain::plucked(2).p;
  tries::one("size", 2, [&] {
    auto method = collocation(poincare(Chain{}, Chain::plucked(3)), 8);
    (void)method.step(uneven, 0.1);
  });
  tries::one("size", 2, [&] { (void)poincare(Chain{}, uneven); });
}

TEST(BadInput, OfProblems) {
  tries::all("e", std::vector{-0.1, 1.0, tries::nan, tries::inf},
             [](double e) { (void)Kepler::pericentre(e); });
  tries::all("e", std::vector{-0.1, 1.0, tries::nan, tries::inf},
             [](double e) { (void)Kepler::exact(e, 1.0); });
  tries::all("t", tries::not_finite, [](double t) { (void)Kepler::exact(0.5, t); });
  tries::all("epsilon", std::vector{-1.0, tries::nan, tries::inf}, [](double e) { PerturbedKepler{e}; });
  tries::all("amplitude", std::vector{-0.1, 4.0, tries::nan}, [](double a) { (void)Pendulum::start(a); });
  tries::all("amplitude", std::vector{-0.1, 4.0, tries::nan}, [](double a) { (void)Pendulum::period(a); });
  tries::all("mass", tries::not_positive, [](double m) { NBody<2>({1.0, m}); });
  tries::one("bodies", 1, [] { NBody<dynamic>(Vector<double, dynamic>::Ones(1)); });
  tries::all("energy", std::vector{-1.0, tries::nan, tries::inf},
             [](double e) { (void)HenonHeiles::on_section(e, 0.1, 0.0); });
}

TEST(BadInput, OfDiagnostics) {
  const std::vector<double> three = {1.0, 2.0, 3.0}, two = {1.0, 2.0}, same = {1.0, 1.0, 1.0};
  tries::one("lengths", 2, [&] { (void)fit_drift(three, two); });
  tries::one("points", 2, [&] { (void)fit_drift(two, two); });
  tries::one("blocks", -1, [&] { (void)fit_drift(three, three, -1); });
  tries::one("times", 0, [&] { (void)fit_drift(same, three); });
  tries::one("lengths", 2, [&] { (void)fit_order(three, two); });
  tries::all("h", std::vector{0.0, tries::nan, tries::inf},
             [&](double h) { (void)fit_order(std::vector{h}, std::vector{1.0}); });
  tries::one("points", 1, [&] { (void)fit_order(three, three, {.at_least = 1}); });
  const auto identity = [](const VectorX& z) { return z; };
  tries::one("odd", 3, [&] { (void)symplecticity_defect(identity, VectorX(VectorX::Ones(3))); });
  tries::all("spacing", tries::not_positive, [&](double s) {
    (void)difference_jacobian(identity, VectorX(VectorX::Ones(2)), {.smallest = s});
  });
}

/// Backwards is refused only where the end lies ahead.
TEST(BadInput, ANegativeStepIsGood) {
  auto method = stormer_verlet<2>([](const auto& q) { return Kepler::potential_gradient(q); });
  auto z = Kepler::pericentre(0.5);
  EXPECT_EQ(integrate(method, z, -0.1, {.steps = 10}).steps, 10);
  EXPECT_EQ(integrate(method, z, -0.1, {.time = -1.95}).steps, 10);
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

TEST(BadInput, MonitorsThatAreNotPositive) {
  const auto start = Kepler::pericentre(0.5);
  for (double g : {0.0, -1.0, tries::nan}) {
    auto method = euler_b<2>(Kepler{}, start, [g](const auto& q) { return g * (q[0] * q[0] + 1.0); });
    auto z = start;
    const avi::Run run = integrate(method, z, 0.01, {.steps = 10});
    EXPECT_EQ(run.outcome, std::isnan(g) ? Outcome::non_finite : Outcome::bad_monitor) << g;
    EXPECT_EQ(z.q, start.q);
  }
}

/// Not a number anywhere is not a number at the end, never a small defect.
TEST(BadInput, DiagnosticsOfWhatIsNotANumber) {
  const auto broken = [](const VectorX& z) { return VectorX(VectorX::Constant(z.size(), tries::nan)); };
  EXPECT_TRUE(std::isnan(symplecticity_defect(broken, VectorX(VectorX::Ones(2)))));
  EXPECT_TRUE(std::isnan(
      fit_order(std::vector{1.0, 2.0, 3.0}, std::vector{tries::nan, tries::nan, tries::nan}).order));
}

}  // namespace bad_input_test
