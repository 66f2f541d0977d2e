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
  tries::all("p", tries::not_positive, [&](double p) { run(BregmanHtvi{.family = {.p = p}}); });
  tries::all("C", tries::not_positive, [&](double C) { BregmanFamily::direct(2.0, C); });
  tries::all("p_ring", std::vector{0.0, -1.0, tries::nan, tries::inf, 2.1},
             [&](double p) { BregmanFamily::adaptive(2.0, p); });
  tries::one("P", tries::inf, [] { BregmanFamily::adaptive(50.0, 1e-320); });
  tries::one("P", 0.0, [] { BregmanFamily::adaptive(1e-200, 1e-200); });
  tries::all("h of NAG", tries::not_positive, [&](double h) { run(Nag{.h = h}); });
  tries::all("first k of NAG", std::vector{0.5, tries::nan, tries::inf},
             [&](double k) { run(Nag{.first = k}); });
  tries::all("rate of ADAM", tries::not_positive, [&](double rate) { run(Adam{.rate = rate}); });
  const std::vector not_a_ratio{-0.1, 1.0, tries::nan}, not_small{-1.0, tries::nan, tries::inf};
  tries::all("beta_1", not_a_ratio, [&](double b) { run(Adam{.beta_1 = b}); });
  tries::all("beta_2", not_a_ratio, [&](double b) { run(Adam{.beta_2 = b}); });
  tries::all("epsilon", not_small, [&](double e) { run(Adam{.epsilon = e}); });
  tries::all("rate of AdaGrad", tries::not_positive, [&](double rate) { run(AdaGrad{.rate = rate}); });
  tries::all("epsilon of AdaGrad", not_small, [&](double e) { run(AdaGrad{.epsilon = e}); });
  tries::all("rate of RMSprop", tries::not_positive, [&](double rate) { run(RmsProp{.rate = rate}); });
  tries::all("rho of RMSprop", not_a_ratio, [&](double r) { run(RmsProp{.rho = r}); });
  tries::all("epsilon of RMSprop", not_small, [&](double e) { run(RmsProp{.epsilon = e}); });
  tries::all("radius", tries::not_positive, [&](double r) { run(TrustRegion{.radius = r}); });
  tries::all("accept", not_a_ratio, [&](double a) { run(TrustRegion{.accept = a}); });
  tries::all("expand", std::vector{0.1, tries::nan}, [&](double e) { run(TrustRegion{.expand = e}); });
  tries::all("grow", std::vector{0.5, tries::nan, tries::inf},
             [&](double g) { run(TrustRegion{.grow = g}); });
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

// What else the loop refuses is in run_updates_test.cpp.
TEST(BadOptimiserInput, OfTheirLoop) {
  const Nag method{.h = 1e-6};
  tries::one("delta", tries::inf, [&] { (void)run_updates(f, method, x0, {.delta = tries::inf}); });
  tries::all("growth", std::vector{0.0, tries::nan},
             [&](double g) { (void)run_updates(f, method, x0, {.growth = g}); });
  tries::one("x0", tries::inf, [&] { (void)run_updates(f, method, VectorX::Constant(3, tries::inf)); });
  tries::all("dimension", std::vector{0, -1}, [](int n) { CorrelatedQuartic{n}; });
  EXPECT_NO_THROW(CorrelatedQuartic(1));
  tries::all("rho", std::vector{1.0, -1.0, tries::nan, 1.5}, [](double rho) { CorrelatedQuartic(3, rho); });
}

}  // namespace bad_optimiser_input_test
