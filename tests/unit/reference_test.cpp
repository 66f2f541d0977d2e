#include "common/reference.hpp"

#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/problems/kepler.hpp"
#include "common/problems/perturbed_kepler.hpp"

#include <gtest/gtest.h>

using namespace experiment::work_precision;
using avi::Kepler;

namespace reference_test {

TEST(SinVersin, MatchesTheLibraryInLongDouble) {
  for (double x : {-3.9, -1.0, 0.0, 1e-6, 0.5, 3.0}) {
    Quad s = 0, v = 0;
    sin_versin(x, s, v);
    EXPECT_NEAR(static_cast<double>(static_cast<long double>(s) - std::sin(static_cast<long double>(x))), 0.0,
                2e-19);
    EXPECT_NEAR(static_cast<double>(1 - static_cast<long double>(v) - std::cos(static_cast<long double>(x))),
                0.0, 2e-19);
  }
}

TEST(ExactKepler, AgreesWithTheOrbitOfTheUnroundedStartWhereThatIsHarmless) {
  for (double t : {0.0, 0.3, 3.0, 10.0}) {
    EXPECT_LT((exact_kepler(Kepler::pericentre(0.9), t) - Kepler::exact(0.9, t).q).norm(), 1e-13) << t;
    EXPECT_LT((exact_kepler(Kepler::exact(0.5, 1.3), t) - Kepler::exact(0.5, 1.3 + t).q).norm(), 1e-14) << t;
  }
}

TEST(ExactKepler, KnowsWhatRoundingTheStartDoesOverAThousandPeriods) {
  // The position moves by this much when the start is rounded: no method could be measured below it
  // otherwise.
  const double t = 2000.0 * M_PI;
  EXPECT_GT((exact_kepler(Kepler::pericentre(0.9), t) - Kepler::exact(0.9, t).q).norm(), 3e-12);
}

TEST(ExtendedRun, AgreesWithKeplersEquationOverThousandPeriods) {
  const auto start = Kepler::pericentre(0.9);
  const double horizon = 2000.0 * M_PI;
  ExtendedRun<Kepler> run({}, start, true, 0.15L);
  run.run_to(horizon);
  for (double t : {horizon, horizon + 0.05, horizon + 2.0})
    EXPECT_LT((run.position(t) - exact_kepler(start, t)).norm(), 6e-14) << t - horizon;
}

TEST(ExtendedRun, TheTwoTimesAgreeOnAPerturbedOrbit) {
  const auto start = avi::Kepler::pericentre(0.5);
  const experiment::PerturbedKepler problem(1e-2);
  ExtendedRun<experiment::PerturbedKepler> logarithmic(problem, start, true, 0.1L),
      physical(problem, start, false, 0.01L);
  logarithmic.run_to(20.0);
  physical.run_to(20.0);
  EXPECT_LT((logarithmic.position(20.0) - physical.position(20.0)).norm(), 2e-14);
}

TEST(ExtendedRun, IsTheLibrarysMethodInAnotherFormat) {
  const auto start = Kepler::pericentre(0.9);
  ExtendedRun<Kepler, double, avi::Summation::plain> run({}, start, true, 0.2);
  auto method = avi::splitting(avi::LogHamiltonian(Kepler{}, start), avi::compositions::sofroniou_spaletta10);
  avi::State<2> z = start;
  for (int k = 0; k < 20; ++k) {
    ASSERT_EQ(method.step(z, 0.2).outcome, avi::Outcome::ok);
    run.run_to(1e-9 + z.t);
    EXPECT_NEAR(run.time(), z.t, 1.1e-14) << k << ", measured 5.3e-15";
    EXPECT_LT((run.position() - z.q).norm(), 2.4e-15) << k << ", measured 1.2e-15";
  }
}

}  // namespace reference_test
