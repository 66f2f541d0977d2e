#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/problems/n_body.hpp"
#include "avi/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace solve_way_test {

using avi::SolutionReport;
using avi::solve;
using avi::State;

State<1> at(double q, double p) { return {.q = {q}, .p = {p}}; }

/// Masses between walls, joined by springs of which each is harder than the one before.
struct Row {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    auto sum = 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0];
    for (Eigen::Index i = 1; i < q.size(); ++i) {
      const auto x = q[i] - q[i - 1];
      sum += 0.5 * p[i] * p[i] + (0.5 + 0.1 * static_cast<double>(i)) * x * x;
    }
    return sum;
  }
};

/// An orbit at a tolerance.
using Orbit = std::function<SolutionReport(double)>;
template <class H, int n>
Orbit orbit(const H& hamiltonian, const State<n>& start, double end, const avi::SolveOptions& options = {}) {
  return [=](double tolerance) { return solve(hamiltonian, start, end, tolerance, options); };
}

const auto spring = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0] + q[0] * q[0]); };
const auto well = [](const auto& q, const auto& p) {
  return 0.5 * p[0] * p[0] - 0.5 * q[0] * q[0] + 0.25 * q[0] * q[0] * q[0] * q[0];
};
const auto stiff = [](const auto& q, const auto& p) {
  const auto x = q[0] - q[1];
  return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * q[0] * q[0] + 1250.0 * q[1] * q[1] + 0.25 * x * x * x * x;
};
const auto fall = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - 1.0 / q[0]; };
const auto turning = [](const auto& q, const auto& p) {
  return 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / sqrt(q[0] * q[0] + q[1] * q[1]) -
         0.3 * (q[0] * p[1] - q[1] * p[0]);
};
const auto centres = [](const auto& q, const auto& p) {
  const auto x = q[0] - 1.0, y = q[0] + 1.0;
  return 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / sqrt(x * x + q[1] * q[1]) -
         0.5 / sqrt(y * y + q[1] * q[1]);
};
const auto driven = [](const auto& q, const auto& t, const auto& p) {
  return 0.5 * p[0] * p[0] + 0.25 * q[0] * q[0] * q[0] * q[0] + q[0] / (1.0 + t * t);
};
const auto bump = [](const auto& q, const auto& p) {
  const auto x = (q[0] - 0.5) * 50.0;
  return 0.5 * (p[0] * p[0] + q[0] * q[0]) + 0.05 / (1.0 + x * x);
};
const auto sphere = [](const auto& q) { return 1.0 / (1.0 + q.squaredNorm()); };
const auto plane = [](const auto& q, const auto&) { return q[0]; };

/// What was chosen, and what it cost.
struct Way {
  std::string monitor;
  int order;
  std::size_t trials;
  long steps, sweeps;
  bool operator==(const Way&) const = default;
};
/// As it stands in the table below.
void PrintTo(const Way& way, std::ostream* out) {
  *out << "{\"" << way.monitor << "\", " << way.order << ", " << way.trials << ", " << way.steps << ", "
       << way.sweeps << "}";
}

Way way_of(const SolutionReport& found) {
  const avi::Choice& choice = found.choice;
  return {choice.name, choice.order, choice.trials.size(), found.run.steps,
          found.run.evaluations + choice.sweeps + choice.check};
}

