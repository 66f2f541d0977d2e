#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/solve.hpp"
#include "kept.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace solve_errors_test {

using avi::solve, avi::State, systems::at, systems::pendulum, systems::spring;

/// The error that is said of an orbit, over the true one: the largest of an entry in its range.
template <int n, class H>
double said_over_true(const H& hamiltonian, const State<n>& start, double end, double tolerance) {
  std::vector<double> times;
  for (int i = 0; i <= 400; ++i)
    times.push_back(end * i / 400);
  const auto exact = solve(hamiltonian, start, times, 1e-13);
  const auto orbit = solve(hamiltonian, start, end, tolerance);
  double error = 0.0;
  for (const auto& entries : {&State<n>::q, &State<n>::p})
    for (int i = 0; i < n; ++i) {
      const auto entry = [&](const State<n>& z) { return (z.*entries)[i]; };
      const auto [low, high] = std::ranges::minmax_element(exact.states, {}, entry);
      error =
          std::max(error, std::abs(entry(orbit.state) - entry(exact.state)) / (entry(*high) - entry(*low)));
    }
  EXPECT_TRUE(orbit.kept());
  EXPECT_LE(error, 3.0 * tolerance);
  return orbit.state_error / error;
}

// Ten tolerances of the state and of the energy, and what rounding of H hides.
TEST(SolveErrors, AreKeptUpToTenTolerances) {
  avi::SolutionReport report;
  report.tolerance = 1e-6;
  EXPECT_TRUE(report.kept());
  for (const auto error : {&avi::SolutionReport::state_error, &avi::SolutionReport::energy_error}) {
    report.*error = 0.99e-5;
    EXPECT_TRUE(report.kept());
    report.*error = 1.01e-5;
    EXPECT_FALSE(report.kept());
    report.*error = 0.0;
  }
  report.energy_rounding = 1e-8;
  report.energy_error = 1.09e-5;
  EXPECT_TRUE(report.kept());
  report.energy_error = 1.11e-5;
  EXPECT_FALSE(report.kept());
  report.energy_error = 0.0;
  report.run.outcome = avi::Outcome::stopped;
  EXPECT_FALSE(report.kept());
}

// What is said is no bound, but near the truth: seen were a twentieth (where two runs agree by chance) to 20
// times it, once 160 times (where the end is right by chance), half of them between 1.4 and 4 times.
TEST(SolveErrors, AreNearTheTruth) {
  const auto quartic = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.25 * (q[0] * q[0]) * (q[0] * q[0]);
  };
  std::vector<double> ratios;
  for (const double tolerance : {1e-3, 1e-4, 1e-6, 1e-8})
    for (const double end : {25.0, 250.0}) {
      for (const double e : {0.3, 0.6, 0.9})
        ratios.push_back(said_over_true(avi::Kepler(), avi::Kepler::pericentre(e), end, tolerance));
      ratios.push_back(
          said_over_true(avi::HenonHeiles(), State<2>{.q = {0.0, 0.1}, .p = {0.35, 0.1}}, end, tolerance));
      ratios.push_back(said_over_true(pendulum, at(2.0, 0.0), end, tolerance));
      ratios.push_back(said_over_true(quartic, at(1.0, 0.0), end, tolerance));
    }
  std::ranges::sort(ratios);
  const std::size_t half = ratios.size() / 2;
  EXPECT_GT(ratios.front(), 0.02);
  EXPECT_GT(ratios[half / 2], 0.7);
  EXPECT_GT(ratios[half], 1.0);
  EXPECT_LT(ratios[half], 4.0);
  EXPECT_LT(ratios[half + half / 2], 8.0);
  EXPECT_LT(ratios[ratios.size() - 2], 50.0);
}

