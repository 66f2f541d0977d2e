#include "avi/core/integrate.hpp"
#include "avi/diagnostics/symplecticity.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/pendulum.hpp"
#include "beyond/speed/automatic_monitors/choose_monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace choose_monitor_test {

using avi::Kepler;

struct Light {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    using std::sqrt;
    return sqrt(p[0] * p[0] + p[1] * p[1]) + 0.5 * (q[0] * q[0] + q[1] * q[1]);
  }
};

TEST(ChooseMonitor, TakesThePowerOfTheRadiusOnAnEccentricOrbit) {
  for (const auto& [order, error] : {std::pair{4, 1e-5}, {8, 1e-8}, {16, 1e-11}}) {
    const auto choice = experiment::choose_monitor(Kepler(), Kepler::pericentre(0.9),
                                                   {.energy_error = error, .order = order});
    EXPECT_TRUE(choice.reached);
    // H_0 - V is 1/r - 1/2: with the mean added and to the power -3/2 nearly r^(3/2).
    EXPECT_EQ(choice.name, "energy^1.5");
    EXPECT_NE(choice.report().find("Chosen: energy^1.5"), std::string::npos);
    // What it cost: below 15 % of a hundred periods (measured 2 to 5 %), of which it sees less than one.
    const auto problem = poincare(Kepler(), Kepler::pericentre(0.9), choice.monitor);
    auto method = avi::collocation(problem, order);
    auto z = Kepler::pericentre(0.9);
    const avi::Run run = integrate(method, z, choice.h, avi::Until{.time = 200.0 * M_PI});
    EXPECT_LT(static_cast<double>(choice.sweeps), 0.15 * static_cast<double>(run.evaluations)) << order;
  }
}

TEST(ChooseMonitor, LeavesStepsAloneWhereNothingIsGained) {
  const avi::State<2> start{.q = {0.0, 0.3}, .p = {0.45, 0.0}};
  const auto choice =
      experiment::choose_monitor(avi::HenonHeiles(), start, {.energy_error = 1e-11, .order = 16});
  EXPECT_EQ(choice.name, "fixed");
}

TEST(ChooseMonitor, ChoosesTheSameAgain) {
  const auto first = experiment::choose_monitor(avi::Pendulum(), avi::Pendulum::start(3.1));
  const auto second = experiment::choose_monitor(avi::Pendulum(), avi::Pendulum::start(3.1));
  EXPECT_EQ(first.report(), second.report());
  EXPECT_EQ(first.h, second.h);
  EXPECT_EQ(first.name, "fixed");  // near the separatrix others save steps, but no work
}

// In special relativity a fast oscillator takes 21 for a turn, and n_0, small in flight, would have the
// trials take 90: what is a third of a hundred turns' work then is an eighth.
TEST(ChooseMonitor, EndsATrialWhenTheVelocityHasTurned) {
  const auto oscillator = [](const auto& q, const auto& p) {
    return sqrt(1.0 + p[0] * p[0]) + 0.5 * q[0] * q[0];
  };
  const avi::State<1> start{.q = avi::Vector<double, 1>(5.0), .p = avi::Vector<double, 1>(0.0)};
  const auto choice = experiment::choose_monitor(oscillator, start, {.energy_error = 1e-11, .order = 16});
  EXPECT_TRUE(choice.reached);
  EXPECT_GT(choice.time, 21.0);  // measured 33.6
  EXPECT_LT(choice.time, 42.0);
}

// Kepler's problem at order 16: when three monitors have been tried, what promises little is not worth a run.
TEST(ChooseMonitor, DoesNotTryWhatPromisesLittleWhenMuchIsSpent) {
  const auto choice =
      experiment::choose_monitor(Kepler(), Kepler::pericentre(0.9), {.energy_error = 1e-11, .order = 16});
  EXPECT_EQ(choice.name, "energy^1.5");
  for (const experiment::Trial& trial : choice.trials)
    EXPECT_NE(trial.monitor, "gentle");
  EXPECT_LT(choice.sweeps, 280);  // measured 249; 309 with everything tried
}

// A trial tells something only between the longest step of its monitor that met the tolerance and the
// shortest that did not.
TEST(ChooseMonitor, TriesStepsBetweenTheGoodAndTheBadOnes) {
  for (const auto& [order, error] : {std::pair{4, 1e-5}, {8, 1e-8}, {16, 1e-11}})
    for (const double eccentricity : {0.3, 0.9}) {
      const auto choice = experiment::choose_monitor(Kepler(), Kepler::pericentre(eccentricity),
                                                     {.energy_error = error, .order = order});
      std::map<std::string, double> good, bad;
      for (const experiment::Trial& trial : choice.trials) {
        const double shortest = bad.try_emplace(trial.monitor, 1e300).first->second;
        EXPECT_LT(trial.h, shortest) << order << " " << trial.monitor << "\n" << choice.report();
        EXPECT_GT(trial.h, good[trial.monitor]) << order << " " << trial.monitor << "\n" << choice.report();
        (trial.energy_error <= error ? good : bad)[trial.monitor] = trial.h;
      }
    }
}

