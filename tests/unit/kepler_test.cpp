#include "avi/core/integrate.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

using avi::Kepler;
using avi::State;

namespace {

TEST(Kepler, ExactOrbitSolvesTheEquations) {
  for (double e : {0.0, 0.5, 0.9, 0.99}) {
    const Kepler kepler;
    const auto start = Kepler::pericentre(e);
    EXPECT_NEAR((Kepler::exact(e, 0.0).q - start.q).norm(), 0.0, 1e-15);
    for (double t : {0.1, 1.0, 3.0, 5.0, 6.2, 100.0}) {
      const auto z = Kepler::exact(e, t);
      EXPECT_NEAR(kepler(z.q, z.p), -0.5, 1e-14 / (1.0 - e));
      EXPECT_NEAR(Kepler::angular_momentum(z), std::sqrt(1.0 - e * e), 1e-14);
      const double d = 1e-5;
      const auto after = Kepler::exact(e, t + d), before = Kepler::exact(e, t - d);
      EXPECT_NEAR(((after.q - before.q) / (2.0 * d) - z.p).norm(), 0.0, 1e-7 / (1.0 - e));
    }
  }
}

TEST(Kepler, RefusesWhatIsNoEllipse) {
  EXPECT_THROW(Kepler::pericentre(1.0), std::invalid_argument);
  EXPECT_THROW(Kepler::pericentre(std::nan("")), std::invalid_argument);
  try {
    Kepler::pericentre(1.5);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "Eccentricity is 1.5; it must be in [0, 1).");
  }
}

TEST(StormerVerlet, ConvergesWithOrderTwo) {
  double error[2];
  for (int i = 0; i < 2; ++i) {
    auto z = Kepler::pericentre(0.3);
    const long steps = 1000L << i;
    auto method = avi::stormer_verlet<2>(&Kepler::potential_gradient<double>);
    const auto run = avi::integrate(method, z, 2.0 / static_cast<double>(steps), {.steps = steps});
    ASSERT_EQ(run.outcome, avi::Outcome::ok);
    error[i] = (z.q - Kepler::exact(0.3, 2.0).q).norm();
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.01);
}

TEST(Integrate, SaysWhyItEnds) {
  auto z = Kepler::pericentre(0.3);
  auto method = avi::stormer_verlet<2>(&Kepler::potential_gradient<double>);
  EXPECT_THROW(avi::integrate(method, z, 0.0, {.time = 1.0}), std::invalid_argument);
  EXPECT_THROW(avi::integrate(method, z, 0.1, {}), std::invalid_argument);
  EXPECT_EQ(avi::integrate(method, z, 0.1, {.time = 1.0, .steps = 3}).outcome, avi::Outcome::step_limit);
  const auto run =
      avi::integrate(method, z, 0.1, {.time = 9.0}, [](const State<2>&, long k) { return k < 2; });
  EXPECT_EQ(run.outcome, avi::Outcome::stopped);
  EXPECT_EQ(run.steps, 2);
}

}  // namespace
