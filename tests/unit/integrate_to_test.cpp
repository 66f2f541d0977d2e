#include "avi/core/integrate_to.hpp"

#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/problems/kepler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

using avi::Kepler, avi::State;

namespace integrate_to_test {

auto method_for(const State<2>& z) {
  return avi::splitting(avi::LogHamiltonian(Kepler{}, z), avi::compositions::kahan_li8);
}

TEST(IntegrateTo, EndsAtTheTimeForwardsAndBackwards) {
  const auto start = Kepler::pericentre(0.9);
  for (const double t_end : {0.001, 1.0, 7.3, 10.0, -0.001, -1.0, -7.3, 0.0}) {
    auto z = start;
    auto method = method_for(z);
    long shown = 0;
    double last = 0.0;
    const auto run =
        avi::integrate_to(method, z, t_end < 0.0 ? -0.2 : 0.2, t_end, [&](const State<2>& s, long k) {
          EXPECT_EQ(k, ++shown);
          EXPECT_LE(std::abs(s.t), std::abs(t_end) * (1.0 + 1e-15))
              << "the step that is repeated is not shown";
          last = s.t;
        });
    EXPECT_EQ(run.outcome, avi::Outcome::ok) << run.message;
    EXPECT_EQ(run.steps, shown);
    EXPECT_NEAR(z.t, t_end, 5e-16 * std::abs(t_end));
    EXPECT_EQ(last, z.t) << "the landed state is the last one shown";
    EXPECT_LT((z.q - Kepler::exact(0.9, t_end).q).norm(), 2e-9) << t_end;  // measured 9e-10
  }
}

/// A clock of so many ticks in each step.
struct Clock {
  double off = 0.0;
  avi::StepReport step(State<1>& z, double h) const {
    z.t += h;
    z.t = std::nextafter(z.t, z.t + off);
    return {};
  }
};

TEST(IntegrateTo, TakesNoStepOfTheSizeOfRounding) {
  for (const double sense : {1.0, -1.0})
    for (const double off : {-1.0, 0.0, 1.0}) {
      State<1> z{.q = {1.0}, .p = {0.0}, .t = 2.0 * sense};
      Clock method{sense * off};
      std::vector<double> times;
      const auto run = avi::integrate_to(method, z, 0.25 * sense, 2.25 * sense,
                                         [&](const State<1>& s, long) { times.push_back(s.t); });
      EXPECT_TRUE(run.ok()) << run.message;
      EXPECT_EQ(run.steps, 1) << "one tick before the end is the end";
      EXPECT_EQ(z.t, 2.25 * sense) << "to the bit";
      EXPECT_EQ(times, std::vector<double>{2.25 * sense});
    }
}

TEST(IntegrateTo, LooksAtItsStartWhereThatIsTheEnd) {
  State<1> z{.q = {std::nan("")}, .p = {0.0}, .t = 2.0};
  Clock method;
  EXPECT_EQ(avi::integrate_to(method, z, 0.25, 2.0).outcome, avi::Outcome::non_finite);
  z.q[0] = 1.0;
  const auto run = avi::integrate_to(method, z, 0.25, 2.0);
  EXPECT_TRUE(run.ok()) << run.message;
  EXPECT_EQ(run.steps, 0);
}

TEST(IntegrateTo, RefusesATimeThatLiesTheOtherWay) {
  auto z = Kepler::pericentre(0.9);
  auto method = method_for(z);
  EXPECT_THROW((void)avi::integrate_to(method, z, 0.05, -1.0), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate_to(method, z, -0.05, 1.0), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate_to(method, z, 0.05, INFINITY), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate_to(method, z, 0.05, NAN), std::invalid_argument);
  EXPECT_THROW((void)avi::integrate_to(method, z, 0.0, 1.0), std::invalid_argument);
}

TEST(IntegrateTo, StopsWhenItsObserverSaysSo) {
  const auto start = Kepler::pericentre(0.5);
  auto method = method_for(start);
  auto z = start;
  long shown = 0;
  const auto early = avi::integrate_to(method, z, 0.05, 3.0, [&](const State<2>&, long k) {
    shown = k;
    return k < 4;
  });
  EXPECT_EQ(early.outcome, avi::Outcome::stopped);
  EXPECT_EQ(early.steps, 4);
  EXPECT_EQ(shown, 4);
  EXPECT_LT(z.t, 3.0);
  z = start;
  const auto last =
      avi::integrate_to(method, z, 0.05, 3.0, [](const State<2>& now, long) { return now.t < 3.0 - 1e-9; });
  EXPECT_EQ(last.outcome, avi::Outcome::stopped) << "at the end itself";
  EXPECT_NEAR(z.t, 3.0, 2e-15);
}

TEST(IntegrateTo, CountsTheStepsThatItTried) {
  auto z = Kepler::pericentre(0.5);
  auto method = method_for(z);
  const auto run = avi::integrate_to(method, z, 0.3, 1.0);
  EXPECT_GE(run.evaluations, 17 * (run.steps + 3));
  EXPECT_LE(run.evaluations, 17 * (run.steps + 12));
}

}  // namespace integrate_to_test