// Double pendulums beyond their tops, whose errors grow a thousand times or more: ends by extrapolation of
// order 20 in 113 bits, to 1e-11. Those who are kept are wrong by 17 tolerances at most, where two runs
// agree by chance; it was 70 while growth was not looked at in short runs.
TEST(SolveErrors, AreNotBelievedToFallWhereSmallOnesGrow) {
  const double m1 = 1.0, m2 = 0.6, l1 = 1.0, l2 = 0.7, g = 9.81;
  const auto h = [=](const auto& q, const auto& p) {
    const auto c = cos(q[0] - q[1]);
    const auto kinetic = m2 * l2 * l2 * (p[0] * p[0]) + (m1 + m2) * l1 * l1 * (p[1] * p[1]) -
                         2.0 * m2 * l1 * l2 * (p[0] * p[1] * c);
    return kinetic / (2.0 * m2 * l1 * l1 * l2 * l2 * (m1 + m2 * (1.0 - c * c))) -
           (m1 + m2) * g * l1 * cos(q[0]) - m2 * g * l2 * cos(q[1]);
  };
  struct Orbit {
    double a, b, end;
    std::array<double, 4> z;
  };
  const Orbit orbits[] = {
      {0.5, 3.0, 10.0, {-0.63308231321718389, -17.408698861516957, 1.7655290551039109, -1.3861094901550648}},
      {3.0, 0.5, 20.0, {0.91726600870021302, 13.267025862947827, -8.7799689099514661, -2.6965028413833863}},
      {1.9, 2.9, 15.0, {1.1840408936270335, 9.9781014248663347, -3.1528747899339269, -1.2613063796626562}}};
  int kept = 0;
  for (const Orbit& orbit : orbits)
    for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
      const auto found = solve(h, State<2>{.q = {orbit.a, orbit.b}, .p = {0.0, 0.0}}, orbit.end, tolerance);
      EXPECT_TRUE(found.ok());
      if (!found.kept()) continue;
      ++kept;
      double error = 0.0;
      for (int i = 0; i < 2; ++i) {
        error = std::max(error, std::abs(found.state.q[i] - orbit.z[static_cast<std::size_t>(i)]) / 4.0);
        error = std::max(error, std::abs(found.state.p[i] - orbit.z[static_cast<std::size_t>(i) + 2]) / 10.0);
      }
      EXPECT_LE(error, 30.0 * tolerance) << found.report();
    }
  EXPECT_GE(kept, 10);
}

// H is no number beyond q = 2, where an orbit arrives after two units of time; its forces are.
TEST(SolveErrors, AreUnknownWhereTheEnergyIsNoNumber) {
  const auto h = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.1 * q[0] +
           avi::select(q[0] < 2.0, 0.0 * q[0], 0.0 * q[0] + std::numeric_limits<double>::quiet_NaN());
  };
  for (const char* monitor : {"fixed", "splitting"}) {
    const auto orbit = solve(h, at(0.0, 1.0), 5.0, 1e-6, {.monitor = monitor});
    EXPECT_FALSE(orbit.ok()) << orbit.report();
    EXPECT_NE(orbit.report().find("fail at t = 2.2"), std::string::npos) << orbit.report();
  }
}

// Neighbouring orbits are as far apart as the motion goes: two runs differ by anything then, and the order of
// the method makes no error smaller. One of the two has nothing to say from there on.
TEST(SolveErrors, AreNotMadeSmallByTheOrderInChaos) {
  struct Case {
    double energy, y, end, tolerance;
  };
  for (const auto& [energy, y, end, tolerance] : {Case{0.15, 0.2, 2000.0, 1e-3},
                                                  {0.16, 0.05, 2000.0, 1e-2},
                                                  {0.165, 0.05, 2000.0, 1e-2},
                                                  {0.165, 0.1, 4000.0, 1e-3}}) {
    const auto orbit =
        solve(avi::HenonHeiles{}, avi::HenonHeiles::on_section(energy, y, 0.1), end, tolerance);
    EXPECT_TRUE(orbit.ok());
    EXPECT_FALSE(orbit.kept()) << energy << ", " << y << ": " << orbit.report();
    EXPECT_GT(orbit.state_error, 0.1) << energy << ", " << y << ": " << orbit.report();
    // Of the run itself, 0.17 and 0.08 at the highest energy; 0.87 where the other one goes on.
    if (energy == 0.165) {
      EXPECT_LT(static_cast<double>(orbit.choice.check), 0.35 * static_cast<double>(orbit.run.evaluations));
    }
  }
  // This orbit is regular, and here shorter steps help.
  kept(solve(avi::HenonHeiles(), State<2>{.q = {0.0, 0.1}, .p = {0.1, 0.0}}, 3000.0, 1e-8));
  const auto start = avi::HenonHeiles::on_section(0.14, 0.1, 0.1);
  const auto exact =
      solve(avi::HenonHeiles{}, start, 300.0, 1e-5, {.check = false, .monitor = "fixed", .h = 0.1});
  const auto found = kept(solve(avi::HenonHeiles{}, start, 300.0, 1e-2));
  EXPECT_LT((found.state.q - exact.state.q).norm(), 1e-2);
}

