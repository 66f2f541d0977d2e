#include "avi/automatic/solution.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/problems/pendulum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace solution_test {

using avi::Kepler;
using avi::State;

/// Asked for from 1e-4 to 1e-11; how often the energy error came out within a factor of 3, and whether it
/// ever was more than ten times too large without a word.
struct Tally {
  int near = 0, all = 0;
  template <class H, int n>
  void run(const H& hamiltonian, const State<n>& start, double end) {
    for (int k = 4; k <= 11; ++k) {
      const double tolerance = std::pow(10.0, -k);
      const auto solution = integrate(hamiltonian, start, end, tolerance);
      EXPECT_EQ(solution.run.outcome, avi::Outcome::ok) << solution.report();
      EXPECT_NEAR(solution.state.t, end, 1e-12 * end);
      const double ratio = solution.energy_error / tolerance;
      near += ratio < 3.0 && ratio > 1.0 / 3.0;
      ++all;
      if (ratio > 10.0) {
        EXPECT_NE(solution.report().find("more than ten times"), std::string::npos);
      }
    }
  }
};

TEST(Solution, HasTheEnergyErrorAskedFor) {
  Tally tally;
  tally.run(Kepler(), Kepler::pericentre(0.6), 60.0);
  tally.run(Kepler(), Kepler::pericentre(0.9), 60.0);
  tally.run(avi::FigureEight::problem(), avi::FigureEight::start(), 25.0);
  tally.run(avi::HenonHeiles(), State<2>{.q = {0.0, 0.3}, .p = {0.45, 0.0}}, 60.0);
  EXPECT_GE(tally.near, 26) << "of " << tally.all;
}

TEST(Solution, HasTheOrderThatTakesTheLeastWork) {
  using avi::detail::order_for;
  EXPECT_EQ(order_for(1e-2), 4);
  EXPECT_EQ(order_for(3e-6), 8);
  EXPECT_EQ(order_for(3e-10), 16);
}

TEST(Solution, IsWhereTheOrbitIs) {
  const double period = 2.0 * M_PI;
  const auto solution = integrate(Kepler(), Kepler::pericentre(0.9), 10.5 * period, 1e-12);
  EXPECT_NEAR(solution.state.q[0], -1.9, 1e-10);
  EXPECT_NEAR(solution.state.q[1], 0.0, 1e-9);
}

TEST(Solution, OfNoTimeIsTheStart) {
  const auto solution = integrate(Kepler(), Kepler::pericentre(0.5), 0.0, 1e-6);
  EXPECT_EQ(solution.state.q, Kepler::pericentre(0.5).q);
  EXPECT_EQ(solution.run.steps, 0);
}

TEST(Solution, StaysAtAnEquilibrium) {
  const State<1> rest{.q = avi::Vector<double, 1>(0.0), .p = avi::Vector<double, 1>(0.0)};
  const auto solution = integrate(avi::Pendulum(), rest, 3.0, 1e-6);
  EXPECT_EQ(solution.run.outcome, avi::Outcome::ok) << solution.report();
  EXPECT_EQ(solution.state.q, rest.q);
  EXPECT_NEAR(solution.state.t, 3.0, 1e-14);
}

TEST(Solution, NamesACollision) {
  State<2> z = Kepler::pericentre(0.0);
  z.p.setZero();  // falls into the centre at t = pi / sqrt(8)
  const auto solution = integrate(Kepler(), z, 10.0, 1e-8);
  EXPECT_TRUE(solution.run.outcome != avi::Outcome::ok || !solution.kept());
  EXPECT_FALSE(solution.report().empty());
}

TEST(Solution, RefusesWhatCannotBe) {
  const auto start = Kepler::pericentre(0.5);
  EXPECT_THROW((void)integrate(Kepler(), start, -1.0, 1e-6), std::invalid_argument);
  EXPECT_THROW((void)integrate(Kepler(), start, 1.0, 0.0), std::invalid_argument);
  EXPECT_THROW((void)integrate(Kepler(), start, 1.0, 0.5), std::invalid_argument);
  auto timeless = start;
  timeless.t = std::nan("");
  EXPECT_THROW((void)integrate(Kepler(), timeless, 1.0, 1e-6), std::invalid_argument);
  auto centre = start;
  centre.q.setZero();
  EXPECT_THROW((void)integrate(Kepler(), centre, 1.0, 1e-6), std::invalid_argument);
}

}  // namespace solution_test
