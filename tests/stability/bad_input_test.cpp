#include "avi/adaptive/euler_b.hpp"
#include "avi/adaptive/monitors.hpp"
#include "avi/bregman/cloning.hpp"
#include "avi/bregman/heavy_ball.hpp"
#include "avi/bregman/runge_kutta.hpp"
#include "avi/bregman/scaling.hpp"
#include "avi/bregman/splitting.hpp"
#include "avi/core/integrate.hpp"
#include "avi/diagnostics/drift.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/optim/adagrad.hpp"
#include "avi/optim/adam.hpp"
#include "avi/optim/minimise.hpp"
#include "avi/optim/nag.hpp"
#include "avi/optim/rmsprop.hpp"
#include "avi/optim/trust_region.hpp"
#include "avi/problems/correlated_quartic.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/problems/pendulum.hpp"
#include "avi/problems/perturbed_kepler.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

// Every public entry point against arguments that it cannot use. Each refusal is one sentence with the value
// and the range. Those of HTVI are in bad_htvi_input_test.cpp, those of the programs in front_door_test.cpp.

namespace {

using namespace avi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_positive[] = {0.0, -0.0, -1.0, nan, inf, -inf};
constexpr double not_finite[] = {nan, inf, -inf};

/// Counts what was tried, so that the number can be asserted.
int tried = 0;

template <class Value>
void refuses(const std::string& what, const Value& value, const std::function<void()>& call) {
  ++tried;
  std::ostringstream written;
  written.precision(17);
  written << value;
  try {
    call();
    ADD_FAILURE() << what << " = " << written.str() << " was taken";
  } catch (const std::invalid_argument& error) {
    const std::string sentence = error.what();
    EXPECT_NE(sentence.find(" is " + written.str() + "; it must be "), std::string::npos)
        << what << ": " << sentence;
    EXPECT_TRUE(sentence.ends_with(".")) << sentence;
  }
}

void refuses_all(const std::string& what, const auto& values, const auto& call) {
  for (const auto& value : values)
    refuses(what, value, [&] { call(value); });
}

const CorrelatedQuartic f(3);
const VectorX x0 = f.start();

TEST(BadInput, MethodsOfOptimisation) {
  const auto run = [](const auto& method) { (void)minimise(f, method, x0, {.iterations = 1}); };
  const auto family = BregmanFamily::direct(2.0);
  refuses_all("h of htvi", not_positive, [&](double h) { run(BregmanHtvi{.family = family, .h = h}); });
  refuses_all("h of heavy ball", not_positive,
              [&](double h) { run(BregmanHeavyBall{.family = family, .h = h}); });
  refuses_all("h of splitting", not_positive,
              [&](double h) { run(BregmanSplitting{.family = family, .h = h}); });
  refuses_all("h of cloning", not_positive, [&](double h) { run(BregmanCloning{.family = family, .h = h}); });
  refuses_all("h of Runge-Kutta", not_positive,
              [&](double h) { run(BregmanRungeKutta<ClassicalRungeKutta>{.family = family, .h = h}); });
  refuses_all("t0", not_positive,
              [&](double t) { run(BregmanHeavyBall{.family = family, .from = {.t = t}}); });
  refuses_all("r0", not_finite,
              [&](double r) { run(BregmanHeavyBall{.family = family, .from = {.momentum = r}}); });
  refuses_all("p", not_positive, [&](double p) { BregmanFamily::direct(p); });
  refuses_all("C", not_positive, [&](double C) { BregmanFamily::direct(2.0, C); });
  refuses_all("p_ring", std::vector{0.0, -1.0, nan, inf, 2.1},
              [&](double p) { BregmanFamily::adaptive(2.0, p); });
  refuses("P", inf, [] { BregmanFamily::adaptive(50.0, 1e-320); });
  refuses("P", 0.0, [] { BregmanFamily::adaptive(1e-200, 1e-200); });
  refuses_all("h of NAG", not_positive, [&](double h) { run(Nag{.h = h}); });
  refuses_all("rate of ADAM", not_positive, [&](double rate) { run(Adam{.rate = rate}); });
  refuses_all("beta_1", std::vector{-0.1, 1.0, nan}, [&](double b) { run(Adam{.beta_1 = b}); });
  refuses_all("beta_2", std::vector{-0.1, 1.0, nan}, [&](double b) { run(Adam{.beta_2 = b}); });
  refuses_all("epsilon", std::vector{-1.0, nan, inf}, [&](double e) { run(Adam{.epsilon = e}); });
  refuses_all("rate of AdaGrad", not_positive, [&](double rate) { run(AdaGrad{.rate = rate}); });
  refuses_all("rate of RMSprop", not_positive, [&](double rate) { run(RmsProp{.rate = rate}); });
  refuses_all("radius", not_positive, [&](double r) { run(TrustRegion{.radius = r}); });
  refuses_all("shrink", std::vector{0.0, 1.0, nan}, [&](double s) { run(TrustRegion{.shrink = s}); });
  refuses_all("trials", std::vector{0, -1}, [&](int n) { run(TrustRegion{.trials = n}); });
  using Pair = BregmanEmbedded<DormandPrince>;
  refuses_all("rtol", not_positive, [&](double r) { run(Pair{.family = family, .control = {.rtol = r}}); });
  refuses_all("atol", not_positive, [&](double a) { run(Pair{.family = family, .control = {.atol = a}}); });
  refuses_all("first step", not_positive, [&](double h) { run(Pair{.family = family, .first_step = h}); });
  EXPECT_GE(tried, 110);
}

TEST(BadInput, TheOptimisationLoop) {
  const Nag method{.h = 1e-6};
  refuses_all("delta", std::vector{-1.0, nan, inf},
              [&](double d) { (void)minimise(f, method, x0, {.delta = d}); });
  refuses_all("cap", std::vector{0L, -1L}, [&](long n) { (void)minimise(f, method, x0, {.iterations = n}); });
  refuses_all("growth", std::vector{0.0, nan},
              [&](double g) { (void)minimise(f, method, x0, {.growth = g}); });
  refuses_all("x0", std::vector{nan, inf},
              [&](double x) { (void)minimise(f, method, VectorX::Constant(3, x)); });
  refuses_all("sizes", std::vector{1, 2, 4, 100},
              [&](int n) { (void)minimise(f, method, VectorX::Ones(n)); });
  refuses("size", 0, [&] { (void)minimise(f, method, VectorX()); });
  refuses_all("f(x0)", not_finite, [&](double v) {
    (void)minimise([v](const VectorX& x, VectorX& g) { return g = x, v; }, method, x0);
  });
  refuses_all("gradient at x0", std::vector{nan, inf}, [&](double v) {
    (void)minimise([v](const VectorX&, VectorX& g) { return g.setConstant(v), 1.0; }, method, x0);
  });
  refuses_all("dimension", std::vector{0, -1}, [](int n) { CorrelatedQuartic{n}; });
  refuses_all("rho", std::vector{1.0, -1.0, nan, 1.5}, [](double rho) { CorrelatedQuartic(3, rho); });
}

TEST(BadInput, TheTimeLoop) {
  const auto start = Kepler::pericentre(0.5);
  const auto run = [&](double h, Until until) {
    auto method = stormer_verlet<2>([](const auto& q) { return Kepler::potential_gradient(q); });
    auto z = start;
    return integrate(method, z, h, until);
  };
  refuses_all("h", std::vector{0.0, nan, inf, -inf}, [&](double h) { (void)run(h, {.time = 1.0}); });
  refuses("h towards a time", -0.1, [&] { (void)run(-0.1, {.time = 1.0}); });
  refuses("h towards a time behind", -0.1, [&] { (void)run(-0.1, {.time = -1.0}); });
  EXPECT_EQ(run(-0.1, {.steps = 10}).steps, 10);
  refuses("end", nan, [&] { (void)run(0.1, {.time = nan}); });
  refuses("no end", "not set", [&] { (void)run(0.1, {}); });
  refuses("steps", -1, [&] { (void)run(0.1, {.steps = -1}); });
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
  // Below the rounding of t; and above it at first, where t = 0, but never to arrive.
  EXPECT_EQ(run(1.0, 1e-20), std::pair(Outcome::stalled, 1L << 20));
  EXPECT_EQ(run(0.0, 1e-300), std::pair(Outcome::stalled, 1L << 20));
  EXPECT_EQ(run(0.0, 1.5e-16), std::pair(Outcome::stalled, 1L << 20));
  // 2e15 steps: nobody will wait for them, but they are that many.
  EXPECT_EQ(run(0.0, 1e-15), std::pair(Outcome::step_limit, 3L << 20));
}

TEST(BadInput, MonitorsThatAreNotPositive) {
  const auto start = Kepler::pericentre(0.5);
  for (double g : {0.0, -1.0, nan}) {
    auto method = euler_b<2>(Kepler{}, start, [g](const auto& q) { return g * (q[0] * q[0] + 1.0); });
    auto z = start;
    const avi::Run run = integrate(method, z, 0.01, {.steps = 10});
    EXPECT_EQ(run.outcome, Outcome::bad_monitor) << g;
    EXPECT_EQ(z.q, start.q);
    ++tried;
  }
  refuses_all("a", std::vector{-1.0, nan, inf}, [](double a) { bounded(Gamma{}, a, 2.0); });
  refuses_all("b", std::vector{0.0, 0.5, nan, inf}, [](double b) { bounded(Gamma{}, 0.5, b); });
  refuses_all("p^t", not_finite, [](double pt) { EulerB<2, Kepler, Gamma>(Kepler{}, Gamma{}, pt); });
  refuses_all("p^t", not_finite, [](double pt) { LogHamiltonian<Kepler>(Kepler{}, pt); });
}

TEST(BadInput, Problems) {
  refuses_all("e", std::vector{-0.1, 1.0, nan, inf}, [](double e) { (void)Kepler::pericentre(e); });
  refuses_all("e", std::vector{-0.1, 1.0, nan, inf}, [](double e) { (void)Kepler::exact(e, 1.0); });
  refuses_all("t", not_finite, [](double t) { (void)Kepler::exact(0.5, t); });
  refuses_all("epsilon", std::vector{-1.0, nan, inf}, [](double e) { PerturbedKepler{e}; });
  refuses_all("amplitude", std::vector{-0.1, 4.0, nan}, [](double a) { (void)Pendulum::start(a); });
  refuses_all("amplitude", std::vector{-0.1, 4.0, nan}, [](double a) { (void)Pendulum::period(a); });
  refuses_all("mass", not_positive, [](double m) { NBody<2>({1.0, m}); });
  refuses("bodies", 1, [] { NBody<dynamic>(Vector<double, dynamic>::Ones(1)); });
  refuses_all("energy", std::vector{-1.0, nan, inf},
              [](double e) { (void)HenonHeiles::on_section(e, 0.1, 0.0); });
}

TEST(BadInput, Diagnostics) {
  const std::vector<double> three = {1.0, 2.0, 3.0}, two = {1.0, 2.0}, same = {1.0, 1.0, 1.0};
  refuses("lengths", 2, [&] { (void)fit_drift(three, two); });
  refuses("points", 2, [&] { (void)fit_drift(two, two); });
  refuses("blocks", -1, [&] { (void)fit_drift(three, three, -1); });
  refuses("times", 0, [&] { (void)fit_drift(same, three); });
  refuses("lengths", 2, [&] { (void)fit_order(three, two); });
  refuses_all("h", std::vector{0.0, nan, inf},
              [&](double h) { (void)fit_order(std::vector{h}, std::vector{1.0}); });
  refuses("points", 1, [&] { (void)fit_order(three, three, {.at_least = 1}); });
  const auto identity = [](const VectorX& z) { return z; };
  refuses("odd", 3, [&] { (void)symplecticity_defect(identity, VectorX(VectorX::Ones(3))); });
  refuses_all("spacing", not_positive, [&](double s) {
    (void)difference_jacobian(identity, VectorX(VectorX::Ones(2)), {.smallest = s});
  });
  // Not a number anywhere is not a number at the end, never a small defect.
  const auto broken = [](const VectorX& z) { return VectorX(VectorX::Constant(z.size(), nan)); };
  EXPECT_TRUE(std::isnan(symplecticity_defect(broken, VectorX(VectorX::Ones(2)))));
  EXPECT_TRUE(std::isnan(fit_order(three, std::vector{nan, nan, nan}).order));
}

}  // namespace
