#include "avi/core/trajectory.hpp"

#include "avi/avi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using avi::Kepler, avi::State;

namespace trajectory_test {

avi::Trajectory<2> path(double h, double t_end, double e = 0.6) {
  auto z = Kepler::pericentre(e);
  auto method = avi::splitting(avi::LogHamiltonian(Kepler{}, z), avi::compositions::sofroniou_spaletta10);
  avi::Trajectory<2> kept;
  const auto run = avi::integrate_to(method, z, h, t_end, kept);
  EXPECT_EQ(run.outcome, avi::Outcome::ok);
  EXPECT_EQ(kept.states().size(), static_cast<std::size_t>(run.steps) + 1) << "the start is there, too";
  EXPECT_EQ(kept.states().back().q, z.q);
  return kept;
}

double worst_between(const avi::Trajectory<2>& kept, double e = 0.6) {
  double worst = 0.0;
  const double end = kept.states().back().t;
  for (int k = 0; k <= 1000; ++k) {
    const double t = end * k / 1000.0;
    const auto s = kept.at(t), exact = Kepler::exact(e, t);
    EXPECT_EQ(s.t, t);
    worst = std::max({worst, (s.q - exact.q).norm(), (s.p - exact.p).norm()});
  }
  return worst;
}

TEST(Trajectory, IsEvaluatedBetweenTheSteps) {
  std::vector<double> steps, errors;
  for (const double h : {0.1, 0.07, 0.05}) {
    steps.push_back(h);
    errors.push_back(worst_between(path(h, 10.0)));
  }
  EXPECT_NEAR(avi::fit_order(steps, errors).order, 8.0, 0.6);
  EXPECT_LT(errors.back(), 1e-6);
  EXPECT_LT(worst_between(path(-0.05, -10.0)), 1e-6) << "backwards";
}

/// q is the given power of time.
struct PowerOfTime {
  int exponent;
  avi::StepReport step(State<1>& z, double h) const {
    z.t += h;
    z.q[0] = std::pow(z.t, exponent);
    return {};
  }
};

TEST(Trajectory, HasTheDegreeThatItsStatesAllow) {
  for (int states = 2; states <= 10; ++states)
    for (int exponent = 1; exponent <= 9; ++exponent) {
      PowerOfTime method{exponent};
      State<1> z{.q = {0.0}, .p = {0.0}};
      avi::Trajectory<1> kept;
      ASSERT_TRUE(avi::integrate(method, z, 1.0, {.steps = states - 1}, kept).ok());
      const double exact = std::pow(0.5, exponent), off = std::abs(kept.at(0.5).q[0] - exact);
      if (exponent < std::min(states, 8)) {
        EXPECT_LT(off, 1e-9) << states << ' ' << exponent;
      } else {
        EXPECT_GT(off, 1e-2) << states << ' ' << exponent;
      }
    }
}

TEST(Trajectory, GoesThroughItsStatesAndTakesFewOfThem) {
  const auto kept = path(0.3, 5.0);
  for (const auto& z : kept.states())
    EXPECT_LT((kept.at(z.t).q - z.q).norm(), 1e-15);
  const auto two = path(0.3, 0.01);
  ASSERT_EQ(two.states().size(), 2u);
  EXPECT_LT((two.at(0.005).q - Kepler::exact(0.6, 0.005).q).norm(), 2e-4) << "the line through them";
}

/// The circle q = cos t, p = -sin t by its exact flow.
struct Circle {
  avi::StepReport step(State<1>& z, double h) const {
    const double q = z.q[0], p = z.p[0];
    z.q[0] = std::cos(h) * q + std::sin(h) * p;
    z.p[0] = std::cos(h) * p - std::sin(h) * q;
    z.t += h;
    return {};
  }
};

TEST(Trajectory, PassesOverStatesMuchNearerThanOthers) {
  // Steps that differ by any factor, as runs that continue each other and events leave them. Errors are those
  // of equal steps of the widest of them.
  for (const std::vector<double>& pattern : {std::vector<double>{0.1, 0.1, 0.1, 0.1, 0.1},
                                             {0.1, 0.1, 1e-17, 0.1, 0.1},
                                             {0.1, 1e-15, 0.1, 1e-9},
                                             {0.1, 1e-12, 1e-4, 0.1, 1e-12, 0.1},
                                             {0.1, 0.1, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3},
                                             {1e-13, 0.1, 1e-13},
                                             {0.1, 0.1, 0.1, 0.1, 0.1, 0.013, 0.1, 0.1, 0.1, 0.1, 0.013}})
    for (const double sense : {1.0, -1.0}) {
      State<1> z{.q = {1.0}, .p = {0.0}};
      avi::Trajectory<1> kept;
      Circle circle;
      for (int k = 0; k < 60; ++k)
        for (const double h : pattern)
          ASSERT_TRUE(avi::integrate(circle, z, sense * h, {.steps = 1}, kept).ok());
      double worst = 0.0;
      for (int k = 0; k <= 3000; ++k) {
        const double t = z.t * k / 3000.0, error = std::abs(kept.at(t).q[0] - std::cos(t));
        if (!(error <= worst)) worst = error;
      }
      EXPECT_LT(worst, 6e-10) << pattern.size() << " steps, the third " << pattern[2];  // measured 3e-10
      for (const State<1>& there : kept.states())
        EXPECT_NEAR(kept.at(there.t).q[0], there.q[0], 4e-16);
    }
}

TEST(Trajectory, RefusesTimesOutside) {
  const auto kept = path(0.3, 5.0);
  for (const double t : {-1e-9, 5.0 + 1e-9, std::nan("")})
    EXPECT_THROW((void)kept.at(t), std::invalid_argument) << t;
  EXPECT_THROW((void)avi::Trajectory<2>{}.at(0.0), std::invalid_argument);
}

TEST(Trajectory, ContinuesARunAndNoOther) {
  auto z = Kepler::pericentre(0.6);
  auto method = avi::splitting(avi::LogHamiltonian(Kepler{}, z), avi::compositions::kahan_li8);
  avi::Trajectory<2> kept;
  EXPECT_EQ(avi::integrate_to(method, z, 0.1, 1.0, kept).outcome, avi::Outcome::ok);
  EXPECT_EQ(avi::integrate_to(method, z, 0.1, 2.0, kept).outcome, avi::Outcome::ok);
  EXPECT_LT((kept.at(1.5).q - Kepler::exact(0.6, 1.5).q).norm(), 1e-7);
  const auto end = z;
  z = Kepler::pericentre(0.6);
  EXPECT_THROW((void)avi::integrate_to(method, z, 0.1, 1.0, kept), std::invalid_argument);
  // Nor does it turn round, which gave nan between its states, or bear a kick.
  z = end;
  EXPECT_THROW((void)avi::integrate(method, z, -0.1, {.steps = 1}, kept), std::invalid_argument);
  z = end;
  z.p[0] += 1.0;
  EXPECT_THROW((void)avi::integrate(method, z, 0.1, {.steps = 1}, kept), std::invalid_argument);
}

TEST(Trajectory, IsWrittenWithEveryDigit) {
  const auto kept = path(0.3, 1.0);
  std::stringstream table;
  kept.write(table);
  std::string names;
  std::getline(table, names);
  EXPECT_EQ(names, "t\tq_1\tq_2\tp_1\tp_2");
  for (const auto& z : kept.states())
    for (const double x : {z.t, z.q[0], z.q[1], z.p[0], z.p[1]}) {
      double read = 0.0;
      table >> read;
      EXPECT_EQ(read, x);
    }
  std::string rest;
  EXPECT_FALSE(table >> rest);
}

}  // namespace trajectory_test