// There all errors lie along the direction in which orbits part, so two runs may end near each other and far
// from the truth, by chance: these four were kept, and wrong by 52, 34, 43 and 126 tolerances. Ends by Taylor
// series of order 28 in extended precision.
TEST(SolveErrors, OfRunsThatMeetByChanceInChaosAreNotSmall) {
  const auto h = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) + q[0] * q[0] * q[1] -
           q[1] * q[1] * q[1] / 3.0;
  };
  struct Case {
    State<2> start;
    double tolerance;
    std::array<double, 4> end;
  };
  const Case cases[] = {
      {{.q = {0.0, -0x1.3e3411122e3cp-4}, .p = {0x1.0ffb9863b3dd3p-1, -0x1.44983703fed0fp-3}},
       1e-3,
       {-0.64823612038414047, -0.22230213086410019, -0.083752948104769118, -0.12852721266162093}},
      {{.q = {0.0, 0x1.fe7199ff4fb54p-3}, .p = {0x1.c84f40bad847ap-2, 0x1.18abafa07f522p-2}},
       1e-3,
       {0.66308919973060643, -0.33349967860521268, 0.15114375812002753, 0.14243221634577302}},
      {{.q = {0.0, 0x1.d654e572f689p-5}, .p = {0x1.dc9f24ae01722p-2, 0x1.2de6ac53f3cf8p-2}},
       1e-2,
       {-0.23479871324927115, -0.43252096576066057, -0.035574877515865438, -0.2387758498424967}},
      {{.q = {0.0, 0x1.1e3a972000b54p-2}, .p = {0x1.7072aaff11751p-2, -0x1.7b923cccd307fp-2}},
       1e-6,
       {0.1651768887461251, -0.40752337657557069, -0.18300729023556678, 0.28408481033020766}}};
  for (const auto& [start, tolerance, end] : cases) {
    const auto orbit = solve(h, start, 60.0 * M_PI, tolerance);
    EXPECT_TRUE(orbit.ok());
    const double error = std::max({std::abs(orbit.state.q[0] - end[0]), std::abs(orbit.state.q[1] - end[1]),
                                   std::abs(orbit.state.p[0] - end[2]), std::abs(orbit.state.p[1] - end[3])});
    EXPECT_TRUE(!orbit.kept() || error <= 10.0 * tolerance) << error << "\n" << orbit.report();
  }
}

// Chaos, and rounding of a large angle: 5 and 8 runs are tried before it is said.
TEST(SolveErrors, EndTheChoiceWhereShorterStepsAreInVain) {
  const auto pendulums = [](const auto& q, const auto& p) {
    const auto c = cos(q[0] - q[1]);
    return (p[0] * p[0] + 2.0 * p[1] * p[1] - 2.0 * p[0] * p[1] * c) / (2.0 * (2.0 - c * c)) -
           2.0 * cos(q[0]) - cos(q[1]);
  };
  const auto chaos = solve(pendulums, State<2>{.q = {2.0, 2.5}, .p = {0.0, 0.0}}, 200.0, 1e-13);
  EXPECT_TRUE(chaos.ok());
  EXPECT_FALSE(chaos.kept());
  EXPECT_GT(chaos.state_error, 1e-3);
  EXPECT_LE(chaos.choice.trials.size(), 10u);
  const auto far = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 10.0 * cos(q[0] + 1e5) + 0.5 * q[0] * q[0];
  };
  const auto rounded = solve(far, at(2.0, 0.0), 400.0, 1e-13);
  EXPECT_TRUE(rounded.ok());
  EXPECT_FALSE(rounded.kept());
  EXPECT_LE(rounded.choice.trials.size(), 16u);
}

