#include "avi/autodiff/formula.hpp"
#include "src/features/switches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace switches_test {

using avi::detail::Switches;

/// The switches of an H that is f(t), of one degree of freedom and time, from one time to another.
template <class F>
std::vector<Switches::Switch> all(const F& f, double from, double to) {
  const auto h =
      avi::Formula::of_phase([&](const auto& q, const auto& p) { return f(q[1]) * q[0] + p[1]; }, 2);
  const auto none = Switches::of(h.graph(), h.node(), from, to);
  std::vector<Switches::Switch> found;
  if (!none) return found;
  Switches switches = *none;
  double t = from;
  while (const auto next = switches.next(t, to)) {
    found.push_back(*next);
    t = next->after;
  }
  return found;
}

/// They hold these times, and nothing but rounding beside them.
void expect_at(const std::vector<Switches::Switch>& found, const std::vector<double>& times) {
  ASSERT_EQ(found.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double size = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(times[i]);
    EXPECT_NEAR(found[i].before, times[i], size);
    EXPECT_NEAR(found[i].after, times[i], size);
    EXPECT_NE(found[i].before, found[i].after);
  }
}

TEST(Switches, AreTheZerosOfWhatDependsOnTimeAlone) {
  std::vector<double> zeros;
  for (int k = 1; k <= 954; ++k)
    zeros.push_back(k * M_PI / 3.0);
  expect_at(all([](const auto& t) { return avi::select(sin(3.0 * t) < 0.0, 1.0, 2.0); }, 0.5, 999.1), zeros);
  expect_at(all([](const auto& t) { return abs(sin(3.0 * t)); }, 0.5, 999.1), zeros);
  expect_at(all([](const auto& t) { return max(sin(3.0 * t), 0.0 * t); }, 0.5, 999.1), zeros);
  std::ranges::reverse(zeros);
  expect_at(all([](const auto& t) { return avi::select(sin(3.0 * t) <= 0.0, 1.0, 2.0); }, 999.1, 0.5), zeros);
}

TEST(Switches, AreNotWhatDependsOnTheStateToo) {
  const auto h = avi::Formula::of_phase(
      [](const auto& q, const auto& p) { return avi::select(q[0] < sin(q[1]), 1.0, 2.0) + abs(q[0]) + p[1]; },
      2);
  EXPECT_EQ(Switches::of(h.graph(), h.node(), 0.0, 10.0), nullptr);
  const auto smooth =
      avi::Formula::of_phase([](const auto& q, const auto& p) { return q[0] * sin(q[1]) + p[1]; }, 2);
  EXPECT_EQ(Switches::of(smooth.graph(), smooth.node(), 0.0, 10.0), nullptr);
}

// On one side of a comparison with its bound, exactly.
TEST(Switches, EndOnBothSidesOfABound) {
  const auto below = [](const auto& t) { return avi::select(t < 5.0, 1.0, 2.0); };
  const auto up_to = [](const auto& t) { return avi::select(t <= 5.0, 1.0, 2.0); };
  for (const double sense : {1.0, -1.0}) {
    const double from = 5.0 - 5.0 * sense, to = 5.0 + 5.0 * sense;
    const auto first = all(below, from, to), second = all(up_to, from, to);
    ASSERT_EQ(first.size(), 1u);
    ASSERT_EQ(second.size(), 1u);
    EXPECT_EQ(first[0].before<5.0, sense> 0.0);
    EXPECT_EQ(first[0].after < 5.0, sense < 0.0);
    EXPECT_EQ(second[0].before <= 5.0, sense > 0.0);
    EXPECT_EQ(second[0].after <= 5.0, sense < 0.0);
  }
}

// Pulses that are on for a thousandth of their period, by a comparison with what hardly gets there.
TEST(Switches, AreFoundWhereTheyAreNear) {
  const double half = 0.001 * M_PI, level = std::cos(half);
  std::vector<double> times;
  for (int k = 1; k <= 159; ++k) {
    times.push_back(2.0 * M_PI * k - half);
    times.push_back(2.0 * M_PI * k + half);
  }
  const auto found = all([&](const auto& t) { return avi::select(cos(t) < level, 0.0, 1.0); }, 1.0, 1000.0);
  ASSERT_EQ(found.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i)  // cos() is flat there: the bound is not known better
    EXPECT_NEAR(found[i].before, times[i], 1e-13 * (1.0 + times[i]) / half);
}

