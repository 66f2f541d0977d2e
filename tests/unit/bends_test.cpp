#include "avi/solve.hpp"
#include "kept.hpp"
#include "src/features/bends.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

// Places where H bends within a short length, and the orbits past them.

namespace bends_test {

using avi::State, avi::VectorX, avi::detail::Bends, avi::detail::PointField, avi::detail::Sketch;

template <class H>
std::size_t number_of_bends(const H& hamiltonian) {
  const avi::Formula h = avi::Formula::of_phase(hamiltonian, 2);
  return Bends(h.graph(), h.node(), false).size();
}

TEST(Bends, AreReadFromTheFormula) {
  const auto sum = [](const auto& q, const auto& p) { return p[0] * p[0] + p[1] + q[0] * q[1] * sin(q[1]); };
  EXPECT_EQ(number_of_bends(sum), 0u);
  const auto roots = [](const auto& q, const auto& p) {
    return sqrt(1.0 + p[0] * p[0]) + pow(q[1] * q[1] + 0.1, 1.5);
  };
  EXPECT_EQ(number_of_bends(roots), 2u);
  const auto steps = [](const auto& q, const auto& p) {
    return p[0] * p[1] + tanh(q[0]) + exp(-q[1] * q[1]);
  };
  EXPECT_EQ(number_of_bends(steps), 2u);
  // A distance that H divides by is a pole, also where its root is taken elsewhere; unless it never vanishes.
  const auto pole = [](const auto& q, const auto& p) {
    const auto r = sqrt(q[0] * q[0] + q[1] * q[1]);
    return p[0] * p[1] - 1.0 / r + r;
  };
  EXPECT_EQ(number_of_bends(pole), 0u);
  const auto bump = [](const auto& q, const auto& p) { return p[0] * p[1] + 0.1 / (0.1 + q[0] * q[0]); };
  EXPECT_EQ(number_of_bends(bump), 1u);
  // What may vanish is none: H is singular there.
  const auto singular = [](const auto& q, const auto& p) { return p[0] * p[1] + sqrt(q[0]); };
  EXPECT_EQ(number_of_bends(singular), 0u);
  // What is made of a step has its bend.
  const auto logistic = [](const auto& q, const auto& p) { return p[0] * p[1] + 1.0 / (1.0 + exp(q[0])); };
  EXPECT_EQ(number_of_bends(logistic), 1u);
}

/// The time in which the length s of sqrt(width^2 + q^2) changes by itself.
TEST(Bends, AreAsFarAsTheirLengthAtItsSpeed) {
  constexpr double width = 0.01;
  const avi::Formula h = avi::Formula::of_phase<1>(
      [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] + sqrt(width * width + q[0] * q[0]); });
  PointField field(h.graph(), h.node(), {});
  VectorX z(2);
  z << 1.0, 0.0;
  const Sketch sketch(field, z, 50.0, field.metric(z));
  Bends bends(h.graph(), h.node(), false);
  bends.measure(sketch);
  ASSERT_TRUE(bends.matter());
  const double fastest = std::sqrt(2.0 * (std::hypot(1.0, width) - width));  // from rest at q = 1
  EXPECT_NEAR(bends.speeds()[0], fastest, 0.1 * fastest);
  EXPECT_NEAR(bends.time_to_nearest(z.data()) * bends.speeds()[0], std::hypot(1.0, width), 1e-14);
  z << 1e-3, 1.4;
  EXPECT_NEAR(bends.time_to_nearest(z.data()) * bends.speeds()[0], std::hypot(1e-3, width), 1e-15);
}

/// Sweeps of a call that keeps a tolerance of 1e-7, the error of its end beside that of a tight one.
struct Told {
  long sweeps;
  double error;
};
template <class H>
Told solved(const H& h, const State<1>& start, double t_end) {
  const auto orbit = kept(avi::solve(h, start, t_end, 1e-7)),
             tight = kept(avi::solve(h, start, t_end, 1e-10));
  return {orbit.run.evaluations + orbit.choice.sweeps + orbit.choice.check,
          std::hypot(orbit.state.q[0] - tight.state.q[0], orbit.state.p[0] - tight.state.p[0])};
}

