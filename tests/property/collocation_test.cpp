#include "avi/collocation/collocation.hpp"

#include "avi/avi.hpp"
#include "common/power_law.hpp"

#include "distance.hpp"
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

using avi::Kepler, avi::Outcome, avi::State;

namespace collocation_test {

/// Not separable, and no gradient supplied: a charge in an uneven magnetic field and a well.
const auto charge = [](const auto& q, const auto& p) {
  using std::sin;
  const auto x = p[0] + 0.5 * q[1] * (1.0 + 0.3 * q[0]), y = p[1] - 0.5 * q[0] + 0.2 * sin(q[1]);
  return 0.5 * (x * x + y * y) + 0.5 * (q[0] * q[0] + 1.5 * q[1] * q[1]) + 0.1 * q[0] * q[0] * q[1];
};
/// A monitor that depends on both.
const auto both = [](const auto& q, const auto& p) {
  using std::pow;
  return pow(1.0 + q[0] * q[0] + q[1] * q[1] + 0.5 * (p[0] * p[0] + p[1] * p[1]), -0.5);
};
const State<2> charge_start{.q = {0.9, -0.2}, .p = {0.3, 0.7}};

template <class Problem>
State<Problem::dimension> after(const Problem& problem, int order, State<Problem::dimension> z, double h,
                                long steps) {
  auto method = avi::collocation<32>(problem, order);
  const avi::Run run = avi::integrate(method, z, h, {.steps = steps});
  EXPECT_EQ(run.outcome, Outcome::ok) << run.message;
  return z;
}

TEST(Collocation, HasOrderTwiceTheStages) {
  // The error, root mean square over several orbits, so that none decides by happening to pass through zero.
  std::vector<std::pair<State<2>, State<2>>> orbits;  // start and end
  for (int k = 0; k < 8; ++k) {
    State<2> z = charge_start;
    z.q[0] -= 0.1 * k;
    orbits.emplace_back(z, after(avi::poincare(charge, z, both), 32, z, 0.125, 192));
  }
  const auto error_of = [&](int order, long steps) {
    double sum = 0.0;
    for (const auto& [z, end] : orbits) {
      const auto problem = avi::poincare(charge, z, both);
      const double error = distance(after(problem, order, z, 24.0 / static_cast<double>(steps), steps), end);
      sum += error * error;
    }
    return std::sqrt(sum / static_cast<double>(orbits.size()));
  };
  for (int s = 1; s <= 6; ++s) {
    // Where the error is small and above round-off.
    std::vector<double> lengths, errors;
    for (long steps :
         {40, 41, 42, 43, 44, 45, 46, 48, 50, 52, 56, 64, 80, 96, 112, 128, 256, 512, 1024, 2048}) {
      const double error = error_of(2 * s, steps);
      if (error < 2e-14 || (s > 2 && steps > 128)) break;
      if (error > 3e-3) continue;
      lengths.push_back(24.0 / static_cast<double>(steps)), errors.push_back(error);
    }
    EXPECT_NEAR(experiment::power_law(lengths, errors).slope, 2.0 * s, 0.15) << "stages " << s;
  }
}

TEST(Collocation, AgreesWithAnotherLibrary) {
  // GSL's Prince-Dormand pair in physical time, on the equations written by hand.
  const auto field = [](double, const double* z, double* f, void*) {
    const double x = z[2] + 0.5 * z[1] * (1.0 + 0.3 * z[0]), y = z[3] - 0.5 * z[0] + 0.2 * std::sin(z[1]);
    f[0] = x;
    f[1] = y;
    f[2] = -(x * 0.15 * z[1] - 0.5 * y + z[0] + 0.2 * z[0] * z[1]);
    f[3] = -(x * 0.5 * (1.0 + 0.3 * z[0]) + y * 0.2 * std::cos(z[1]) + 1.5 * z[1] + 0.1 * z[0] * z[0]);
    return int{GSL_SUCCESS};
  };
  gsl_odeiv2_system system{field, nullptr, 4, nullptr};
  gsl_odeiv2_driver* driver =
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-14, 1e-14);
  double t = 0.0, y[4] = {0.9, -0.2, 0.3, 0.7};
  ASSERT_EQ(gsl_odeiv2_driver_apply(driver, &t, 5.0, y), GSL_SUCCESS);
  gsl_odeiv2_driver_free(driver);
  auto method = avi::collocation(avi::poincare(charge, charge_start, both), 16);
  State<2> z = charge_start;
  ASSERT_EQ(avi::integrate_to(method, z, 0.4, 5.0).outcome, Outcome::ok);
  EXPECT_EQ(z.t, 5.0);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(z.q[i], y[i], 4e-13);
    EXPECT_NEAR(z.p[i], y[2 + i], 4e-13);
  }
}

