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
using tries::all, tries::not_finite, tries::not_positive;

static const CorrelatedQuartic f(3);
static const VectorX x0 = f.start();

TEST(BadOptimiserInput, OfOptimisers) {
  const auto run = [](const auto& method) { (void)run_updates(f, method, x0, {.iterations = 1}); };
  const auto family = BregmanFamily::direct(2.0);
  all("h of htvi", not_positive, [&](double h) { run(BregmanHtvi{.family = family, .h = h}); });
  all("h of heavy ball", not_positive, [&](double h) { run(BregmanHeavyBall{.family = family, .h = h}); });
  all("h of splitting", not_positive, [&](double h) { run(BregmanSplitting{.family = family, .h = h}); });
  all("h of cloning", not_positive, [&](double h) { run(BregmanCloning{.family = family, .h = h}); });
  all("h of Runge-Kutta", not_positive,
      [&](double h) { run(BregmanRungeKutta<ClassicalRungeKutta>{.family = family, .h = h}); });
  all("t0", not_positive, [&](double t) { run(BregmanHeavyBall{.family = family, .from = {.t = t}}); });
  all("r0", not_finite, [&](double r) { run(BregmanHeavyBall{.family = family, .from = {.momentum = r}}); });
  all("p", not_positive, [&](double p) { BregmanFamily::direct(p); });
  all("p", not_positive, [&](double p) { run(BregmanHtvi{.family = {.p = p}}); });
  all("C", not_positive, [&](double C) { BregmanFamily::direct(2.0, C); });
  all("p_ring", std::vector{0.0, -1.0, tries::nan, tries::inf, 2.1},
      [&](double p) { BregmanFamily::adaptive(2.0, p); });
  tries::one("P", tries::inf, [] { BregmanFamily::adaptive(50.0, 1e-320); });
  tries::one("P", 0.0, [] { BregmanFamily::adaptive(1e-200, 1e-200); });
  all("h of NAG", not_positive, [&](double h) { run(Nag{.h = h}); });
  all("first k of NAG", std::vector{0.5, tries::nan, tries::inf}, [&](double k) { run(Nag{.first = k}); });
  all("rate of ADAM", not_positive, [&](double rate) { run(Adam{.rate = rate}); });
  const std::vector not_a_ratio{-0.1, 1.0, tries::nan}, not_small{-1.0, tries::nan, tries::inf};
  all("beta_1", not_a_ratio, [&](double b) { run(Adam{.beta_1 = b}); });
  all("beta_2", not_a_ratio, [&](double b) { run(Adam{.beta_2 = b}); });
  all("epsilon", not_small, [&](double e) { run(Adam{.epsilon = e}); });
  all("rate of AdaGrad", not_positive, [&](double rate) { run(AdaGrad{.rate = rate}); });
  all("epsilon of AdaGrad", not_small, [&](double e) { run(AdaGrad{.epsilon = e}); });
  all("rate of RMSprop", not_positive, [&](double rate) { run(RmsProp{.rate = rate}); });
  all("rho of RMSprop", not_a_ratio, [&](double r) { run(RmsProp{.rho = r}); });
  all("epsilon of RMSprop", not_small, [&](double e) { run(RmsProp{.epsilon = e}); });
  all("radius", not_positive, [&](double r) { run(TrustRegion{.radius = r}); });
  all("accept", not_a_ratio, [&](double a) { run(TrustRegion{.accept = a}); });
  all("expand", std::vector{0.1, tries::nan}, [&](double e) { run(TrustRegion{.expand = e}); });
  all("grow", std::vector{0.5, tries::nan, tries::inf}, [&](double g) { run(TrustRegion{.grow = g}); });
  all("shrink", std::vector{0.0, 1.0, tries::nan}, [&](double s) { run(TrustRegion{.shrink = s}); });
  all("trials", std::vector{0, -1}, [&](int n) { run(TrustRegion{.trials = n}); });
  using Pair = BregmanEmbedded<DormandPrince>;
  all("rtol", not_positive, [&](double r) { run(Pair{.family = family, .control = {.rtol = r}}); });
  all("atol", not_positive, [&](double a) { run(Pair{.family = family, .control = {.atol = a}}); });
  all("first step", not_positive, [&](double h) { run(Pair{.family = family, .first_step = h}); });
}

// What else the loop refuses is in run_updates_test.cpp.
TEST(BadOptimiserInput, OfTheirLoop) {
  const Nag method{.h = 1e-6};
  tries::one("delta", tries::inf, [&] { (void)run_updates(f, method, x0, {.delta = tries::inf}); });
  all("growth", std::vector{0.0, tries::nan},
      [&](double g) { (void)run_updates(f, method, x0, {.growth = g}); });
  tries::one("x0", tries::inf, [&] { (void)run_updates(f, method, VectorX::Constant(3, tries::inf)); });
  all("dimension", std::vector{0, -1}, [](int n) { CorrelatedQuartic{n}; });
  EXPECT_NO_THROW(CorrelatedQuartic(1));
  all("rho", std::vector{1.0, -1.0, tries::nan, 1.5}, [](double rho) { CorrelatedQuartic(3, rho); });
}

}  // namespace bad_optimiser_input_test
