#include "avi/optim/minimiser.hpp"

#include "common/problems/correlated_quartic.hpp"
#include "unit/objectives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

// Made of +, -, *, / and roots alone, objectives have the same bits on every machine, and so has the run.

using avi::Outcome, avi::VectorX, objectives::hinges, objectives::rosenbrock;

namespace minimiser_test {

using Function = std::function<double(const VectorX&, VectorX&)>;

/// The sum of f(x_i, i + 1, its derivative).
Function sum_of(double (*f)(double x, double weight, double& slope)) {
  return [f](const VectorX& x, VectorX& g) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      sum += f(x[i], static_cast<double>(i + 1), g[i]);
    return sum;
  };
}
/// Of degree 2, 3 and 4, with a well on either side of 0.
const Function wells = sum_of([](double x, double weight, double& slope) {
  const double w = x * x - 1.0;
  slope = weight * (w * x + 0.1);
  return weight * (0.25 * w * w + 0.1 * x);
});
/// Flat at its minimum, steep away from it.
const Function flat = sum_of([](double x, double weight, double& slope) {
  const double square = x * x;
  slope = 4.0 * weight * square * x;
  return weight * square * square;
});
/// Infinite for x <= 0.
const Function wall = sum_of([](double x, double weight, double& slope) {
  slope = weight - 1e-3 / (x * x);
  return x > 0.0 ? weight * x + 1e-3 / x : std::numeric_limits<double>::infinity();
});
/// The first derivative jumps.
const Function kinks = sum_of([](double x, double weight, double& slope) {
  const double from = x - 0.3 * weight;
  slope = from < 0.0 ? -weight : weight;
  return weight * std::abs(from);
});
/// sqrt(1 + x^2): the curvature falls to 0 far away.
const Function cone = sum_of([](double x, double weight, double& slope) {
  const double root = std::sqrt(1.0 + weight * x * x);
  slope = weight * x / root;
  return root;
});
double uphill(const VectorX& x, VectorX& g) {
  const double f = objectives::bowl(x, g);
  g = -g;
  return f;
}
double downhill(const VectorX& x, VectorX& g) {
  g.setOnes();
  return x[0] + x[1] + x[2];
}

/// f + 1e4, of which the last digits are lost.
Function raised(const Function& f) {
  return [f](const VectorX& x, VectorX& g) { return f(x, g) + 1e4; };
}
/// f(2^20 x).
Function small(const Function& f) {
  return [f](const VectorX& x, VectorX& g) {
    const double value = f(0x1p20 * x, g);
    g *= 0x1p20;
    return value;
  };
}
/// f with errors of 1e-9 in its value and of 1e-5 of its gradient.
Function noisy(const Function& f) {
  return [f, state = 1u](const VectorX& x, VectorX& g) mutable {
    const auto noise = [&] {
      return static_cast<double>(state = state * 1664525u + 1013904223u) * 0x1p-31 - 1.0;
    };
    const double value = f(x, g);
    for (double& entry : g)
      entry *= 1.0 + 1e-5 * noise();
    return value + 1e-9 * noise();
  };
}

// How many iterations and gradients a run takes depends on every rule and number of the method.
TEST(Minimiser, TakesTheSameWayOnEveryMachine) {
  struct Case {
    const char* name;
    Function f;
    VectorX x0;
    Outcome outcome;
    long counts[3][2];  // of iterations and gradients, with 0, 1 and 7 pairs
  };
  const experiment::CorrelatedQuartic quartic;
  const VectorX far_down = VectorX::Constant(10, -1.2);
  const std::vector<Case> cases{
      {"valley", rosenbrock, far_down, Outcome::ok, {{142, 180}, {200, 222}, {73, 92}}},
      {"quartic", quartic, quartic.start(), Outcome::ok, {{24, 25}, {23, 24}, {23, 24}}},
      {"wells", wells, VectorX::LinSpaced(7, -2.0, 3.0), Outcome::ok, {{20, 65}, {20, 22}, {16, 22}}},
      {"flat", flat, VectorX::LinSpaced(6, 1.0, 3.0), Outcome::ok, {{23, 24}, {22, 23}, {22, 23}}},
      {"wall", wall, VectorX::LinSpaced(3, 1.0, 5.0), Outcome::ok, {{41, 94}, {34, 87}, {19, 54}}},
      {"hinges", hinges, VectorX::LinSpaced(6, -5.0, 9.0), Outcome::ok, {{8, 44}, {11, 35}, {12, 55}}},
      {"kinks", kinks, VectorX::Ones(3), Outcome::no_descent, {{236, 772}, {301, 1729}, {210, 1820}}},
      {"cone", cone, VectorX::LinSpaced(5, 1.0, 100.0), Outcome::ok, {{21, 29}, {28, 39}, {19, 31}}},
      {"uphill", uphill, VectorX::Ones(3), Outcome::no_descent, {{0, 59}, {0, 59}, {0, 59}}},
      {"downhill", downhill, VectorX::Ones(3), Outcome::diverged, {{0, 500}, {0, 500}, {0, 500}}},
      {"raised", raised(rosenbrock), far_down, Outcome::ok, {{149, 238}, {137, 186}, {75, 93}}},
      {"small",
       small(rosenbrock),
       VectorX(0x1p-20 * far_down),
       Outcome::ok,
       {{142, 180}, {200, 222}, {73, 92}}},
      {"noisy", noisy(rosenbrock), far_down, Outcome::ok, {{185, 241}, {131, 183}, {80, 132}}},
      {"noisy bowl", noisy(objectives::bowl), VectorX::Ones(10), Outcome::ok, {{25, 68}, {14, 61}, {12, 60}}},
  };
  for (const Case& it : cases)
    for (int k = 0; k < 3; ++k) {
      const int memory = k == 0 ? 0 : k == 1 ? 1 : 7;
      const Function f = it.f;
      const auto run = avi::Minimiser(f, it.x0, {.relative = 1e-8, .memory = memory}).run();
      EXPECT_EQ(run.outcome, it.outcome) << it.name << " " << memory << ": " << run.message;
      EXPECT_EQ(run.iterations, it.counts[k][0]) << it.name << " " << memory;
      EXPECT_EQ(run.gradient_evaluations, it.counts[k][1]) << it.name << " " << memory;
    }
}

TEST(Minimiser, NamesAGradientThatLosesAnEntryOnTheWay) {
  for (const int at : {1, 2, 3}) {
    int calls = 0;
    const Function f = [&](const VectorX& x, VectorX& g) {
      const double value = objectives::bowl(x, g);
      if (++calls == at) g.resize(2);
      return value;
    };
    const auto run = avi::Minimiser(f, VectorX::Ones(5), {.evaluations = 50}).run();
    EXPECT_EQ(run.outcome, Outcome::wrong_gradient) << at << ": " << run.message;
    EXPECT_EQ(run.gradient_evaluations, at);
    EXPECT_EQ(run.last.gradient.size(), 5);
  }
}

TEST(Minimiser, RefusesToRunTwice) {
  avi::Minimiser once(wells, VectorX::Ones(2), {});
  EXPECT_TRUE(once.run().ok());
  EXPECT_THROW((void)once.run(), std::logic_error);
}

}  // namespace minimiser_test