// Which trials are made, and how long, depends on every rule and number of the choice.
TEST(ChooseMonitor, MakesTheSameTrialsOnEveryMachine) {
  const auto expect = [](const auto& choose, int order, double error, const std::string& way, double h,
                         double work) {
    const experiment::MonitorChoice choice =
        choose(experiment::MonitorTarget{.energy_error = error, .order = order});
    std::string seen = choice.name, last;
    for (const experiment::Trial& trial : choice.trials) {
      if (trial.monitor != last) seen += ", " + (last = trial.monitor);
      seen += " " + std::to_string(trial.steps) + "/" + std::to_string(trial.sweeps);
    }
    EXPECT_EQ(seen, way) << "order " << order;
    EXPECT_NEAR(choice.h / h, 1.0, 1e-5) << way;
    EXPECT_NEAR(choice.work / work, 1.0, 1e-6) << way;
  };
  const auto orbit = [](double eccentricity) {
    return [=](const experiment::MonitorTarget& target) {
      return experiment::choose_monitor(Kepler(), Kepler::pericentre(eccentricity), target);
    };
  };
  const auto swing = [](const experiment::MonitorTarget& target) {
    return experiment::choose_monitor(avi::Pendulum(), avi::Pendulum::start(3.1), target);
  };
  const auto light = [](experiment::MonitorTarget target) {
    target.time = 3.0;
    return experiment::choose_monitor(Light(), Kepler::pericentre(0.5), target);
  };
  const auto fast = [](const experiment::MonitorTarget& target) {
    const auto oscillator = [](const auto& q, const auto& p) {
      return sqrt(1.0 + p[0] * p[0]) + 0.5 * q[0] * q[0];
    };
    const avi::State<1> start{.q = avi::Vector<double, 1>(5.0), .p = avi::Vector<double, 1>(0.0)};
    return experiment::choose_monitor(oscillator, start, target);
  };
  expect(orbit(0.3), 4, 1e-5, "fixed, fixed 27/270 56/423", 0.115679, 19141.4);
  expect(orbit(0.6), 4, 1e-5,
         "energy^1.5, energy^1.5 27/240, curvature 27/379, energy 27/235, gentle 27/332, speed 27/295, fixed "
         "1/18, energy^1.5 35/266",
         0.190218, 64895);
  expect(orbit(0.9), 4, 1e-5,
         "energy^1.5, energy^1.5 26/247, curvature 26/407, energy 27/235, gentle 27/367, speed 1/40, "
         "energy^0.5 1/24, energy^1.5 58/417",
         0.117326, 61494.6);
  expect(
      orbit(0.99), 4, 1e-5,
      "energy^1.5, energy^1.5 25/239, curvature 25/395, gentle 2/43, energy 26/238, energy^1.5 81/501 99/595",
      0.0619917, 67431.8);
  expect(swing, 4, 1e-5, "fixed, fixed 27/274 69/483", 0.162722, 23054.8);
  expect(light, 4, 1e-5, "fixed, fixed 54/328 22/159 19/145", 0.164052, 12513.6);
  expect(fast, 4, 1e-5,
         "fixed, curvature 3/114, gentle 26/792, fixed 27/224, speed 27/374, curvature 41/1364, fixed 89/474 "
         "297/1301 735/3049",
         0.0456577, 157020.8);
  expect(orbit(0.3), 8, 1e-8, "fixed, fixed 16/159 22/188", 0.301733, 11252.6);
  expect(orbit(0.6), 8, 1e-8,
         "energy^1.5, energy^1.5 15/137, curvature 15/211, energy 15/135, fixed 1/16, energy^1.5 11/115",
         0.645807, 23120.2);
  expect(orbit(0.9), 8, 1e-8,
         "energy^1.5, energy^1.5 15/145, curvature 15/236, energy 15/135, gentle 15/222, energy^1.5 17/150",
         0.410173, 33169.4);
  expect(orbit(0.99), 8, 1e-8,
         "energy^1.5, energy^1.5 14/135, curvature 14/229, gentle 1/22, energy 1/19, energy^1.5 22/165",
         0.285796, 22365);
  expect(swing, 8, 1e-8, "fixed, fixed 16/161 30/233", 0.37982, 13108.6);
  expect(fast, 8, 1e-8,
         "fixed, curvature 2/117, gentle 15/505, fixed 5/46, speed 15/222, fixed 25/170, curvature 23/702, "
         "fixed 84/411 278/1178 446/1848 402/1672",
         0.0836711, 126836.4);
  expect(orbit(0.3), 16, 1e-11, "fixed, fixed 8/83 10/93 10/91", 0.653267, 11244.2);
  expect(orbit(0.6), 16, 1e-11,
         "energy^1.5, energy^1.5 8/80, curvature 8/119, energy 8/76, fixed 8/106, energy^1.5 6/66 5/58 5/60",
         1.32829, 24299);
  expect(orbit(0.9), 16, 1e-11, "energy^1.5, energy^1.5 7/74, curvature 7/120, energy^1.5 6/68", 1.26202,
         13912.2);
  expect(orbit(0.99), 16, 1e-11, "energy^1.5, energy^1.5 7/66, curvature 7/122, energy^1.5 6/65 6/65",
         1.06218, 16029.8);
  expect(fast, 16, 1e-11,
         "fixed, curvature 0/0, gentle 6/344, fixed 3/32, speed 5/86, fixed 13/117, speed 13/192, curvature "
         "12/544, gentle 12/326, fixed 41/223 128/556 177/714 194/764",
         0.17314, 96248.4);
  expect(orbit(0.3), 10, 1e-3, "fixed, fixed 4/81", 1.61389, 5738.6);
  expect(orbit(0.6), 10, 1e-3, "energy, energy^1.5 4/60, curvature 4/111, energy 4/61, fixed 4/100", 1.52442,
         15568.2);
  expect(orbit(0.9), 10, 1e-3, "energy^1.5, energy^1.5 4/64, curvature 4/154", 1.76818, 12461.8);
  expect(orbit(0.99), 10, 1e-3, "energy^1.5, energy^1.5 4/63, curvature 1/35, gentle 0/0, energy 0/0",
         1.67709, 7235.8);
  expect(swing, 10, 1e-3, "fixed, fixed 4/84", 2.79929, 6244.2);
  expect(light, 10, 1e-3, "fixed, fixed 8/62", 0.375, 1649.2);
  expect(fast, 10, 1e-3,
         "fixed, curvature 0/0, gentle 0/0, fixed 1/11, speed 2/50, fixed 3/35 4/40, speed 7/145, curvature "
         "0/0, gentle 0/0, fixed 18/145, gentle 11/462, curvature 1/31, speed 10/162, fixed 31/195 53/287 "
         "70/347 77/373",
         0.438029, 56429.4);
}

