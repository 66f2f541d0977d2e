#include "avi/avi.hpp"
#include "kept.hpp"
#include "refusal.hpp"
#include "scratch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace solve_monitor_test {

using avi::Kepler, avi::solve, avi::SolveOptions;

/// The time of Kepler's orbits in which steps are even in the half-way anomaly.
const auto halfway = [](const auto& q, const auto&) { return pow(q[0] * q[0] + q[1] * q[1], 0.75); };

// The steps are those of the general method with the same monitor.
TEST(SolveMonitor, OfOnesOwnMakesTheStepsOfCollocation) {
  const auto z = Kepler::pericentre(0.9);
  for (const int order : {4, 8, 16}) {
    const double h = order == 4 ? 0.01 : 0.1;
    const auto orbit =
        solve(Kepler(), z, 20.0, 1e-8, {.order = order, .monitor = halfway, .h = h, .dense = true});
    EXPECT_EQ(orbit.choice.name, "given");
    auto method = avi::collocation(avi::poincare(Kepler(), z, avi::Gamma{0.75}), order);
    auto by_hand = z;
    const std::vector<double>& times = orbit.curve->times();
    ASSERT_GT(times.size(), 30u);
    for (std::size_t i = 1; i + 1 < times.size(); ++i) {
      (void)method.step(by_hand, h);
      ASSERT_NEAR(times[i], by_hand.t, 1e-11) << i;
    }
    EXPECT_LT((orbit(by_hand.t).q - by_hand.q).norm(), 1e-10);
  }
}

TEST(SolveMonitor, OfOnesOwnKeepsTheTolerance) {
  const auto z = Kepler::pericentre(0.9);
  const auto own = kept(solve(Kepler(), z, 20.0 * M_PI, 1e-10, {.monitor = halfway}));
  EXPECT_LT((own.state.q - z.q).norm(), 1e-9);
  EXPECT_LT(2 * own.run.steps, solve(Kepler(), z, 20.0 * M_PI, 1e-10, {.monitor = "energy"}).run.steps);
  // Of q alone; backwards; even, as fixed steps are.
  EXPECT_EQ(solve(Kepler(), z, 20.0 * M_PI, 1e-10, {.monitor = avi::Gamma{0.75}}).state.q, own.state.q);
  EXPECT_LT((solve(Kepler(), z, -20.0 * M_PI, 1e-10, {.monitor = halfway}).state.q - z.q).norm(), 1e-9);
  const auto even =
      kept(solve(Kepler(), z, 6.0, 1e-8, {.monitor = [](const auto& q) { return 0.5 + 0.0 * q[0]; }}));
  EXPECT_NEAR(double(even.run.steps), double(solve(Kepler(), z, 6.0, 1e-8, {.monitor = "fixed"}).run.steps),
              0.5 * even.run.steps);
}

TEST(SolveMonitor, OfOnesOwnMayDependOnTime) {
  const auto driven = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] - q[0] * sin(2.0 * t);
  };
  const auto exact = [](double t) { return std::cos(t) - std::sin(2.0 * t) / 3.0; };
  avi::State<1> z;
  z.q << 1.0, z.p << -2.0 / 3.0;
  const auto of_time = [](const auto& q, const auto& t, const auto& p) {
    return (1.0 + 0.2 * sin(t)) / (1.0 + q[0] * q[0] + p[0] * p[0]);
  };
  const auto of_state = [](const auto& q, const auto& p) { return 1.0 / (1.0 + q[0] * q[0] + p[0] * p[0]); };
  for (const SolveOptions& options : {SolveOptions{.monitor = of_time}, SolveOptions{.monitor = of_state}}) {
    const auto orbit = kept(solve(driven, z, 10.0, 1e-10, options));
    EXPECT_NEAR(orbit.state.q[0], exact(10.0), 1e-9);
  }
}

TEST(SolveMonitor, OfOnesOwnServesASolverAndGoesOnFromAFile) {
  const auto z = Kepler::pericentre(0.9);
  const Scratch folder;
  const std::string file = folder / "run";
  const double end = 2000.0 * M_PI;
  const auto whole = solve(Kepler(), z, end, 1e-10, {.check = false, .monitor = halfway, .checkpoint = file});
  (void)solve(Kepler(), z, end, 1e-10,
              {.check = false, .steps = 9000, .monitor = halfway, .checkpoint = file});
  EXPECT_THROW((void)avi::resume<2>(Kepler(), file), std::invalid_argument);
  EXPECT_THROW((void)avi::resume<2>(Kepler(), file, {.monitor = avi::Gamma{0.5}}), std::invalid_argument);
  const auto rest = avi::resume<2>(Kepler(), file, {.monitor = halfway});
  EXPECT_EQ(rest.state.q, whole.state.q);
  EXPECT_EQ(rest.state.p, whole.state.p);
  const avi::Solver solver(Kepler(), z, 20.0, 1e-9, {.monitor = halfway});
  EXPECT_EQ(solver.choice().name, "given");
  EXPECT_TRUE(solver.run(z, 20.0).kept());
}

TEST(SolveMonitor, OfOnesOwnIsRefusedWithASentence) {
  const auto z = Kepler::pericentre(0.9);
  const auto refused = [&](const avi::SolveMonitor& monitor, const char* part) {
    expect_refusal([&] { (void)solve(Kepler(), z, 10.0, 1e-6, {.monitor = monitor}); }, part);
  };
  refused([](const auto& q, const auto&) { return -q[0]; }, "at the start is -0.09");
  refused([](const auto& q, const auto&) { return q[0]; }, "The given monitor near t = ");
  refused([](const auto& q, const auto&) { return log(-q[0]); }, "at the start is ");
  refused([](const auto& q, const auto& t, const auto&) { return q[0] + t; }, "Number of arguments");
  refused("given", "one of fixed, energy");
}

// A sawtooth drives a spring: where its energy goes through zero, the monitor has a singularity, not H.
TEST(SolveMonitor, ThatIsNamedIsBlamedByItsName) {
  const auto driven = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * (p[0] * p[0] + q[0] * q[0]) - 0.348 * q[0] * (t / 0.4 - floor(t / 0.4));
  };
  const avi::State<1> start{.q = std::sin(1.7 * 24), .p = std::cos(2.3 * 24), .t = 0.05};
  const auto named = solve(driven, start, 10.0, 1e-6, {.monitor = "energy"});
  EXPECT_NE(named.run.message.find("of monitor energy, as asked for"), std::string::npos)
      << named.run.message;
  EXPECT_TRUE(solve(driven, start, 10.0, 1e-6).kept());
}

// The momentum of time moves by rounding alone where H hardly depends on time; nobody asks for it.
TEST(SolveMonitor, OfTimeAloneServesAnHThatHardlyChanges) {
  const auto slower = [](const auto&, const auto& t, const auto&) { return 1.0 / (1.0 + 0.01 * t * t); };
  for (const double drive : {1.0, 1e-9, 0.0}) {
    const auto driven = [=](const auto& q, const auto& t, const auto& p) {
      return 0.5 * (p[0] * p[0] + q[0] * q[0]) - drive * q[0] * cos(2.0 * t);
    };
    const auto orbit =
        kept(avi::solve(driven, avi::State<1>{.q = 1.0, .p = 0.0}, 30.0, 1e-8, {.monitor = slower}));
    const double exact = (1.0 + drive / 3.0) * std::cos(30.0) - drive / 3.0 * std::cos(60.0);
    EXPECT_NEAR(orbit.state.q[0], exact, 1.2e-10);  // measured 5.9e-11, without a drive
  }
}

}  // namespace solve_monitor_test
