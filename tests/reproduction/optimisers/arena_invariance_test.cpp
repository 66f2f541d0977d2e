#include "optimisers/optimiser_arena/problems/problem.hpp"

#include "avi/optim/minimise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>

// What avi::minimise() does when the problems of the arena are scaled, shifted or made noisy.

using arena::Problem, avi::VectorX;

namespace arena_invariance_test {

std::vector<Problem> problems() {
  auto all = arena::all_problems(false, true);
  std::erase_if(all, [](const Problem& problem) { return problem.x0.size() > 1024; });
  return all;
}

avi::Minimisation run(const Problem& problem, int memory) {
  return avi::minimise(problem.f, problem.x0, {.memory = memory, .evaluations = 20'000});
}

/// `values` times f of `lengths` times x, from the start that is the same point.
Problem scaled(const Problem& problem, double values, double lengths) {
  Problem other = problem;
  other.x0 /= lengths;
  other.f = [f = problem.f, values, lengths](const VectorX& x, VectorX& g) {
    const double value = f(lengths * x, g);
    g *= values * lengths;
    return values * value;
  };
  return other;
}

TEST(ArenaInvariance, PowersOfTwoChangeNoBit) {
  // With powers of two nothing is rounded differently, so any difference would be a constant of the method
  // that has a unit. Only where x0 and f(x0) are both 0 nothing says how long the first trial should be.
  for (int memory : {0, 7})
    for (const Problem& problem : problems()) {
      if (problem.x0.size() > 60) continue;  // a constant with a unit shows in any dimension
      const auto plain = run(problem, memory);
      VectorX g(problem.x0.size());
      const bool unitless = problem.x0.isZero() && problem.f(problem.x0, g) == 0.0;
      for (const auto& [values, lengths] :
           {std::pair{0x1p27, 1.0}, {0x1p-27, 1.0}, {1.0, 0x1p20}, {1.0, 0x1p-20}}) {
        const auto other = run(scaled(problem, values, lengths), memory);
        EXPECT_TRUE(other.ok()) << problem.name << ": " << other.message;
        if (unitless && lengths != 1.0) {
          EXPECT_NEAR(static_cast<double>(other.gradient_evaluations),
                      static_cast<double>(plain.gradient_evaluations),
                      0.05 * static_cast<double>(plain.gradient_evaluations))
              << problem.name;  // measured 3 %
        } else {
          EXPECT_EQ(other.gradient_evaluations, plain.gradient_evaluations) << problem.name;
          EXPECT_EQ(VectorX(lengths * other.last.x), plain.last.x) << problem.name;
        }
      }
    }
}

TEST(ArenaInvariance, OtherScalesMoveCountsNoFurtherThanRounding) {
  // Scales like 1 + j 2^-45 change nothing but rounding: the counts under fifteen of them are the control. If
  // 1e8 and 1e-6 did no more, such a scale's count would lie outside the range of the control with a chance
  // of 2/16.
  for (int memory : {0, 7}) {
    int runs = 0, outside = 0;
    for (const Problem& problem : problems()) {
      if (problem.x0.size() > 60) continue;  // up to 200, m = 0 and 7: 9 and 7 of 268 outside
      const auto count = [&](double values, double lengths) {
        const auto result = run(scaled(problem, values, lengths), memory);
        EXPECT_TRUE(result.ok()) << problem.name << ": " << result.message;
        return result.gradient_evaluations;
      };
      std::vector<long> control;
      for (int j = 1; j <= 15; ++j)
        control.push_back(count(1.0 + j * 0x1p-45, 1.0 + (16 - j) * 0x1p-45));
      std::sort(control.begin(), control.end());
      for (const auto& [values, lengths] : {std::pair{1e8, 1.0}, {1e-8, 1.0}, {1.0, 1e6}, {1.0, 1e-6}}) {
        const long now = count(values, lengths);
        ++runs;
        outside += now < control.front() || now > control.back();
        if (now < control.front() || now > control.back())
          std::printf("m = %d, %s, f times %g, x by %g: %ld, control %ld to %ld\n", memory,
                      problem.name.c_str(), values, lengths, now, control.front(), control.back());
      }
    }
    std::printf("m = %d: %d of %d outside\n", memory, outside, runs);
    // the four scales of a problem share its control, so the variance is taken four times a binomial one
    EXPECT_LE(outside, 0.125 * runs + 2.33 * std::sqrt(4.0 * runs * 0.125 * 0.875));
  }
}

TEST(ArenaInvariance, NeitherOffsetNorNoiseNorAnotherStartMakesItFail) {
  for (int memory : {0, 7})
    for (const Problem& problem : problems()) {
      if (problem.group == "looked_at" && problem.x0.size() > 60)
        continue;  // held out ones are of these kinds
      VectorX unused(problem.x0.size());
      const double size = std::abs(problem.f(problem.x0, unused));
      const auto random = [state = std::make_shared<unsigned>(1u)] {
        return static_cast<double>(*state = *state * 1664525u + 1013904223u) * 0x1p-31 - 1.0;
      };
      const auto with = [&](const auto& change) {
        Problem other = problem;
        other.f = [f = problem.f, change](const VectorX& x, VectorX& g) {
          const double value = f(x, g);
          return change(value, g);
        };
        return other;
      };
      const auto start = [&](double factor) {
        Problem other = problem;
        other.x0 *= factor;
        return other;
      };
      const auto expect = [&](const std::string& what, const Problem& other) {
        // ten times gulf's start is its minimiser: there is nothing to do
        if (what == "ten times the start" && other.f(other.x0, unused) < 1e-20 * size) return;
        const auto result = run(other, memory);
        EXPECT_TRUE(result.ok()) << problem.name << ", m = " << memory << ", " << what << ": "
                                 << result.message;
      };
      expect("offset 1e4 |f_0|", with([=](double value, VectorX&) { return value + 1e4 * size; }));
      expect("noise 1e-12 in f", with([=](double value, VectorX&) {
               return value * (1.0 + 1e-12 * random()) + 1e-12 * size * random();
             }));
      expect("noise 1e-4 in the gradient", with([=](double value, VectorX& g) {
               for (double& entry : g)
                 entry *= 1.0 + 1e-4 * random();
               return value;
             }));
      expect("ten times the start", start(10.0));
      expect("a tenth of the start", start(0.1));
    }
}

}  // namespace arena_invariance_test