// Chaos is said of what is seen to grow faster than by a power of time; of an angle that grows, whose
// rounding does, it was said that 4e46 ranges are foretold.
TEST(SolveErrors, AboveTheToleranceHaveAReason) {
  const auto expect = [](const auto& orbit, const std::string& said) {
    EXPECT_TRUE(orbit.ok());
    EXPECT_FALSE(orbit.kept());
    EXPECT_LE(orbit.state_error, 20.0);
    EXPECT_EQ(orbit.note.substr(0, said.size()), said) << orbit.report();
  };
  const std::string rounding = "Shorter steps do not help: rounding adds up";
  expect(solve(pendulum, at(0.0, 2.1), 3e4, 1e-11, {.check = false}), rounding);
  expect(solve(spring, at(1.0, 0.0), 1e5, 1e-13), rounding);
  const auto step = [](const auto& q, const auto& p) {
    return spring(q, p) + select(q[0] > 0.3, 0.1 + 0.0 * q[0], 0.0 * q[0]);
  };
  expect(solve(step, at(1.0, 0.0), 40.0, 1e-8), "H has a kink");
  const auto bend = [](const auto& q, const auto& p) {
    return sqrt(1e-10 + p[0] * p[0]) + 0.5 * q[0] * q[0];
  };
  expect(solve(bend, at(1.0, 0.4), 15.0, 1e-4, {.monitor = "fixed"}),
         "Steps do not resolve all of the motion");
  expect(solve(avi::HenonHeiles{}, avi::HenonHeiles::on_section(0.165, 0.1, 0.1), 300.0, 1e-12),
         "Neighbouring orbits move apart exponentially");
}

// The middle one of three rests by symmetry, and moves by rounding alone.
TEST(SolveErrors, OfWhatRestsBySymmetryAreRounding) {
  const auto toda = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) + exp(q[0] - q[1]) + exp(q[1] - q[2]) +
           exp(q[2] - q[0]);
  };
  const State<3> start{.q = {0.0, 0.1, 0.2}, .p = {1.0, 0.0, -1.0}};
  for (const double tolerance : {1e-8, 1e-9, 1e-11}) {
    const auto orbit = kept(solve(toda, start, 1000.0, tolerance));
  }
}

// A step that was made longer after the first part of the orbit and proves too long for the whole is made
// shorter again; it is not taken for chaos.
TEST(SolveErrors, OfAStepThatWasTooLongAreMended) {
  const avi::HenonHeiles energy;
  const State<2> start{.q = {0.24, 0.2}, .p = {0.3, 0.06}};
  const auto truth = solve(energy, start, 628.0, 1e-10);
  const auto orbit = kept(solve(energy, start, 628.0, 3e-3));
  ASSERT_TRUE(truth.kept()) << truth.report();
  EXPECT_LT((orbit.state.q - truth.state.q).norm(), 3e-3);
}