// How many runs are tried, and what they cost, depends on every rule and number of the choice. Runs have the
// same bits whatever the library is built for.
TEST(SolveWay, IsTheSameOnEveryMachine) {
  struct Case {
    const char* name;
    Orbit orbit;
    std::vector<Way> ways;  // at 1e-4, 1e-7 and 1e-11
  };
  const State<avi::dynamic> row{.q = avi::VectorX::LinSpaced(12, -1.0, 1.0), .p = avi::VectorX::Zero(12)};
  const std::vector<Case> cases{
      {"spring",
       orbit(spring, at(1.0, 0.5), 100.0),
       {{"fixed", 16, 1, 46, 741}, {"fixed", 16, 1, 51, 899}, {"fixed", 16, 1, 89, 1381}}},
      {"few radians",
       orbit(spring, at(1.0, 0.5), 5.0),
       {{"fixed", 8, 1, 4, 68}, {"fixed", 16, 1, 4, 60}, {"fixed", 16, 1, 4, 75}}},
      {"at rest",
       orbit(spring, at(0.0, 0.0), 10.0),
       {{"fixed", 8, 1, 4, 18}, {"splitting", 6, 1, 4, 126}, {"splitting", 6, 1, 4, 126}}},
      {"well",
       orbit(well, at(0.1, 0.0), 300.0),
       {{"fixed", 16, 1, 295, 4194}, {"fixed", 16, 2, 444, 6945}, {"fixed", 16, 1, 627, 8402}}},
      {"stiff",
       orbit(stiff, State<2>{.q = {1.0, 0.02}, .p = {0.0, 0.0}}, 60.0),
       {{"fixed", 16, 1, 1361, 24933}, {"fixed", 16, 3, 1211, 31937}, {"fixed", 16, 5, 2005, 41288}}},
      {"round",
       orbit(avi::Kepler(), avi::Kepler::pericentre(0.1), 1000.0),
       {{"fixed", 16, 3, 548, 11984}, {"fixed", 16, 3, 708, 14898}, {"fixed", 16, 3, 1258, 22835}}},
      {"eccentric",
       orbit(avi::Kepler(), avi::Kepler::pericentre(0.9), -200.0),
       {{"energy^1.5", 16, 4, 135, 3067},
        {"energy^1.5", 16, 2, 221, 3955},
        {"energy^1.5", 16, 2, 393, 6346}}},
      {"near",
       orbit(avi::Kepler(), avi::Kepler::pericentre(0.999), 30.0),
       {{"energy^1.5", 16, 4, 105, 1498},
        {"energy^1.5", 16, 4, 162, 2043},
        {"energy^1.5", 16, 4, 329, 3540}}},
      {"unchecked",
       orbit(avi::Kepler(), avi::Kepler::pericentre(0.5), 3000.0, {.check = false}),
       {{"energy^1.5", 16, 3, 1399, 16702},
        {"energy^1.5", 16, 3, 2128, 20883},
        {"energy^1.5", 16, 3, 3783, 35511}}},
      {"given",
       orbit(avi::Kepler(), avi::Kepler::pericentre(0.5), 50.0, {.monitor = sphere}),
       {{"given", 16, 2, 154, 2710}, {"given", 16, 2, 254, 3670}, {"given", 16, 2, 514, 6585}}},
      {"event",
       orbit(avi::Kepler(), avi::Kepler::pericentre(0.5), 1e4,
             {.events = {avi::when(plane, {.count = 5, .stop = true})}}),
       {{"energy^1.5", 8, 1, 11, 904}, {"energy^1.5", 16, 1, 8, 789}, {"energy^1.5", 16, 1, 13, 915}}},
      {"turning",
       orbit(turning, State<2>{.q = {0.2, 0.0}, .p = {0.0, 3.0}}, 60.0),
       {{"poles", 16, 3, 60, 2484}, {"poles", 16, 2, 62, 1684}, {"poles", 16, 2, 116, 2569}}},
      {"centres",
       orbit(centres, State<2>{.q = {0.3, 0.8}, .p = {0.4, 0.0}}, 40.0),
       {{"energy^1.5", 16, 1, 105, 1463},
        {"energy^1.5", 16, 1, 142, 1995},
        {"energy^1.5", 16, 1, 252, 3468}}},
      {"chaos",
       orbit(avi::HenonHeiles(), avi::HenonHeiles::on_section(0.16, 0.1, 0.1), 300.0),
       {{"fixed", 16, 6, 459, 9587}, {"fixed", 16, 2, 609, 10282}, {"fixed", 16, 2, 463, 7691}}},
      {"eight",
       orbit(avi::FigureEight::problem(), avi::FigureEight::start(), 20.0),
       {{"splitting", 6, 1, 124, 3178}, {"fixed", 16, 1, 53, 782}, {"fixed", 16, 1, 94, 1271}}},
      {"row",
       orbit(Row(), row, 200.0),
       {{"splitting", 6, 2, 480, 12344}, {"fixed", 16, 2, 258, 7195}, {"fixed", 16, 1, 315, 7734}}},
      {"driven",
       orbit(driven, at(1.0, 0.0), 60.0),
       {{"fixed", 16, 1, 85, 1114}, {"fixed", 16, 1, 94, 1430}, {"fixed", 16, 1, 166, 2257}}},
      {"bump",
       orbit(bump, at(1.0, 0.0), 40.0),
       {{"poles", 8, 2, 192, 6011}, {"poles", 16, 1, 85, 3067}, {"poles", 16, 2, 190, 6405}}},
      {"collision",
       orbit(fall, at(1.0, 0.0), 5.0),
       {{"energy^1.5", 16, 2, 0, 248}, {"energy^1.5", 16, 2, 0, 322}, {"energy^1.5", 16, 2, 0, 454}}},
  };
  const double tolerances[]{1e-4, 1e-7, 1e-11};
  for (const Case& it : cases)
    for (std::size_t k = 0; k < 3; ++k) {
      const SolutionReport found = it.orbit(tolerances[k]);
      EXPECT_EQ(way_of(found), it.ways[k]) << it.name << " at " << tolerances[k];
    }
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
TEST(SolveWay, IsTheSameInOtherUnits) {
  expect_same_in_other_units("spring", spring, at(1.0, 0.5), 100.0);
  expect_same_in_other_units("well", well, at(0.1, 0.0), 300.0);
  expect_same_in_other_units("stiff", stiff, State<2>{.q = {1.0, 0.02}, .p = {0.0, 0.0}}, 60.0);
  expect_same_in_other_units("eccentric", avi::Kepler(), avi::Kepler::pericentre(0.9), 200.0);
  expect_same_in_other_units("turning", turning, State<2>{.q = {0.2, 0.0}, .p = {0.0, 3.0}}, 60.0);
  expect_same_in_other_units("centres", centres, State<2>{.q = {0.3, 0.8}, .p = {0.4, 0.0}}, 40.0);
  State<avi::dynamic> wave{.q = avi::VectorX::Zero(8), .p = avi::VectorX::Zero(8)};
  for (int i = 0; i < 8; ++i)
    wave.q[i] = std::sin(M_PI / 4.0 * (i + 1));
  expect_same_in_other_units("ring", ring, wave, 1000.0);
}

}  // namespace solve_way_test
