#include "avi/core/integrate.hpp"
#include "avi/diagnostics/order.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/integrators/adaptive_verlet.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/composition.hpp"
#include "avi/integrators/hairer_soderlind.hpp"
#include "avi/integrators/splitting.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

namespace c = avi::compositions;
using avi::Kepler;
using avi::PowerOfRadius;
using avi::State;

namespace {

/// Order of the position error after one orbit of eccentricity 0.5, at the method's own time.
template <class M>
double order_on_kepler(const M& method, double coarsest) {
  std::vector<double> h, error;
  for (int k = 0; k < 5; ++k) {
    M fresh = method;
    auto z = Kepler::pericentre(0.5);
    h.push_back(std::ldexp(coarsest, -k));
    const auto run = avi::integrate(fresh, z, h.back(), {.time = 6.0});
    error.push_back(run.outcome == avi::Outcome::ok ? (z.q - Kepler::exact(0.5, z.t).q).norm()
                                                    : std::nan(""));
  }
  return avi::fit_order(h, error, {.floor = 5e-13}).order;
}

template <class M>
double reversal_defect(const M& method, double h) {
  // rho survives the turn: the method itself, run backwards by -h, returns.
  M there = method;
  const auto start = Kepler::pericentre(0.7);
  auto z = start;
  EXPECT_EQ(avi::integrate(there, z, h, {.steps = 200}).outcome, avi::Outcome::ok);
  EXPECT_EQ(avi::integrate(there, z, -h, {.steps = 200}).outcome, avi::Outcome::ok);
  return (z.q - start.q).norm() + std::abs(z.t);
}

const avi::AdaptiveVerlet adaptive_verlet(Kepler{}, PowerOfRadius{1.5});
const avi::HairerSoderlind controlled(avi::splitting(avi::Separable<Kepler>{}, c::strang),
                                      PowerOfRadius{1.5});
const avi::HairerSoderlind controlled6(avi::splitting(avi::Separable<Kepler>{}, c::kahan_li6),
                                       PowerOfRadius{1.5});

TEST(AdaptiveVerlet, HasOrderTwoAndTheOrderOfItsCompositions) {
  EXPECT_NEAR(order_on_kepler(adaptive_verlet, 0.05), 2.0, 0.1);
  EXPECT_NEAR(order_on_kepler(avi::Composition(adaptive_verlet, c::suzuki4), 0.1), 4.0, 0.25);
}

TEST(HairerSoderlind, HasTheOrderOfItsBase) {
  EXPECT_NEAR(order_on_kepler(controlled, 0.05), 2.0, 0.1);
  EXPECT_NEAR(order_on_kepler(controlled6, 0.2), 6.0, 0.5);
}

TEST(ReversibleControl, ReturnsToTheStart) {
  EXPECT_LT(reversal_defect(adaptive_verlet, 0.05), 1e-11);
  EXPECT_LT(reversal_defect(controlled, 0.05), 1e-11);
  EXPECT_LT(reversal_defect(controlled6, 0.1), 1e-11);
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

TEST(ReversibleControl, IsNotSymplectic) {
  // As the documentation says; this test checks the size of the defect.
  const double defect = avi::symplecticity_defect(adaptive_verlet, Kepler::pericentre(0.5), 0.1);
  EXPECT_GT(defect, 1e-4);
}

TEST(ReversibleControl, SaysSoWhenTheStepIsTooLarge) {
  auto z = Kepler::pericentre(0.9);
  auto method = adaptive_verlet;
  const auto run = avi::integrate(method, z, 3.0, {.time = 100.0, .steps = 1000});
  EXPECT_EQ(run.outcome, avi::Outcome::diverged);
}

}  // namespace