// Two runs round alike at the end, but the clock has no more digits there.
TEST(SolveErrors, KnowTheRoundingOfATimeThatIsFarFromZero) {
  const auto z = avi::Kepler::pericentre(0.2);
  const auto near = solve(avi::Kepler(), z, 64.0, 1e-12);
  for (const double t : {1e8, 1e10, 1e12, 1e14}) {
    State<2> late = z;
    late.t = t;
    const auto orbit = solve(avi::Kepler(), late, t + 64.0, 1e-11);
    EXPECT_TRUE(orbit.ok()) << orbit.report();
    EXPECT_FALSE(orbit.kept()) << orbit.report();
    EXPECT_GE(orbit.state_error, 0.5 * (orbit.state.q - near.state.q).norm()) << orbit.report();
    EXPECT_NE(orbit.note.find("far from zero"), std::string::npos) << orbit.report();
  }
  State<2> late = z;
  late.t = 1e16;
  const auto lost = solve(avi::Kepler(), late, 1e16 + 64.0, 1e-11);
  EXPECT_EQ(lost.run.outcome, avi::Outcome::stalled) << lost.report();
  EXPECT_NE(lost.run.message.find("The zero of time, seen from t = 1e+16"), std::string::npos);
  // A drive far from zero, over two million roundings of its time: 43 million kicks went by in vain.
  const double unit = 7.25e29, from = 4.1285100201766142e38;
  const auto driven = [=](const auto& q, const auto& t, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.18 * q[0] * q[0] / (unit * unit) - 2.4e-62 * q[0] * cos(1.2 * t / unit);
  };
  State<1> start{.q = {0.3}, .p = {0.4 / unit}};
  start.t = from;
  const auto drive = solve(driven, start, from + 1.5e29, 4e-12, {.sweeps = 10'000});
  EXPECT_TRUE(drive.ok()) << drive.report();
  EXPECT_NE(drive.note.find("Time is so far from zero"), std::string::npos) << drive.report();
}

// So far from zero, an oscillator moves by few of the numbers there are; what rests there, or is somewhere
// else, has all of its digits.
TEST(SolveErrors, KnowTheRoundingOfPlacesThatAreFarFromZero) {
  for (const double far : {1e6, 1e8, 1e10, 1e12, 1e14, 1e15}) {
    const auto around = [=](const auto& q, const auto& p) {
      const auto x = q[0] - far;
      return 0.5 * (p[0] * p[0] + x * x);
    };
    const auto found = solve(around, State<1>{.q = {far + 1.0}, .p = {0.0}}, 100.0, 1e-8);
    const double error = 0.5 * std::abs(found.state.q[0] - far - std::cos(100.0));
    EXPECT_LT(error, 3.0 * found.state_error) << far;
    EXPECT_EQ(found.kept(), far < 1e9) << found.report();
    const auto beside = [](const auto& q, const auto& p) {
      const auto x = q[1] - q[2];
      return 0.5 * (p.squaredNorm() + q[0] * q[0] + x * x);
    };
    EXPECT_TRUE(solve(beside, State<3>{.q = {1.0, far, far}, .p = {0.0, 0.0, 0.0}}, 100.0, 1e-8).kept())
        << far;
  }
}

void expect_says(const auto& energy, const auto& start, const std::string& sentence) {
  const auto orbit = solve(energy, start, start.t + 30.0, 1e-8);
  EXPECT_FALSE(orbit.ok());
  EXPECT_NE(orbit.run.message.find(sentence), std::string::npos) << orbit.run.message;
}

TEST(SolveErrors, SayWhereTheSingularityIs) {
  // From rest at 1 a body falls in the time pi / (2 sqrt 2).
  expect_says(avi::Kepler(), State<2>{.q = {1.0, 0.0}, .p = {0.0, 0.0}, .t = 5.0},
              "Runs fail at t = 6.11072 with every step");
  // No number beyond q = 2, which is reached with a finite velocity: after 0.33465, by a quadrature.
  const auto edge = [](const auto& q, const auto& p) { return spring(q, p) + sqrt(2.0 - q[0]); };
  expect_says(edge, at(1.0, 3.1, 5.0), "Runs fail at t = 5.3346");
  // Where q grows beyond all bounds, as 1 / (1 - t).
  const auto away = [](const auto& q, const auto& p) { return q[0] * q[0] * p[0]; };
  const auto orbit = solve(away, at(1.0, 1.0, 5.0), 7.0, 1e-6);
  EXPECT_NE(orbit.run.message.find("fail at t = 5.9999"), std::string::npos) << orbit.run.message;
}

// A run that cannot be says why: there is no singularity.
TEST(SolveErrors, SayWhereNumbersEnd) {
  const auto message = [&](double t, double end) {
    return solve(spring, at(1.0, 0.0, t), end, 1e-6).run.message;
  };
  EXPECT_NE(message(1.0, std::nextafter(1.0, 2.0)).find("rounding of t = 1"), std::string::npos);
  EXPECT_EQ(message(0.0, 1e15),
            "The end, t = 1e+15, is over 1e14 times as far as a step from the start may be: a nearer one "
            "will do.");
  EXPECT_NE(message(0.0, 1e300).find("1e14 times as far"), std::string::npos);
  EXPECT_NE(message(0.0, 1e-300).find("those of a double"), std::string::npos);
  const auto slow = [](const auto& q, const auto& p) { return 1e-300 * (p[0] * p[0] + q[0] * q[0]); };
  const auto found = solve(slow, at(1.0, 0.0), 1e300, 1e-6);
  EXPECT_FALSE(std::isnan(found.state_error));
}

// On its separatrix a pendulum goes up and stays: q = 2 atan(sinh t). What is lost on the way there decides
// when it falls, and to which side; two runs fell at different times and were near each other again at the
// next saddle, so that 39 of 53 were called kept, wrong by a turn. Seen since is 3e-3, or 14 tolerances.
// Likewise q = 2 sech t in a double well.
TEST(SolveErrors, KnowWhatIsLostAtASaddle) {
  const auto well = [](const auto& q, const auto& p) {
    const auto square = q[0] * q[0];
    return 0.5 * p[0] * p[0] - 0.5 * square + 0.125 * square * square;
  };
  int kept = 0;
  long sweeps = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-8, 1e-12})
    for (double end = 10.0; end<120.0; end *= tolerance> 1e-3 ? 1.03 : 1.3) {
      const double bound = std::max(1e-2, 20.0 * tolerance);
      const auto up = solve(pendulum, at(0.0, 2.0), end, tolerance);
      const auto in = solve(well, at(2.0, 0.0), end, tolerance);
      kept += up.kept() + in.kept();
      for (const auto* each : {&up, &in})
        sweeps += each->run.evaluations + each->choice.sweeps + each->choice.check;
      if (up.kept()) {
        EXPECT_NEAR(up.state.q[0], 2.0 * std::atan(std::sinh(end)), bound) << tolerance << ", " << end;
      }
      if (in.kept()) {
        EXPECT_NEAR(in.state.q[0], 2.0 / std::cosh(end), bound) << tolerance << ", " << end;
      }
    }
  EXPECT_GE(kept, 60);
  // 7.3 million. Rounding decides there, so errors of pairs go up and down: 118 million where one better
  // than the pair before it, and not than the best, was taken for progress.
  EXPECT_LT(sweeps, 11'000'000);
}

