#include "avi/solve.hpp"

#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/pendulum.hpp"
#include "kept.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace solve_test {

using avi::Kepler, avi::solve, avi::State, systems::at, systems::spring;

// Gauss conserves quadratic H at any step, so that energy says nothing of the phase.
TEST(Solve, KnowsThePhaseOfASpring) {
  for (const double tolerance : {1e-4, 1e-8, 1e-12})
    for (const double end : {1.0, 10.0, 100.0, 1000.0}) {
      const auto orbit = kept(solve(spring, at(1.0, 0.0), end, tolerance));
      EXPECT_EQ(orbit.state.t, end);
      EXPECT_LE(std::abs(orbit.state.q[0] - std::cos(end)), 2.0 * tolerance) << tolerance << " " << end;
      EXPECT_LE(std::abs(orbit.state.p[0] + std::sin(end)), 2.0 * tolerance) << tolerance << " " << end;
    }
}

TEST(Solve, KnowsASmallFastPartBesideALargeSlowOne) {
  const auto both = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * q[0] * q[0] + 0.5e6 * q[1] * q[1];
  };
  const State<2> start{.q = {1.0, 1e-6}, .p = {0.0, 0.0}};
  for (const double tolerance : {1e-4, 1e-8}) {
    const auto orbit = kept(solve(both, start, 20.0, tolerance));
    EXPECT_LE(std::abs(orbit.state.q[1] / 1e-6 - std::cos(2e4)), 3.0 * tolerance);
  }
}

TEST(Solve, KnowsALightBodyBesideAHeavyOne) {
  const double e = 0.9, heavy = 9.5e-4;
  double distance = 0.0;
  for (const double light : {1e-6, 1e-12, 1e-16, 1e-20}) {
    const auto energy = [=](const auto& q, const auto& p) {
      const auto r = [&](int i, int j) {
        const auto x = q[2 * i] - q[2 * j], y = q[2 * i + 1] - q[2 * j + 1];
        return sqrt(x * x + y * y);
      };
      return 0.5 * (p[0] * p[0] + p[1] * p[1]) + (p[2] * p[2] + p[3] * p[3]) * (0.5 / light) +
             (p[4] * p[4] + p[5] * p[5]) * (0.5 / heavy) - light / r(0, 1) - heavy / r(0, 2) -
             light * heavy / r(1, 2);
    };
    State<6> start;
    start.q << 0, 0, 1 - e, 0, 5.2, 0;
    const double v = light * std::sqrt((1 + e) / (1 - e)), V = heavy / std::sqrt(5.2);
    start.p << 0, -v - V, 0, v, 0, V;
    const auto orbit = solve(energy, start, 100.0, 1e-8);
    EXPECT_TRUE(orbit.kept()) << light << orbit.report();
    const double now = std::hypot(orbit.state.q[2] - orbit.state.q[0], orbit.state.q[3] - orbit.state.q[1]);
    if (light > 1e-7) continue;  // it moves the Sun
    if (distance > 0.0) {
      EXPECT_NEAR(now, distance, 1e-6) << light;
    }
    distance = now;
  }
}

TEST(Solve, IsWhereTheOrbitIs) {
  const double period = 2.0 * M_PI;
  const auto orbit = kept(solve(Kepler(), Kepler::pericentre(0.9), 10.5 * period, 1e-11));
  EXPECT_NEAR(orbit.state.q[0], -1.9, 1e-10);
  EXPECT_NEAR(orbit.state.q[1], 0.0, 1e-10);
}

TEST(Solve, StaysAtAnEquilibrium) {
  const auto orbit = kept(solve(avi::Pendulum(), at(0.0, 0.0), 3.0, 1e-6));
  EXPECT_EQ(orbit.state.q[0], 0.0);
  EXPECT_EQ(orbit.state.t, 3.0);
}

// A narrow bump that is thinner than a step: the motion turns at 0.3.
TEST(Solve, SeesAWallThinnerThanItsSteps) {
  for (const double width : {0.03, 0.003}) {
    const auto walled = [=](const auto& q, const auto& p) {
      const auto d = (q[0] - 0.3) * (1.0 / width);
      return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] + 10.0 * exp(-1.0 * d * d);
    };
    for (const double end : {2.0, 5.0, 8.0})
      for (const double tolerance : {1e-4, 1e-8}) {
        const auto orbit = solve(walled, at(1.0, 0.0), end, tolerance);
        EXPECT_TRUE(!orbit.kept() || orbit.state.q[0] > 0.3) << orbit.report();
      }
  }
}

