#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "common/problems/chain.hpp"

#include <gtest/gtest.h>

#include <cmath>

using avi::State, experiment::Chain;

namespace chain_test {

/// In motion, too.
State<5> plucked() {
  const auto still = Chain::plucked(5);
  State<5> z{.q = still.q, .p = still.p};
  for (int i = 0; i < 5; ++i)
    z.p[i] = 0.1 * std::cos(3.0 * i);
  return z;
}

// Formulas of more operations than the tape has slots at first: it grows.
TEST(Chain, OfManyOperationsKeepsItsEnergy) {
  auto z = plucked();
  const double energy = Chain{}(z.q, z.p);
  auto method = avi::htvi_of_order<avi::Generating::type2>(2, avi::poincare<5>(avi::Automatic<Chain>{}, z),
                                                           avi::gauss(3));
  ASSERT_EQ(avi::integrate(method, z, 0.05, {.time = 1.0}).outcome, avi::Outcome::ok);
  EXPECT_NEAR(Chain{}(z.q, z.p), energy, 6e-10) << "measured 2.8e-10";
}

TEST(Chain, HasTheEnergyOfItsSprings) {
  // One mass between two springs, stretched by 2 and by -2: 2 + 2 and 2 - 2; and three with one moved by 2.
  EXPECT_EQ(Chain{}(avi::VectorX{{2.0}}, avi::VectorX{{3.0}}), 4.5 + 4.0);
  EXPECT_EQ(Chain{}(avi::VectorX{{0.0, 2.0, 0.0}}, avi::VectorX{{1.0, 0.0, 2.0}}), 2.5 + 4.0);
  EXPECT_EQ(Chain{}(avi::VectorX{{2.0, 2.0}}, avi::VectorX{{0.0, 0.0}}), 4.0) << "the spring between rests";
}

TEST(Chain, IsPluckedInItsLowestMode) {
  constexpr int n = 7;
  const auto z = Chain::plucked(n);
  EXPECT_EQ(z.p.norm(), 0.0);
  EXPECT_NEAR(z.q[n / 2], 0.3, 1e-16);
  // A mode of equal springs: the second difference is -omega^2 q, and omega^2 is least in the lowest one.
  const double omega = 2.0 * std::sin(M_PI / 2.0 / (n + 1));
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(2.0 * z.q[i] - (i > 0 ? z.q[i - 1] : 0.0) - (i + 1 < n ? z.q[i + 1] : 0.0),
                omega * omega * z.q[i], 2e-16);
  EXPECT_EQ(Chain::plucked(1).q[0], 0.3);
  EXPECT_THROW(Chain::plucked(0), std::invalid_argument);
}

}  // namespace chain_test