// Two runs of too long steps agreed by chance here, and the larger of their energy errors, 1.6e-7, was
// taken for rounding of H: the state was said to err by 2e-9, and did by 6e-8. Where H is a difference of
// large numbers such an error is rounding.
TEST(SolveErrors, OfTheEnergyAreRoundingOnlyWhereHRounds) {
  const State<1> start{.q = {5.0}, .p = {0.0}};
  const auto exact = solve(systems::relativistic, start, 64.25, 1e-13);
  const auto orbit = kept(solve(systems::relativistic, start, 64.25, 1e-9));
  EXPECT_LE(orbit.energy_error, 1e-8) << orbit.report();
  EXPECT_NEAR(orbit.state.q[0], exact.state.q[0], 1e-7);
  const auto slow = [](const auto& q, const auto& p) {
    return 1e8 * (sqrt(1.0 + 1e-8 * p[0] * p[0]) - 1.0) + 0.5 * q[0] * q[0];
  };
  const auto rounded = kept(solve(slow, at(1.0, 0.0), 50.0, 1e-10));
  EXPECT_GT(rounded.energy_error, 1e-9) << rounded.report();
}

// Chaos that rounding decides, with a monitor: pairs of runs part at one mark and then at another, which is
// no gain. 60 and 40 million sweeps went by, and the reason given was a singularity.
TEST(SolveErrors, ArePutDownToChaosBeforeLong) {
  const avi::SolveOptions options{.sweeps = 2'000'000};
  const auto expect_chaos = [](const auto& orbit) {
    EXPECT_TRUE(orbit.ok());
    EXPECT_FALSE(orbit.kept());
    EXPECT_NE(orbit.note.find("depends on more digits"), std::string::npos) << orbit.report();
  };
  // A charge in the field of a dipole, near its equator.
  const auto dipole = [](const auto& q, const auto& p) {
    const auto square = q[0] * q[0] + q[1] * q[1];
    const auto moved = 1.0 / q[0] - q[0] / (square * sqrt(square));
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + moved * moved);
  };
  const State<2> equator{.q = {1.0, 0.0}, .p = {0.001, 0.12}};
  for (const double tolerance : {1e-3, 1e-4})
    expect_chaos(solve(dipole, equator, 1000.0, tolerance, options));
  // A body on the axis of two others, whose distance comes and goes.
  const auto axis = [](const auto& q, const auto& t, const auto& p) {
    const auto r = 0.5 * (1.0 - 0.3 * cos(t) + 0.045 * (1.0 - cos(2.0 * t)));
    return 0.5 * p[0] * p[0] - 1.0 / sqrt(q[0] * q[0] + r * r);
  };
  for (const double tolerance : {1e-3, 1e-6})
    expect_chaos(solve(axis, at(0.0, 1.95), 1000.0, tolerance, options));
}