// The energy errs alike at a jump of H. The same steps, solved to more digits, may help where there is
// something to solve; explicit ones would only be made again.
TEST(Solve, RepeatsNoExplicitSteps) {
  const auto jump = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + select(q[0] > 1.0, 0.2, 0.0);
  };
  const auto orbit = solve(jump, at(0.0, 1.0), 3.0, 1e-8);
  const auto& trials = orbit.choice.trials;
  EXPECT_EQ(orbit.choice.name, "splitting");
  for (std::size_t i = 0; i < trials.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(trials[i].monitor == trials[j].monitor && trials[i].order == trials[j].order &&
                   trials[i].h == trials[j].h)
          << i << " and " << j << "\n"
          << orbit.report();
}

TEST(Solve, SaysWhatTheWorkOfChoosingIsCountedIn) {
  avi::SolutionReport report;
  report.run.steps = 2;
  report.choice.sweeps = 7;
  const auto says = [&](const char* words) {
    EXPECT_NE(report.report().find(words), std::string::npos) << report.report();
  };
  says("Choosing took 7 sweeps.\n");
  report.choice.trials = {{.monitor = "splitting"}};
  says("Choosing took 7 sweeps and kicks. Runs");
  report.choice.name = "splitting";
  report.choice.check = 5;
  says("Choosing took 7 kicks, the second run 5. Runs");
  says("the energy is 0, relative to the scale 1.\n");
}

/// Work of the trials over that of the run and its check: a kick of the splitting takes a quarter of a sweep.
template <class H>
double share_of_choosing(const H& hamiltonian, int n) {
  State<avi::dynamic> start{.q = avi::VectorX(n), .p = avi::VectorX(n)};
  for (int i = 0; i < n; ++i)
    start.q[i] = 0.3 * std::sin(1.0 + 7.0 * i), start.p[i] = 0.1 * std::cos(2.0 * i);
  const auto orbit = kept(solve(hamiltonian, start, 628.0, 1e-6));
  double kicks = 0.0;
  for (const auto& trial : orbit.choice.trials)
    if (trial.monitor == "splitting") kicks += static_cast<double>(trial.sweeps);
  return (static_cast<double>(orbit.choice.sweeps) - 0.75 * kicks) /
         static_cast<double>(orbit.run.evaluations + orbit.choice.check);
}

// Over a hundred periods (measured: .00 to .15).
TEST(Solve, ChoosesAtAPriceThatDoesNotGrowWithTheDimension) {
  for (const int n : {1, 2, 3, 10, 30, 100, 300, 1000}) {
    const auto chain = [n](const auto& q, const auto& p) {
      auto h = 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0];
      for (int i = 1; i < n; ++i) {
        const auto d = q[i] - q[i - 1];
        h = h + 0.5 * p[i] * p[i] + 0.5 * d * d + 0.25 * d * d * d * d;
      }
      return h;
    };
    const auto springs = [n](const auto& q, const auto& p) {
      auto h = 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0];
      for (int i = 1; i < n; ++i)
        h = h + 0.5 * p[i] * p[i] + (0.5 + 0.3 * i / n) * q[i] * q[i];
      return h;
    };
    EXPECT_LT(share_of_choosing(chain, n), 0.2) << n;
    EXPECT_LT(share_of_choosing(springs, n), 0.2) << n;
  }
}

// Errors that grow exponentially are seen late; the step that they ask for is kept (measured: 0.33 of the
// runs; 1.4 where it was made longer again and again).
TEST(Solve, FindsTheStepOfAChaoticChainOnce) {
  constexpr int n = 30;
  const auto chain = [](const auto& q, const auto& p) {
    auto h = 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] + 0.5 * q[n - 1] * q[n - 1];
    for (int i = 1; i < n; ++i) {
      const auto d = q[i] - q[i - 1];
      h = h + 0.5 * p[i] * p[i] + 0.5 * d * d + 0.1 * d * d * d * d;
    }
    return h;
  };
  State<avi::dynamic> start{.q = avi::VectorX(n), .p = avi::VectorX(n)};
  for (int i = 0; i < n; ++i)
    start.q[i] = std::sin(1.0 + i), start.p[i] = 0.3 * std::cos(2.0 * i);
  const auto orbit = kept(solve(chain, start, 628.0, 1e-8));
  EXPECT_LT(orbit.choice.sweeps, 7 * (orbit.run.evaluations + orbit.choice.check) / 10) << orbit.report();
}

// Measured: 95 to 208 sweeps; the reference is the time of the fall.
TEST(Solve, RefusesAFallSoon) {
  const State<2> at_rest{.q = {1.5, 0.0}, .p = {0.0, 0.0}};
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    const auto orbit = solve(Kepler(), at_rest, 10.0, tolerance);
    EXPECT_FALSE(orbit.ok());
    EXPECT_LT(orbit.choice.sweeps, 1000) << orbit.report();
    const auto before =
        kept(solve(Kepler(), at_rest, 0.99 * M_PI * std::pow(1.5, 1.5) / std::sqrt(8.0), tolerance));
  }
}

