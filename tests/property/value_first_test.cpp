#include "avi/adaptive/monitors.hpp"
#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/htvi/value_first.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using avi::Kepler;
using avi::State;

// HTVI12 (r = 11) that leaves out what rounding would drop, on Kepler's problem with g = r^1.5.

namespace {

auto htvi12(const State<2>& start) {
  return avi::type2<11>(avi::poincare<2>(Kepler{}, start, avi::Gamma{0.75}), avi::gauss(6));
}

struct Orbit {
  State<2> end;
  double energy_error = 0.0;  ///< Largest |H - H_0| / |H_0|.
};

template <class M>
Orbit run(M& method, State<2> z, double h, double periods) {
  const double first = Kepler{}(z.q, z.p);
  Orbit result{z};
  const auto outcome =
      avi::integrate(method, result.end, h, {.time = 2.0 * M_PI * periods}, [&](const State<2>& now, long) {
        result.energy_error = std::max(result.energy_error, std::abs(Kepler{}(now.q, now.p) / first - 1.0));
      });
  EXPECT_EQ(outcome.outcome, avi::Outcome::ok) << outcome.message;
  return result;
}

TEST(ValueFirst, ShortStepsAreTaylorPolynomialsAndTheOrbitIsTheSame) {
  const auto start = Kepler::pericentre(0.9);
  auto full = htvi12(start);
  avi::ValueFirst quick(htvi12(start));
  const Orbit a = run(full, start, 0.04, 1.0), b = run(quick, start, 0.04, 1.0);
  EXPECT_EQ(quick.full_steps(), 0);
  // Measured 7e-16 and 6e-14.
  EXPECT_LT((a.end.q - b.end.q).norm(), 2e-15);
  EXPECT_LT((b.end.q - Kepler::exact(0.9, b.end.t).q).norm(), 1.3e-13);
}

TEST(ValueFirst, LongStepsAreTheHtvisOwn) {
  const auto start = Kepler::pericentre(0.9);
  auto full = htvi12(start);
  avi::ValueFirst quick(htvi12(start));
  const Orbit a = run(full, start, 0.45, 5.0), b = run(quick, start, 0.45, 5.0);
  EXPECT_EQ(quick.value_steps(), 0);
  EXPECT_LT((a.end.q - b.end.q).norm(), 2e-14) << "rounding of the sums is all that differs";
}

TEST(ValueFirst, EnergyStaysAtRoundOff) {
  // Over 100 periods; measured 1.8e-14 and 1.4e-13.
  const auto start = Kepler::pericentre(0.9);
  avi::ValueFirst quick(htvi12(start));
  EXPECT_LT(run(quick, start, 0.04, 100.0).energy_error, 4e-14);
  const auto closer = Kepler::pericentre(0.99);
  avi::ValueFirst near(htvi12(closer));
  EXPECT_LT(run(near, closer, 0.04, 100.0).energy_error, 3e-13);
}

TEST(ValueFirst, ToleranceTakesLongerStepsByThePolynomial) {
  const auto start = Kepler::pericentre(0.9);
  for (double tolerance : {1e-6, 1e-10}) {
    avi::ValueFirst exact(htvi12(start)), quick(htvi12(start), tolerance);
    const double h = tolerance == 1e-6 ? 0.3 : 0.15;
    const Orbit a = run(exact, start, h, 3.0), b = run(quick, start, h, 3.0);
    EXPECT_EQ(exact.value_steps(), 0);
    EXPECT_EQ(quick.full_steps(), 0);
    EXPECT_LT(b.energy_error, 0.1 * tolerance) << "measured 0.011 and 0.044 of it";
    EXPECT_GT(b.energy_error, a.energy_error) << "symplectic steps keep it better";
  }
}

TEST(ValueFirst, RefusesATolerance) {
  const auto start = Kepler::pericentre(0.9);
  EXPECT_THROW(avi::ValueFirst(htvi12(start), 1e-17), std::invalid_argument);
  EXPECT_THROW(avi::ValueFirst(htvi12(start), 1.0), std::invalid_argument);
  EXPECT_THROW(avi::ValueFirst(htvi12(start), std::nan("")), std::invalid_argument);
}

TEST(ValueFirst, WhatIsNotFiniteIsNotTakenForConverged) {
  const auto start = Kepler::pericentre(0.9);
  avi::ValueFirst quick(htvi12(start));
  State<2> centre{.q = {0.0, 0.0}, .p = {0.0, 1.0}};
  EXPECT_NE(quick.step(centre, 0.1).outcome, avi::Outcome::ok);
}

}  // namespace