// From a width of 1e-2 to one of 1e-6, fixed steps become ten thousand times as many.
TEST(Bends, AreFollowedAtTheCostOfALogarithm) {
  const State<1> start{.q = {1.0}, .p = {0.3}};
  for (const double width : {1e-2, 1e-4, 1e-6}) {
    const auto by_q = [=](const auto& q, const auto& p) {
      return 0.5 * p[0] * p[0] + sqrt(width * width + q[0] * q[0]);
    };
    const auto by_p = [=](const auto& q, const auto& p) {
      return 0.5 * q[0] * q[0] + sqrt(width * width + p[0] * p[0]);
    };
    const auto step = [=](const auto& q, const auto& p) {
      return 0.5 * (p[0] * p[0] + q[0] * q[0]) + 0.1 * tanh((q[0] - 0.2) / width);
    };
    const auto bump = [=](const auto& q, const auto& p) {
      const auto x = (q[0] - 0.2) / width;
      return 0.5 * (p[0] * p[0] + q[0] * q[0]) + 0.1 / (1.0 + x * x);
    };
    const auto expect = [&](const Told& told) {
      EXPECT_LT(told.sweeps, 30'000) << width;
      EXPECT_LT(told.error, 1e-6) << width;  // ten tolerances
    };
    expect(solved(by_q, start, 50.0));
    expect(solved(by_p, start, 50.0));
    expect(solved(step, start, 50.0));
    expect(solved(bump, start, 50.0));
  }
}

// A free particle has no frequency; it is seen from afar all the same. A wall turns it, a step brakes it.
TEST(Bends, AreSeenByWhatMovesFreely) {
  const State<1> start{.q = {0.0}, .p = {1.0}};
  for (const double width : {1e-2, 1e-4}) {
    const auto wall = [=](const auto& q, const auto& p) {
      return 0.5 * p[0] * p[0] + exp((q[0] - 100.0) / width);
    };
    const auto step = [=](const auto& q, const auto& p) {
      return 0.5 * p[0] * p[0] + 0.2 * tanh((q[0] - 100.0) / width);
    };
    const Told turned = solved(wall, start, 300.0), braked = solved(step, start, 300.0);
    EXPECT_LT(turned.sweeps, 3100) << width;
    EXPECT_LT(braked.sweeps, 3100) << width;
    EXPECT_LT(std::max(turned.error, braked.error), 6e-9) << width;
  }
}

// A sketch of the beginning does not come as far as to what happens at a time.
TEST(Bends, InTimeAreSeenFromAfar) {
  const State<1> start{.q = {1.0}, .p = {0.0}};
  for (const double width : {1e-2, 1e-4}) {
    const auto step = [=](const auto& q, const auto& t, const auto& p) {
      return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] * (1.3 + 0.3 * tanh((t - 200.3) / width));
    };
    const Told told = solved(step, start, 300.0);
    EXPECT_LT(told.sweeps, 15'000) << width;
    EXPECT_LT(told.error, 1e-6) << width;
  }
  // Momenta fall as the scale factor t^(2/3) grows: the rate of change at the beginning is a million times
  // that at the end.
  const auto expanding = [](const auto& q, const auto& t, const auto& p) {
    const auto a = pow(t, 2.0 / 3.0), volume = a * a * a;
    return 0.5 * (p[0] * p[0] / volume + q[0] * q[0] * volume);
  };
  State<1> early = start;
  early.t = 1e-3;
  const double c = std::cos(1e-3), s = std::sin(1e-3), end = 300.0;
  const auto orbit = kept(avi::solve(expanding, early, end, 1e-9));
  // sin(t) / t and cos(t) / t solve q'' + 2 q'/t + q = 0; their sum with q(1e-3) = 1 and q' = 0:
  const double t0 = 1e-3, a = s / t0, b = c / t0, da = (c * t0 - s) / (t0 * t0),
               db = (-s * t0 - c) / (t0 * t0), det = a * db - b * da, first = db / det, second = -da / det;
  EXPECT_NEAR(orbit.state.q[0], (first * std::sin(end) + second * std::cos(end)) / end, 1e-9);
  EXPECT_LT(orbit.run.evaluations, 4500);
}

// Smooth where a divisor vanishes, at rest until a push, or bent within less than the digits of q: these
// calls ended by a bound, or with an error that was not known. The first one crashed.
TEST(Bends, ThatCannotBeFollowedAreLeftOut) {
  const auto stuck = [](const auto& q, const auto& t, const auto& p) {
    const auto x = (t - 5.0) / 0.01;
    return 0.5 * p[0] * p[0] + pow(q[0], 1.5) + 1e-3 * q[0] / (1.0 + x * x);
  };
  EXPECT_FALSE(avi::solve(stuck, State<1>{.q = {0.0}, .p = {-1.0}}, 10.0, 1e-6).ok());
  const auto price = [](const auto& h, const State<1>& start, double t_end, double tolerance) {
    const auto orbit = kept(avi::solve(h, start, t_end, tolerance, {.sweeps = 1'000'000}));
    return orbit.run.evaluations + orbit.choice.sweeps + orbit.choice.check;
  };
  const State<1> start{.q = {1.0}, .p = {0.0}};
  for (const double zero : {0.05, 5.0, 9.95}) {
    const auto smooth = [=](const auto& q, const auto& t, const auto& p) {
      return 0.5 * (p[0] * p[0] + q[0] * q[0]) + 0.1 * q[0] * sin(t - zero) / (t - zero);
    };
    EXPECT_LT(price(smooth, start, 10.0, 1e-6), 170) << zero;
  }
  const auto pushed = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * (p[0] * p[0] + q[0] * q[0]) - 0.5 * q[0] * (1.0 + tanh((t - 50.0) / 0.05));
  };
  EXPECT_LT(price(pushed, State<1>{.q = {0.0}, .p = {0.0}}, 60.0, 1e-8), 110'000);
  const auto thin = [](const auto& q, const auto& p) {
    return 0.5 * p[0] * p[0] + 0.5 * q[0] * q[0] + 0.1 * sqrt(q[0] * q[0] + 1e-300);
  };
  EXPECT_TRUE(avi::solve(thin, start, 10.0, 1e-3, {.sweeps = 1'000'000}).ok());
}

// A relativistic oscillator turns within a thousandth of its period.
TEST(Bends, OfMomentaAreFollowed) {
  const auto h = [](const auto& q, const auto& p) { return sqrt(1.0 + p[0] * p[0]) + 0.5 * q[0] * q[0]; };
  const State<1> start{.q = {1000.0}, .p = {0.0}};
  const Told told = solved(h, start, 1e4);
  EXPECT_LT(told.sweeps, 13'000);
  EXPECT_LT(told.error, 7e-7);  // measured 3.5e-7, of ranges of 2e3 and 1e6
}

}  // namespace bends_test
