#include "avi/bregman/bregman_htvi.hpp"
#include "avi/bregman/bregman_splitting.hpp"
#include "avi/optim/run_updates.hpp"
#include "common/problems/correlated_quartic.hpp"
#include "common/rules/bregman_cloning.hpp"
#include "common/rules/bregman_runge_kutta.hpp"
#include "common/rules/update_rules.hpp"

#include "tries.hpp"

#include <vector>

// Optimisers, their loop and objectives against arguments that they cannot use.

namespace bad_optimiser_input_test {

using namespace avi;
using namespace experiment;

static const CorrelatedQuartic f(3);
static const VectorX x0 = f.start();

TEST(BadOptimiserInput, OfOptimisers) {
  const auto run = [](const auto& method) { (void)run_updates(f, method, x0, {.iterations = 1}); };
  const auto family = BregmanFamily::direct(2.0);
  tries::all("h of htvi", tries::not_positive, [&](double h) { run(BregmanHtvi{.family = family, .h = h}); });
  tries::all("h of heavy ball", tries::not_positive,
             [&](double h) { run(BregmanHeavyBall{.family = family, .h = h}); });
  tries::all("h of splitting", tries::not_positive,
             [&](double h) { run(BregmanSplitting{.family = family, .h = h}); });
  tries::all("h of cloning", tries::not_positive,
             [&](double h) { run(BregmanCloning{.family = family, .h = h}); });
  tries::all("h of Runge-Kutta", tries::not_positive,
             [&](double h) { run(BregmanRungeKutta<ClassicalRungeKutta>{.family = family, .h = h}); });
  tries::all("t0", tries::not_positive,
             [&](double t) { run(BregmanHeavyBall{.family = family, .from = {.t = t}}); });
  tries::all("r0", tries::not_finite,
             [&](double r) { run(BregmanHeavyBall{.family = family, .from = {.momentum = r}}); });
  tries::all("p", tries::not_positive, [&](double p) { BregmanFamily::direct(p); });
  tries::all("C", tries::not_positive, [&](double C) { BregmanFamily::direct(2.0, C); });
  tries::all("p_ring", std::vector{0.0, -1.0, tries::nan, tries::inf, 2.1},
             [&](double p) { BregmanFamily::adaptive(2.0, p); });
  tries::one("P", tries::inf, [] { BregmanFamily::adaptive(50.0, 1e-320); });
  tries::one("P", 0.0, [] { BregmanFamily::adaptive(1e-200, 1e-200); });
  tries::all("h of NAG", tries::not_positive, [&](double h) { run(Nag{.h = h}); });
  tries::all("rate of ADAM", tries::not_positive, [&](double rate) { run(Adam{.rate = rate}); });
  tries::all("beta_1", std::vector{-0.1, 1.0, tries::nan}, [&](double b) { run(Adam{.beta_1 = b}); });
  tries::all("beta_2", std::vector{-0.1, 1.0, tries::nan}, [&](double b) { run(Adam{.beta_2 = b}); });
  tries::all("epsilon", std::vector{-1.0, tries::nan, tries::inf},
             [&](double e) { run(Adam{.epsilon = e}); });
  tries::all("rate of AdaGrad", tries::not_positive, [&](double rate) { run(AdaGrad{.rate = rate}); });
  tries::all("rate of RMSprop", tries::not_positive, [&](double rate) { run(RmsProp{.rate = rate}); });
  tries::all("radius", tries::not_positive, [&](double r) { run(TrustRegion{.radius = r}); });
  tries::all("shrink", std::vector{0.0, 1.0, tries::nan}, [&](double s) { run(TrustRegion{.shrink = s}); });
  tries::all("trials", std::vector{0, -1}, [&](int n) { run(TrustRegion{.trials = n}); });
  using Pair = BregmanEmbedded<DormandPrince>;
  tries::all("rtol", tries::not_positive,
             [&](double r) { run(Pair{.family = family, .control = {.rtol = r}}); });
  tries::all("atol", tries::not_positive,
             [&](double a) { run(Pair{.family = family, .control = {.atol = a}}); });
  tries::all("first step", tries::not_positive,
             [&](double h) { run(Pair{.family = family, .first_step = h}); });
}

TEST(BadOptimiserInput, OfTheirLoop) {
  const Nag method{.h = 1e-6};
  tries::all("delta", std::vector{-1.0, tries::nan, tries::inf},
             [&](double d) { (void)run_updates(f, method, x0, {.delta = d}); });
  tries::all("cap", std::vector{0L, -1L},
             [&](long n) { (void)run_updates(f, method, x0, {.iterations = n}); });
  tries::all("growth", std::vector{0.0, tries::nan},
             [&](double g) { (void)run_updates(f, method, x0, {.growth = g}); });
  tries::all("x0", std::vector{tries::nan, tries::inf},
             [&](double x) { (void)run_updates(f, method, VectorX::Constant(3, x)); });
  tries::all("sizes", std::vector{1, 2, 4, 100},
             [&](int n) { (void)run_updates(f, method, VectorX::Ones(n)); });
  tries::one("size", 0, [&] { (void)run_updates(f, method, VectorX()); });
  tries::all("f(x0)", tries::not_finite, [&](double v) {
    (void)run_updates([v](const VectorX& x, VectorX& g) { return g = x, v; }, method, x0);
  });
  tries::all("gradient at x0", std::vector{tries::nan, tries::inf}, [&](double v) {
    (void)run_updates([v](const VectorX&, VectorX& g) { return g.setConstant(v), 1.0; }, method, x0);
  });
  tries::all("dimension", std::vector{0, -1}, [](int n) { CorrelatedQuartic{n}; });
  tries::all("rho", std::vector{1.0, -1.0, tries::nan, 1.5}, [](double rho) { CorrelatedQuartic(3, rho); });
}

}  // namespace bad_optimiser_input_test
