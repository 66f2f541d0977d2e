#include "avi/problems/kepler.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

using avi::Kepler;

namespace kepler_test {

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

TEST(Kepler, ExactOrbitSolvesKeplersEquation) {
  for (const double e : {0.0, 0.3, 0.9, 0.999999})
    for (const double t : {-3.1, -1.0, -1e-7, 1e-12, 1e-3, 0.5, 2.0, 3.14}) {
      const auto q = Kepler::exact(e, t).q;
      const double anomaly = std::atan2(q[1] / std::sqrt((1.0 - e) * (1.0 + e)), q[0] + e);
      EXPECT_NEAR(anomaly - e * std::sin(anomaly), t, 1e-15 + 3e-16 * std::abs(t)) << e << " " << t;
    }
}

TEST(Kepler, RefusesWhatIsNoEllipse) {
  for (const double e : {1.0, -0.1, std::nan("")}) {
    EXPECT_THROW(Kepler::pericentre(e), std::invalid_argument) << e;
    EXPECT_THROW(Kepler::exact(e, 1.0), std::invalid_argument) << e;
  }
  EXPECT_THROW(Kepler::exact(0.5, HUGE_VAL), std::invalid_argument);
  EXPECT_EQ(refusal([] { Kepler::pericentre(1.5); }), "Eccentricity is 1.5; it must be in [0, 1).");
}

}  // namespace kepler_test
