#include "avi/core/integrate.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/integrators/adaptive_verlet.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/composition.hpp"
#include "avi/integrators/hairer_soderlind.hpp"
#include "avi/integrators/splitting.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace c = avi::compositions;
using avi::Kepler;
using avi::PowerOfRadius;
using avi::State;

namespace reversible_control_test {

const avi::AdaptiveVerlet adaptive_verlet(Kepler{}, PowerOfRadius{1.5});
const avi::HairerSoderlind controlled(avi::splitting(avi::Separable<Kepler>{}, c::strang),
                                      PowerOfRadius{1.5});

// Its error is uneven from step size to step size, as its density alternates.
TEST(AdaptiveVerlet, HasOrderFourWhereComposed) {
  std::vector<double> h, error;
  for (int k = 0; k < 5; ++k) {
    auto z = Kepler::pericentre(0.5);
    avi::Composition method(adaptive_verlet, c::suzuki4);
    h.push_back(std::ldexp(0.1, -k));
    EXPECT_EQ(avi::integrate(method, z, h.back(), {.time = 6.0}).outcome, avi::Outcome::ok);
    error.push_back((z.q - Kepler::exact(0.5, z.t).q).norm());
  }
  EXPECT_NEAR(avi::fit_order(h, error, {.floor = 5e-13}).order, 4.0, 0.25);
}

TEST(ReversibleControl, KeepsTheEnergyWithoutDriftAndTheStepNearItsMonitor) {
  const auto check = [](auto method) {
    auto z = Kepler::pericentre(0.9);
    const double h = 0.02;
    double early = 0.0, late = 0.0, last = 0.0, least = 1e9, most = 0.0;
    EXPECT_EQ(avi::integrate(method, z, h, {.time = 200.0 * M_PI},
                             [&](const State<2>& s, long) {
                               double& worst = s.t < 20.0 * M_PI ? early : late;
                               worst = std::max(worst, std::abs(Kepler{}(s.q, s.p) + 0.5));
                               const double ratio = (s.t - last) / (h * std::pow(s.q.norm(), 1.5));
                               least = std::min(least, ratio);
                               most = std::max(most, ratio);
                               last = s.t;
                             })
                  .outcome,
              avi::Outcome::ok);
    EXPECT_LT(late, 1.2 * early);
    EXPECT_LT(early, 2e-2);
    EXPECT_GT(least, 0.8);
    EXPECT_LT(most, 1.25);
  };
  check(adaptive_verlet);
  check(controlled);
}

TEST(ReversibleControl, SaysSoWhenTheStepIsTooLarge) {
  auto z = Kepler::pericentre(0.9);
  auto method = adaptive_verlet;
  const auto run = avi::integrate(method, z, 3.0, {.time = 100.0, .steps = 1000});
  EXPECT_EQ(run.outcome, avi::Outcome::diverged);
}

}  // namespace reversible_control_test