// Two atoms come from afar; until they meet nothing says how short steps will have to be.
TEST(Solve, FollowsAnEncounterThatItDidNotSeeComing) {
  const auto atoms = [](const auto& q, const auto& p) {
    const auto square = q.squaredNorm(), s = 1.0 / (square * square * square);
    return 0.5 * p.squaredNorm() + 4.0 * (s * s - s);
  };
  for (const auto& [apart, speed, aside] : {std::array{1000.0, 0.06, 0.0}, std::array{1000.0, 0.3, 2.0}}) {
    const State<2> start{.q = {apart, aside}, .p = {-speed, 0.0}};
    for (const double tolerance : {1e-4, 1e-8}) {
      const auto orbit = kept(solve(atoms, start, 1.5 * apart / speed, tolerance));
      EXPECT_NEAR(orbit.state.p.norm(), speed, 20.0 * tolerance);
    }
  }
}

// Where q has fallen to 0, beyond which H is no number: after 10/3 from there on, after 7/6 before.
TEST(Solve, SaysWhenRunsFail) {
  const auto root = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + sqrt(q[0]); };
  for (const auto& [end, sentence] :
       {std::pair{7.0, "Runs fail at t = 5.3333"}, std::pair{-3.0, "Runs fail at t = 0.8333"}}) {
    const auto orbit = solve(root, State<1>{.q = {1.0}, .p = {0.5}, .t = 2.0}, end, 1e-6);
    EXPECT_EQ(orbit.run.outcome, avi::Outcome::not_converged);
    EXPECT_TRUE(orbit.run.message.starts_with(sentence)) << orbit.run.message;
  }
}

// The state is that of the run that came furthest, of whichever setting: it was the start.
TEST(Solve, GivesBackWhatWasReachedWhereAllRunsFail) {
  const auto fallen = solve(systems::logarithm, at(1.0, 0.0), 10.0, 1e-8);
  EXPECT_EQ(fallen.run.outcome, avi::Outcome::not_converged) << fallen.report();
  EXPECT_NEAR(fallen.state.t, std::sqrt(M_PI / 2.0), 1e-9);  // measured 5e-10
  EXPECT_LT(fallen.state.q[0], 6e-9);                        // measured 3e-9
  EXPECT_GT(fallen.run.steps, 0);
  // To infinity in the time K(1 / sqrt 2).
  const auto quartic = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] - 0.25 * q[0] * q[0] * q[0] * q[0];
  };
  const auto gone = solve(quartic, at(1.0, 0.0), 5.0, 1e-6);
  EXPECT_EQ(gone.run.outcome, avi::Outcome::not_converged) << gone.report();
  EXPECT_NEAR(gone.state.t, std::comp_ellint_1(M_SQRT1_2), 3e-6);  // measured 1.4e-6
  EXPECT_GT(gone.state.q[0], 5e5);                                 // measured 1e6
  EXPECT_LT(gone.run.evaluations + gone.choice.sweeps,
            1'600'000);  // measured 780 thousand; it was 17 million
  // To infinity at t = 1. The sketch sees how fast that becomes, and steps for it would be stopped at 0.017.
  const auto lift = [](const auto& q, const auto& p) { return p[0] * q[0] * q[0]; };
  const auto ended = solve(lift, at(1.0, 1.0), 2.0, 1e-8);
  EXPECT_EQ(ended.run.outcome, avi::Outcome::not_converged) << ended.report();
  EXPECT_NEAR(ended.state.t, 1.0, 1.4e-4);                         // measured 7e-5
  EXPECT_LT(ended.run.evaluations + ended.choice.sweeps, 78'000);  // measured 39 thousand
}

// No step is tried whose run would be stopped for its price before it comes to where the others failed.
TEST(Solve, IsSoonAtTheEndOfAFallAndOfABlowUp) {
  const auto blow_up = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] - 0.7 * q[0] * q[0] * q[0] * q[0];
  };
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const auto gone = solve(blow_up, at(1.0, 0.1), 5.0, tolerance);
    EXPECT_TRUE(gone.run.message.starts_with("Runs fail at t = 1.0739")) << gone.run.message;
    EXPECT_LT(gone.run.evaluations + gone.choice.sweeps, 17'000);  // measured 8.2 thousand; it was 12 million
  }
  // Its first run jumps over the centre onto an orbit of another energy; the second shows that it does not
  // come past it either. The first look at that was left out, and others were tried.
  for (const double speed : {-0.3, 0.1, 0.4}) {
    const State<2> start{.q = {1.0, 0.0}, .p = {speed, 0.0}};
    const auto fallen = solve(systems::kepler, start, 3.0, 1e-6);
    EXPECT_TRUE(fallen.run.message.starts_with("Runs fail at t = ")) << fallen.run.message;
    EXPECT_LT(fallen.run.evaluations + fallen.choice.sweeps, 1400);  // measured 700; it was 200 thousand
  }
}