// Of what nothing is seen from where it is flat, four zeros near each other, and zeros at round numbers.
TEST(Switches, AreFoundWhereverTheyAre) {
  const double half = 0.1 * std::sqrt(std::log(2.0));
  const auto bell = [](const auto& t) {
    const auto x = (t - 570.0) / 0.1;
    return avi::select(exp(-(x * x)) > 0.5, 1.0, 0.0);
  };
  expect_at(all(bell, 0.0, 1000.0), {570.0 - half, 570.0 + half});
  const auto pair = [](const auto& t) {
    return avi::select((t - 24.1) * (t - 24.13) * (t - 24.6) * (t - 24.63) < 0.0, 1.0, 0.0);
  };
  const auto found = all(pair, 0.0, 50.0);
  ASSERT_EQ(found.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)  // as good as the product is there
    EXPECT_NEAR(found[i].before, std::vector<double>({24.1, 24.13, 24.6, 24.63})[i], 1e-13);
  const auto round = [](const auto& t) { return avi::select(abs(t - 50.25) < 0.25, 1.0, 0.0); };
  expect_at(all(round, 0.0, 100.0), {50.0, 50.25, 50.5});
  const auto window = [](const auto& t) {
    auto s = t - 0.0;
    for (int k = 1; k <= 25; ++k)
      s = s - avi::select(t < 4.0 * k, 0.0, 4.0);
    return avi::select(s < 0.5, 1.0, 0.0);
  };
  std::vector<double> times;
  for (int k = 0; k < 25; ++k)
    times.insert(times.end(), {4.0 * k + 0.5, 4.0 * k + 4.0});
  times.pop_back();
  expect_at(all(window, 0.1, 99.9), times);
}

// A ramp that begins anew, and a staircase that goes up and down: near its top a step is as long as it is not
// high.
TEST(Switches, AreWhereAFloorChanges) {
  std::vector<double> times;
  for (int k = 2; k <= 141; ++k)
    times.push_back(0.7 * k);
  const auto ramp = [](const auto& t) { return t - 0.7 * floor(t / 0.7); };
  expect_at(all(ramp, 0.75, 99.0), times);
  std::ranges::reverse(times);
  expect_at(all(ramp, 99.0, 0.75), times);
  times.clear();
  const double height = 2.000001;
  for (int k = 0; k < 20; ++k)
    for (const double level : {0.0, 1.0, 2.0}) {
      const double angle = std::asin(level / height);
      times.push_back(2.0 * M_PI * k + angle);
      times.push_back((2.0 * k + 1.0) * M_PI - angle);
      if (level > 0.0) {
        times.push_back((2.0 * k + 1.0) * M_PI + angle);
        times.push_back((2.0 * k + 2.0) * M_PI - angle);
      }
    }
  std::ranges::sort(times);
  times.erase(times.begin());  // the start
  const auto found = all([&](const auto& t) { return floor(height * sin(t)); }, 1e-3, 40.0 * M_PI - 1e-3);
  ASSERT_EQ(found.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(found[i].before, times[i], 1e-11);
}

TEST(Switches, OfTwoComparisonsAtOneTimeAreOne) {
  const auto found = all(
      [](const auto& t) {
        return avi::select(sin(t) < 0.0, 1.0, 2.0) + avi::select(0.0 <= sin(t), 3.0, 4.0) + abs(sin(t));
      },
      1.0, 100.0);
  ASSERT_EQ(found.size(), 31u);
}

// H falls by what it is less behind the switch.
TEST(Switches, TellByHowMuchHFalls) {
  const auto h = avi::Formula::of_phase(
      [](const auto& q, const auto& p) { return avi::select(q[1] < 5.0, 1.0, 3.5) * q[0] + p[0] + p[1]; }, 2);
  Switches switches = *Switches::of(h.graph(), h.node(), 0.0, 10.0);
  const auto next = switches.next(0.0, 10.0);
  ASSERT_TRUE(next);
  const double q[] = {2.0, 5.0}, p[] = {1.0, 7.0};
  EXPECT_EQ(switches.fall(q, p, *next), -5.0);
  EXPECT_FALSE(switches.next(0.0, 4.9));
  EXPECT_FALSE(switches.next(5.1, 10.0));
  EXPECT_TRUE(switches.next(next->before, next->before));
}

}  // namespace switches_test