TEST(ChooseMonitor, LeavesASymplecticMap) {
  const auto start = Kepler::pericentre(0.9);
  const auto choice = experiment::choose_monitor(Kepler(), start);
  const auto method = avi::collocation(poincare(Kepler(), start, choice.monitor), 8);
  avi::State<2> z = start;
  z.q << 0.3, 0.7;
  z.p << -0.4, 0.9;
  const double step = choice.h;
  EXPECT_LT(avi::symplecticity_defect(method, z, step), 1e-8);  // that of the difference quotients
}

TEST(ChooseMonitor, SaysThatAPilotMetACollision) {
  auto falling = Kepler::pericentre(0.0);
  falling.p.setZero();  // is in the centre at t = pi / sqrt(8) = 1.11
  const auto choice =
      experiment::choose_monitor(Kepler(), falling, {.energy_error = 1e-8, .order = 8, .time = 2.0});
  EXPECT_FALSE(choice.reached);
  EXPECT_NE(choice.report().find("No monitor of the menu reached"), std::string::npos) << choice.report();
  EXPECT_LT(choice.trials.size(), 60u);
}

TEST(ChooseMonitor, CountsWorkAndNotStepsAlone) {
  // On a circle nothing is gained, and a monitor that hardly changes is not even tried.
  const auto circle =
      experiment::choose_monitor(Kepler(), Kepler::pericentre(0.0), {.energy_error = 1e-8, .order = 8});
  EXPECT_EQ(circle.name, "fixed");
  for (const experiment::Trial& trial : circle.trials)
    EXPECT_EQ(trial.monitor, "fixed");
}

// Gauss collocation keeps the energy of a harmonic oscillator whatever the step: that alone would let one
// step pass over several turns.
TEST(ChooseMonitor, ResolvesTheMotionEvenWhereTheEnergyDoesNotAskForIt) {
  const auto oscillator = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0] + q[0] * q[0]); };
  const avi::State<1> start{.q = avi::Vector<double, 1>(1.0), .p = avi::Vector<double, 1>(0.0)};
  const auto choice =
      experiment::choose_monitor(oscillator, start, {.energy_error = 1e-3, .order = 16, .time = 40.0});
  EXPECT_EQ(choice.name, "fixed");
  EXPECT_TRUE(choice.reached);
  EXPECT_LE(choice.h, 2.5) << "in radians";
}

TEST(ChooseMonitor, SaysWhyOnlyFixedStepsAreLeft) {
  const auto choice = experiment::choose_monitor(Light(), Kepler::pericentre(0.5),
                                                 {.energy_error = 1e-6, .order = 4, .time = 3.0});
  EXPECT_EQ(choice.name, "fixed");
  EXPECT_NE(choice.report().find("not positive definite"), std::string::npos);
}

TEST(ChooseMonitor, RefusesWhatCannotBe) {
  const auto start = Kepler::pericentre(0.5);
  EXPECT_THROW(experiment::choose_monitor(Kepler(), start, {.energy_error = 0.0}), std::invalid_argument);
  EXPECT_THROW(experiment::choose_monitor(Kepler(), start, {.order = 7}), std::invalid_argument);
  EXPECT_THROW(experiment::choose_monitor(Kepler(), start, {.time = -1.0}), std::invalid_argument);
  auto centre = start;
  centre.q.setZero();
  EXPECT_THROW(experiment::choose_monitor(Kepler(), centre), std::invalid_argument);
}

}  // namespace choose_monitor_test