TEST(Collocation, IsSymplecticForEveryStep) {
  for (const int order : {2, 4, 8, 12, 16, 20, 32}) {
    const auto method = avi::collocation<32>(avi::poincare(charge, charge_start, both), order);
    static_assert(decltype(method)::symplectic && decltype(method)::symmetric);
    for (const double h : {0.2, 0.7, -0.4})
      EXPECT_LT(avi::symplecticity_defect(method, charge_start, h), 1e-13) << order << " " << h;
  }
}

TEST(Collocation, CoefficientsAreSymplecticToTheLastBit) {
  for (int s = 1; s <= avi::GaussRule::most; ++s) {
    const avi::GaussRule rule(s);
    double weights = 0.0;
    for (int i = 0; i < s; ++i) {
      weights += rule.weight(i);
      double row = 0.0;
      for (int j = 0; j < s; ++j) {
        EXPECT_EQ(rule.mu(i, j) + rule.mu(j, i), 1.0);
        row += rule.weight(j) * rule.mu(i, j);
      }
      EXPECT_NEAR(row, rule.node(i), 4e-16) << s;  // integral of 1
      if (i > 0) {
        EXPECT_GT(rule.node(i), rule.node(i - 1));
      }
    }
    EXPECT_NEAR(weights, 1.0, 4e-16) << s;
    // exact for the highest power, c^(2 s - 1)
    double power = 0.0;
    for (int i = 0; i < s; ++i)
      power += rule.weight(i) * std::pow(rule.node(i), 2 * s - 1);
    EXPECT_NEAR(power, 1.0 / (2 * s), 1e-15) << s;
  }
  for (int s = 1; s <= avi::GaussRule::most; ++s)
    for (const double c : {0.0, 1e-9, 0.03, 0.25, 0.6, 0.999, 1.0, 1.3, -0.2}) {
      const avi::GaussRule rule(s);
      const auto row = rule.integrals(c), quick = rule.quick_integrals(c);
      const double outside = c > 1.0 || c < 0.0 ? 1e4 : 1.0;
      for (int j = 0; j < s; ++j)
        EXPECT_NEAR(quick[j], row[j], outside * 2e-14 * std::abs(c) + 3e-18)
            << s << " " << c;  // measured 4e-15
      if (c == 1.0 || c == 0.0) {
        EXPECT_EQ(quick[0], c);
      }
    }
  EXPECT_THROW(avi::GaussRule(0), std::invalid_argument);
  EXPECT_THROW(avi::GaussRule(17), std::invalid_argument);
}

// What rounding takes from a sum of steps goes into the next one. Without, 1e5 times 0.1 is 1.9e-8 too much.
TEST(Collocation, AddsStepsUpToTheLastBit) {
  const auto free = [](const auto&, const auto& p) { return 0.5 * (p[0] * p[0]); };
  State<1> z{.q = {0.0}, .p = {1.0}};
  auto method = avi::collocation(avi::poincare(free, z), 4);
  ASSERT_EQ(avi::integrate(method, z, 0.1, {.steps = 100'000}).outcome, Outcome::ok);
  EXPECT_NEAR(z.q[0], 1e4, 4e-12);  // two units of the last place
  EXPECT_NEAR(z.t, 1e4, 4e-12);
}

TEST(Collocation, LeadsBack) {
  const auto start = Kepler::pericentre(0.9);
  auto method = avi::collocation(avi::poincare(Kepler{}, start, avi::Gamma{0.75}), 16);
  for (const double h : {0.3, 0.9}) {
    State<2> z = start;
    for (int k = 0; k < 20; ++k) {
      const State<2> before = z;
      ASSERT_EQ(method.step(z, h).outcome, Outcome::ok);
      State<2> back = z;
      ASSERT_EQ(method.step(back, -h).outcome, Outcome::ok);
      EXPECT_LT(distance(back, before), 1e-14 * (1.0 + before.p.norm())) << h << " " << k;
      const State<2> ahead = z;
      z = before;
      ASSERT_EQ(method.step(z, h).outcome, Outcome::ok);
      EXPECT_LT(distance(ahead, z), 1e-14 * (1.0 + z.p.norm()));
    }
  }
}

TEST(Collocation, KeepsTheEnergyOverAThousandPeriods) {
  for (const auto& [e, h, bound] : {std::tuple{0.9, 0.9, 3e-14}, std::tuple{0.99, 0.8, 2.5e-13}}) {
    const auto start = Kepler::pericentre(e);
    auto method = avi::collocation(avi::poincare(Kepler{}, start, avi::Gamma{0.75}), 16);
    State<2> z = start;
    double most = 0.0;
    const avi::Run run =
        avi::integrate(method, z, h, {.time = 2000.0 * M_PI}, [&](const State<2>& now, long) {
          if (now.q.norm() > 1.0) most = std::max(most, std::abs(Kepler{}(now.q, now.p) + 0.5));
        });
    ASSERT_EQ(run.outcome, Outcome::ok) << run.message;
    EXPECT_LT(most, bound) << e;
  }
}

}  // namespace collocation_test
