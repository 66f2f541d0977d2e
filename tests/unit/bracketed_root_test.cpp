#include "avi/core/bracketed_root.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bracketed_root_test {

TEST(BracketedRoot, FindsZerosToRoundOffInFewEvaluations) {
  const auto check = [](auto f, double low, double high, double root, int most) {
    int count = 0;
    const avi::Root found = avi::bracketed_root(
        [&](double at) {
          EXPECT_TRUE(at > low && at < high) << "outside the bracket";
          ++count;
          return f(at);
        },
        low, f(low), high, f(high), 0.0);
    EXPECT_NEAR(found.x, root, 4e-16 * std::max(1.0, std::abs(root)));
    EXPECT_EQ(found.evaluations, count);
    EXPECT_LE(count, most) << root;
  };
  check([](double x) { return std::exp(x) - 3.0; }, 0.0, 2.0, std::log(3.0), 12);   // measured 8
  check([](double x) { return x * x * x - 2.0; }, 0.0, 10.0, std::cbrt(2.0), 22);   // measured 11
  check([](double x) { return std::atan(50.0 * (x - 0.1)); }, -3.0, 4.0, 0.1, 30);  // measured 15
  check([](double x) { return 2.0 * x - 1.0; }, 0.0, 1.0, 0.5, 2);
}

TEST(BracketedRoot, EndsAtItsTolerance) {
  for (const double tolerance : {1e-2, 1e-6}) {
    int count = 0;
    const double x = avi::bracketed_root(
                         [&](double at) {
                           ++count;
                           return at * at - 2.0;
                         },
                         0.0, -2.0, 2.0, 2.0, tolerance)
                         .x;
    EXPECT_LE(std::abs(x * x - 2.0), tolerance);
    EXPECT_LE(count, tolerance == 1e-2 ? 4 : 7);
  }
}

// Where the side matters, f has to be within the tolerance on that side.
TEST(BracketedRoot, EndsAtItsToleranceOnTheSideThatIsAskedFor) {
  for (const double shift : {-0.4, -0.1, 0.2, 0.7, 1.3}) {
    const auto f = [&](double x) { return x * x * x + x - shift; };
    for (const double tolerance : {0.3, 1e-2, 1e-5}) {
      const auto find = [&](avi::Side side) {
        return avi::bracketed_root(f, -2.0, f(-2.0), 2.0, f(2.0), tolerance, side);
      };
      const avi::Root beyond = find(avi::Side::beyond), either = find(avi::Side::either),
                      exact = avi::bracketed_root(f, -2.0, f(-2.0), 2.0, f(2.0), 0.0);
      EXPECT_TRUE(beyond.met && beyond.value >= 0.0 && beyond.value <= tolerance)
          << shift << " " << tolerance;
      EXPECT_TRUE(either.met && std::abs(either.value) <= tolerance) << shift << " " << tolerance;
      EXPECT_LE(either.evaluations, beyond.evaluations);
      EXPECT_LT(beyond.evaluations, exact.evaluations);
    }
  }
}

TEST(BracketedRoot, EndsWhereFIsNoNumberAndAtAJump) {
  int count = 0;
  (void)avi::bracketed_root(
      [&](double) {
        ++count;
        return std::nan("");
      },
      0.0, -1.0, 1.0, 1.0, 0.0);
  EXPECT_EQ(count, 1);
  const double jump =
      avi::bracketed_root([](double x) { return x < 0.3 ? -1.0 : 1.0; }, 0.0, -1.0, 1.0, 1.0, 0.0).x;
  EXPECT_NEAR(jump, 0.3, 1e-15);
}

TEST(BracketedRoot, NeverGivesUp) {
  const auto count = [](auto f, double high, double root) {
    const avi::Root found = avi::bracketed_root(f, 0.0, f(0.0), high, f(high), 0.0, avi::Side::beyond);
    EXPECT_NEAR(found.x, root, 5e-16 * root);
    EXPECT_TRUE(found.met || found.closed);
    EXPECT_GE(found.value, 0.0);
    return found.evaluations;
  };
  EXPECT_LE(count([](double x) { return std::exp(80.0 * x) - std::exp(40.0); }, 1.4, 0.5), 30);
  EXPECT_LE(count([](double x) { return std::exp(700.0 * x) - std::exp(7.0); }, 1.0, 0.01), 44);
  EXPECT_LE(count([](double x) { return x - 1e-300; }, 1.0, 1e-300), 2);
  EXPECT_LE(count([](double x) { return x < 1e-300 ? -1.0 : 1.0; }, 1.0, 1e-300), 140);
  EXPECT_LE(count([](double x) { return std::cbrt(x - 0.3); }, 1.0, 0.3), 100);
  EXPECT_LE(count([](double x) { return std::pow(x, 21) - 1e-30; }, 1.0, std::pow(1e-30, 1.0 / 21)), 42);
  EXPECT_LE(count([](double x) { return 1.0 / (0.3 - x) > 0 ? -1.0 / (0.3 - x) : INFINITY; }, 1.0, 0.3), 108);
}

}  // namespace bracketed_root_test
