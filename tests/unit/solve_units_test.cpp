#include "avi/problems/kepler.hpp"
#include "avi/solve.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace solve_units_test {

using avi::SolutionReport, avi::solve, avi::State, systems::at;

const auto well = [](const auto& q, const auto& p) {
  return 0.5 * p[0] * p[0] - 0.5 * q[0] * q[0] + 0.25 * q[0] * q[0] * q[0] * q[0];
};
const auto stiff = [](const auto& q, const auto& p) {
  const auto x = q[0] - q[1];
  return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * q[0] * q[0] + 1250.0 * q[1] * q[1] + 0.25 * x * x * x * x;
};

/// What was chosen, and what it cost.
struct Way {
  std::string monitor;
  int order;
  std::size_t trials;
  long steps, sweeps;
  bool operator==(const Way&) const = default;
};
/// For messages.
void PrintTo(const Way& way, std::ostream* out) {
  *out << "{\"" << way.monitor << "\", " << way.order << ", " << way.trials << ", " << way.steps << ", "
       << way.sweeps << "}";
}

Way way_of(const SolutionReport& found) {
  const avi::Choice& choice = found.choice;
  return {choice.name, choice.order, choice.trials.size(), found.run.steps,
          found.run.evaluations + choice.sweeps + choice.check};
}

/// The way of an orbit in units of time and of length that are so many times as long.
template <class H, int n>
Way in_units(const H& hamiltonian, const State<n>& start, double end, double time, double length) {
  const auto other = [=](const auto& q, const auto& p) {
    std::decay_t<decltype(q)> there = q;
    std::decay_t<decltype(p)> moving = p;
    for (Eigen::Index i = 0; i < q.size(); ++i)
      there[i] = length * q[i], moving[i] = p[i] * (1.0 / length);
    return hamiltonian(there, moving) * time;
  };
  return way_of(solve(other, State<n>{.q = start.q / length, .p = start.p * length}, end / time, 1e-7));
}
template <class H, int n>
void expect_same_in_other_units(const char* name, const H& hamiltonian, const State<n>& start, double end) {
  const Way way = in_units(hamiltonian, start, end, 0x1p-4, 0x1p-5);
  for (const double unit : {0x1p-12, 0x1p12}) {
    EXPECT_EQ(in_units(hamiltonian, start, end, unit, 0x1p-5), way) << name << " in other units of time";
    EXPECT_EQ(in_units(hamiltonian, start, end, 0x1p-4, unit), way) << name << " in other units of length";
  }
}

/// A ring of eight masses, two of which rest but for rounding.
const auto ring = [](const auto& q, const auto& p) {
  auto sum = 0.5 * (p[0] * p[0] + (q[7] - q[0]) * (q[7] - q[0]));
  for (int i = 1; i < 8; ++i) {
    const auto gap = q[i] - q[i - 1];
    sum += 0.5 * (p[i] * p[i] + gap * gap) + 0.25 * gap * gap * gap * gap;
  }
  return sum;
};

// Powers of 4 leave all bits as they are, those of square roots too.
TEST(SolveUnits, ChangeNothing) {
  expect_same_in_other_units("spring", systems::spring, at(1.0, 0.5), 100.0);
  expect_same_in_other_units("well", well, at(0.1, 0.0), 300.0);
  expect_same_in_other_units("stiff", stiff, State<2>{.q = {1.0, 0.02}, .p = {0.0, 0.0}}, 60.0);
  expect_same_in_other_units("eccentric", avi::Kepler(), avi::Kepler::pericentre(0.9), 200.0);
  expect_same_in_other_units("turning", systems::turning_kepler(0.3),
                             State<2>{.q = {0.2, 0.0}, .p = {0.0, 3.0}}, 60.0);
  expect_same_in_other_units("centres", systems::two_centres, State<2>{.q = {0.3, 0.8}, .p = {0.4, 0.0}},
                             40.0);
  State<avi::dynamic> wave{.q = avi::VectorX::Zero(8), .p = avi::VectorX::Zero(8)};
  for (int i = 0; i < 8; ++i)
    wave.q[i] = std::sin(M_PI / 4.0 * (i + 1));
  expect_same_in_other_units("ring", ring, wave, 1000.0);
}

// Time is a coordinate there, with a unit of its own: at rest 27 steps, and 3 million where it is taken for a
// length.
TEST(SolveUnits, ChangeNothingOfABodyInADrive) {
  const auto way = [](double length, double time, double place) {
    const auto driven = [=](const auto& q, const auto& t, const auto& p) {
      return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] / (time * time) -
             0.3 * length / (time * time) * q[0] * cos(2.0 * t / time);
    };
    State<1> start = at(place * length, 0.2 * place * length / time);
    start.t = place == 0.0 ? 0.5 * time : 0.0;  // where the drive is 0, or largest
    const auto found = solve(driven, start, 20.0 * time, 1e-8, {.sweeps = 100'000});
    // The scale is a mean over all that was looked at before the runs.
    return std::pair{found.run.steps, found.choice.energy_scale * (time / length) * (time / length)};
  };
  for (const double place : {0.0, 1.0}) {
    const auto known = way(1.0, 1.0, place);
    EXPECT_LT(known.first, 60);
    for (const int power : {-60, 20, 40, 60, 80})
      EXPECT_EQ(way(std::ldexp(1.0, power), std::ldexp(1.0, -power / 2), place), known) << power;
  }
}

// Rounding of a distant coordinate kept shorter steps, as for output times, from being solved: a kept run
// failed once it was asked for them.
TEST(SolveUnits, ADistantOscillatorHasStatesOnTheWay) {
  const auto distant = [](const auto& q, const auto& p) {
    const auto x = q[0] - 1e8;
    return 0.5 * (p[0] * p[0] + x * x);
  };
  std::vector<double> times;
  for (int k = 0; k <= 3000; ++k)
    times.push_back(0.01 * k);
  for (const double tolerance : {1e-7, 1e-8}) {
    const auto orbit =
        avi::solve(distant, State<1>{.q = {1e8 + 1.0}, .p = {0.0}}, times, tolerance, {.dense = true});
    ASSERT_TRUE(orbit.ok()) << orbit.report();
    for (std::size_t k = 1; k < times.size(); ++k) {  // measured: at most 2.1e-8
      EXPECT_NEAR(orbit.states[k].q[0] - 1e8, std::cos(times[k]), 4.2e-8);
      EXPECT_NEAR(orbit(times[k] - 0.005).q[0] - 1e8, std::cos(times[k] - 0.005), 4.2e-8);
    }
  }
}

}  // namespace solve_units_test