// A charge in the field of a dipole, whose sweeps converge slowly: longer steps keep the tolerance, but are
// solved by Newton's method, and the whole takes five times as long.
TEST(Solve, LeavesStepsAsTheyAreWhoseSweepsConvergeSlowly) {
  const State<3> start{.q = {1.0, 0.0, 0.0}, .p = {0.0, 1.08, 0.03}};
  const auto orbit = kept(solve(systems::dipole, start, 200.0 * M_PI, 1e-2));
  EXPECT_GT(orbit.run.steps, 500);  // measured 582; 369 where they were made longer
}

// At its perihelion a comet goes through most of a step of the monitor in a moment: where a shorter step ends
// at a given time is not found by Newton's method alone. Of 3118 orbits 162 had states that were wrong by
// more than the orbit, with kept(), and 194 ended or threw.
TEST(Solve, FindsStatesInsideAStepThatBeginsAtThePerihelion) {
  for (const double near : {0.002, 0.005, 0.02}) {
    const State<2> start{.q = {near, 0.0}, .p = {0.0, std::sqrt(2.0 / near - 1.0)}};
    const auto dense = solve(systems::kepler, start, 5.0, 1e-4, {.dense = true});
    ASSERT_TRUE(dense.kept());
    for (const double t : {0.002, 0.004, 0.006, 0.008, 0.02, 0.1}) {
      const auto exact = solve(systems::kepler, start, t, 1e-10);
      const auto orbit = solve(systems::kepler, start, std::vector<double>{t, 5.0}, 1e-4);
      ASSERT_TRUE(orbit.kept()) << t;
      EXPECT_LT((orbit.states[0].q - exact.state.q).norm(), 2e-3) << near << ", " << t;
      EXPECT_LT((dense(t).q - exact.state.q).norm(), 2e-3) << near << ", " << t;
    }
  }
}

// From far away no force is felt, and long first steps go over what is on the way: equal steps for all of it
// took 8 seconds here, or were given up.
TEST(Solve, SeesFromAfarWhatIsOnTheWay) {
  const auto centres = [](const auto& q, const auto& p) {
    const auto r = sqrt(q[0] * q[0] + q[1] * q[1] + 1e-4);
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - exp(-r) / r;
  };
  const State<2> start{.q = {-90.0, 0.05}, .p = {0.5, 0.0}};
  for (const double tolerance : {1e-4, 1e-8, 1e-11}) {
    const auto orbit = kept(solve(centres, start, 400.0, tolerance));
    EXPECT_LT(orbit.run.evaluations + orbit.choice.sweeps, 60'000) << orbit.report();
  }
}

// From 300 radii not even the sketch sees what is on the way: fixed steps took 5 s at 1e-4 without an end,
// and were refused at 1e-7. The force at 40 radii is below rounding, so that the flight up to there is free.
TEST(Solve, SeesFromAfarWhatItsSketchPassesOver) {
  const auto yukawa = [](const auto& q, const auto& p) {
    const auto r = sqrt(q.dot(q));
    return 0.5 * p.dot(p) - exp(-r) / r;
  };
  const auto nearer = solve(yukawa, State<2>{.q = {-40.0, 0.1}, .p = {1.0, 0.0}}, 340.0, 1e-12);
  ASSERT_TRUE(nearer.kept()) << nearer.report();
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    const auto orbit = solve(yukawa, State<2>{.q = {-300.0, 0.1}, .p = {1.0, 0.0}}, 600.0, tolerance);
    EXPECT_TRUE(orbit.kept()) << orbit.report();
    EXPECT_LT((orbit.state.q - nearer.state.q).norm(), 0.2 * tolerance) << orbit.report();  // measured 0.08
    EXPECT_LT(orbit.run.evaluations + orbit.choice.sweeps, 62'000) << orbit.report();       // measured 30'875
  }
}

// With one monitor to choose from, steps are made shorter for longer: 5.3 was the last that was tried.
TEST(Solve, ShortensTheStepsOfAMonitorThatIsNamed) {
  const auto atoms = [](const auto& q, const auto& p) {
    const auto s = 1.0 / q.dot(q), cube = s * s * s;
    return 0.5 * p.dot(p) + 4.0 * (cube * cube - cube);
  };
  for (const char* const monitor : {"poles", "fixed"}) {
    const auto orbit = kept(
        solve(atoms, State<2>{.q = {-5000.0, 1.2}, .p = {1.0, 0.0}}, 10000.0, 1e-6, {.monitor = monitor}));
    EXPECT_NEAR(orbit.state.p.norm(), 1.0, 5e-10) << "as far away as at the start";  // measured 2.4e-10
  }
}

}  // namespace solve_test
