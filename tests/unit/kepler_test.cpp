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

TEST(Kepler, RefusesWhatIsNoEllipse) {
  EXPECT_THROW(Kepler::pericentre(1.0), std::invalid_argument);
  EXPECT_THROW(Kepler::pericentre(std::nan("")), std::invalid_argument);
  EXPECT_EQ(refusal([] { Kepler::pericentre(1.5); }), "Eccentricity is 1.5; it must be in [0, 1).");
}

}  // namespace kepler_test
