#include "reproduction/data.hpp"

#include <gtest/gtest.h>

#include <string>

// Rounding over a thousand orbits: random where the method is symplectic, a drift where it is not.

namespace million_orbits_test {

double summary(const std::string& method, const char* column) {
  return data::quick.number("million_orbits_summary", {{"method", method}}, column);
}

TEST(MillionOrbits, EnergyWalksAtRandomOrDrifts) {
  // Measured over a thousand orbits: 5e-15, 1.2e-14; GSL over a hundred: 3e-12.
  EXPECT_LT(summary("collocation16", "energy_error"), 1.2e-14);
  EXPECT_LT(summary("log_hamiltonian10", "energy_error"), 3e-14);
  EXPECT_GT(summary("gsl_rk8pd", "energy_error"), 1e-12);
  EXPECT_EQ(summary("collocation16", "starts"), 16.0);
  EXPECT_EQ(summary("collocation16", "periods"), 1000.0);
}

/// The parts of the walk: a bias of some 1e-14 a period where the method is not symplectic (measured: 3e-14),
/// none that a thousand orbits would show else.
TEST(MillionOrbits, SeparatesBiasFromChance) {
  EXPECT_GT(summary("gsl_rk8pd", "bias"), 1.5e-14);
  EXPECT_LT(summary("gsl_rk8pd", "bias"), 6e-14);
  for (const char* method : {"collocation16", "log_hamiltonian10"}) {
    EXPECT_LT(summary(method, "bias"), 2e-17) << method;
    EXPECT_GT(summary(method, "random"), 5e-17) << method;
    EXPECT_LT(summary(method, "random"), 1e-15) << method;
  }
}

}  // namespace million_orbits_test