// Friction for so long that the rounding of a place at rest, times its growing mass, is more than the
// energy: no step makes that less, and a call went on for minutes.
TEST(SolveErrors, EndWhereTheEnergyIsRoundingAlone) {
  const auto well = [](const auto& q, const auto& t, const auto& p) {
    const auto square = q[0] * q[0];
    return 0.5 * p[0] * p[0] * exp(-0.1 * t) + exp(0.1 * t) * (0.25 * square * square - 0.5 * square);
  };
  for (const double tolerance : {1e-3, 1e-6}) {
    const avi::SolveOptions options{.sweeps = 15'000'000};
    const auto orbit = solve(well, at(2.5, 0.0), 600.0, tolerance, options);
    EXPECT_TRUE(orbit.ok()) << orbit.report();
  }
}

// Near the small body of a restricted problem steps of order 16 do not fall by their order yet: the energy
// says so, and what two runs differ by is believed as far as it falls.
TEST(SolveErrors, OfFewStepsAreBelievedAsFarAsEnergyErrorsFall) {
  const auto restricted = systems::restricted(1e-3);
  for (int k = 0; k < 20; ++k) {
    const State<2> start{.q = {0.5 - 0.001, 0.866}, .p = {-0.866 + 0.004 * k, 0.5}};
    const auto reference = solve(restricted, start, 40.0, 1e-12);
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      const auto orbit = solve(restricted, start, 40.0, tolerance, {.order = 16, .monitor = "fixed"});
      if (!orbit.kept() || !reference.kept()) continue;
      EXPECT_LE((orbit.state.q - reference.state.q).norm(), 20.0 * tolerance) << k << " " << orbit.report();
    }
  }
}

constexpr int masses = 32;
/// A ring of masses with springs of the kind of Fermi, Pasta, Ulam and Tsingou.
const auto ring = [](const auto& q, const auto& p) {
  auto energy = 0.5 * p[0] * p[0];
  for (int i = 1; i < masses; ++i)
    energy += 0.5 * p[i] * p[i];
  for (int i = 0; i < masses; ++i) {
    const auto gap = q[(i + 1) % masses] - q[i];
    energy += 0.5 * gap * gap + 0.25 * gap * gap * gap * gap;
  }
  return energy;
};

State<avi::dynamic> wave(double phase) {
  State<avi::dynamic> z{.q = avi::VectorX::Zero(masses), .p = avi::VectorX::Zero(masses)};
  for (int i = 0; i < masses; ++i)
    z.q[i] = std::sin(2.0 * M_PI * (i + 1) / masses + phase);
  return z;
}

// Two masses stay where they are but for rounding, which is no error of theirs.
TEST(SolveErrors, OfTheNodesOfAVibrationAreRounding) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const auto node = kept(solve(ring, wave(0.0), 100.0, tolerance));
    const auto none = kept(solve(ring, wave(0.1), 100.0, tolerance));
    EXPECT_LT(node.run.steps, 10 * none.run.steps);
    EXPECT_LT(std::abs(node.state.q[15]), 1e-13);
  }
}

}  // namespace solve_errors_test
