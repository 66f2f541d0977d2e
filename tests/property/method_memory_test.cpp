#include "avi/avi.hpp"
#include "systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

// What a method keeps of its last step serves the next one of the same orbit. From any other state a used
// method has to do what a new one does.
namespace method_memory_test {

using avi::State, systems::kepler, systems::spring;

/// A step from z by a method with a past and by a new one: largest difference of the ends.
template <class Used, class Fresh, class Z>
double apart(Used& used, Fresh fresh, Z& z, double h) {
  Z other = z;
  EXPECT_TRUE(used.step(z, h).ok());
  EXPECT_TRUE(fresh.step(other, h).ok());
  return std::max((z.q - other.q).cwiseAbs().maxCoeff(), (z.p - other.p).cwiseAbs().maxCoeff());
}

// The matrix of a start a million times as stiff shrank all changes: 31 steps were taken for solved.
TEST(MethodMemory, HasNoMatrixOfAnotherOrbit) {
  const auto clamp = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) + 0.5 * exp(q[1]) * q[0] * q[0];
  };
  for (const int order : {4, 8, 16}) {
    State<2> stiff{.q = {1e-14, 45.0}, .p = {0.0, 0.0}}, z{.q = {1.0, 0.0}, .p = {0.0, 0.0}};
    const auto fresh = [&] { return avi::collocation(avi::poincare(clamp, z), order); };
    auto used = fresh();
    ASSERT_TRUE(used.step(stiff, 0.01).ok());
    for (int k = 0; k < 40; ++k)
      EXPECT_LT(apart(used, fresh(), z, 0.01), 1e-14) << order << ", step " << k;
  }
}

// Where Newton's method had failed once it was not tried again, from whatever state.
TEST(MethodMemory, TriesNewtonsMethodAnewElsewhere) {
  const auto stiff = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + 1e6 * q[0] * q[0]) + 1e-3 * log(q[1]);
  };
  State<2> z{.q = {1e-3, 1.0}, .p = {0.1, 0.0}}, hopeless = z;
  hopeless.q[1] = 0.0;
  const auto fresh = [&] { return avi::collocation(avi::poincare(stiff, z), 8); };
  auto used = fresh();
  ASSERT_FALSE(used.step(hopeless, 0.01).ok());
  EXPECT_LT(apart(used, fresh(), z, 0.01), 1e-13);
}

// Steps that are begun ahead were looked at in the scales of an orbit a billion times as large, or in none.
TEST(MethodMemory, HasNoScalesOfAnotherOrbit) {
  for (const int order : {2, 4, 8, 16}) {
    State<1> large{.q = {1e12}, .p = {0.0}}, z{.q = {1.0}, .p = {0.0}};
    const auto fresh = [&] { return avi::collocation(avi::poincare(spring, z), order); };
    auto used = fresh();
    for (int k = 0; k < 5; ++k)
      ASSERT_TRUE(used.step(large, 0.1).ok());
    for (int k = 0; k < 5; ++k)
      EXPECT_LT(apart(used, fresh(), z, 0.1), 1e-14) << order << ", step " << k;
  }
  State<2> z{.q = {1.0, 0.0}, .p = {0.0, 1.0}};
  auto to_and_fro = avi::collocation(avi::poincare(kepler, z), 2);
  for (const double h : {0.1, -0.1, -0.1, 0.1, 0.1})
    EXPECT_LT(apart(to_and_fro, avi::collocation(avi::poincare(kepler, z), 2), z, h), 1e-14) << h;
}

// A step of 1e-300 has no scale; after one that was too long a short one from the same start went along.
TEST(MethodMemory, ForgetsStepsOfAnotherSize) {
  for (const int order : {8, 16}) {
    State<1> z{.q = {0.0}, .p = {1.0}};
    const auto problem = avi::poincare(spring, z);
    auto used = avi::collocation(problem, order);
    ASSERT_TRUE(used.step(z, 1e-300).ok());
    EXPECT_LT(apart(used, avi::collocation(problem, order), z, 1.0), 1e-14) << order;
    for (const double h : {10.0, 20.0, 100.0}) {
      State<2> start{.q = {0.98006657784991635, 0.1986693281215571},
                     .p = {-0.19866933343437193, 0.98006657783949824}},
          far = start;
      const auto fresh = [&] {
        return avi::collocation(avi::poincare(kepler, start, avi::Energy{avi::Kepler{}, 0.5}), order);
      };
      auto method = fresh();
      (void)method.step(far, h);
      EXPECT_LT(apart(method, fresh(), start, 0.1), 1e-13) << order << ", " << h;
    }
  }
}

TEST(MethodMemory, OfHtviIsOfOneOrbit) {
  const auto henon = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) + q[0] * q[0] * q[1] -
           q[1] * q[1] * q[1] / 3.0 + 0.1 * q[0];
  };
  for (const double speed : {1e2, 1e4, 1e6}) {
    State<2> z{.q = {-0.004, 0.0}, .p = {-0.03, 0.0}}, fast = z;
    fast.p *= speed;
    auto used = avi::htvi<4>(avi::poincare(henon, z));
    (void)used.step(fast, 0.05);
    for (int k = 0; k < 4; ++k)
      EXPECT_LT(apart(used, avi::htvi<4>(avi::poincare(henon, z)), z, 0.05), 1e-13)
          << speed << ", step " << k;
  }
}

TEST(MethodMemory, OutlivesAGradientThatThrows) {
  const auto gradient = [](const avi::Vector<double, 1>& q) -> avi::Vector<double, 1> {
    if (q[0] > 5.0) throw std::domain_error("out of the table");
    return q;
  };
  State<1> z{.q = {1.0}, .p = {0.0}}, other{.q = {4.9}, .p = {9.0}};
  auto used = avi::stormer_verlet<1>(gradient);
  ASSERT_TRUE(used.step(z, 0.1).ok());
  const State<1> before = other;
  EXPECT_THROW((void)used.step(other, 0.1), std::domain_error);
  EXPECT_EQ(other, before);
  EXPECT_EQ(apart(used, avi::stormer_verlet<1>(gradient), z, 0.1), 0.0);
}

template <int n, class Method>
void expect_to_outlive_a_move(Method method, const State<n>& start) {
  State<n> z = start, moved = start, other = start;
  ASSERT_TRUE(method.step(z, 0.1).ok());
  Method fresh = method, takes = std::move(method);
  z = moved = other;
  EXPECT_TRUE(fresh.step(other, 0.1).ok());
  EXPECT_TRUE(takes.step(z, 0.1).ok());
  EXPECT_TRUE(method.step(moved, 0.1).ok());  // NOLINT: after the move
  EXPECT_EQ(z, other);
  EXPECT_EQ(moved, other);
  if constexpr (std::is_move_assignable_v<Method>) {
    fresh = std::move(method);
    EXPECT_TRUE(fresh.step(z, 0.1).ok());
    EXPECT_TRUE(method.step(moved, 0.1).ok());  // NOLINT: after the move
    EXPECT_EQ(moved, z);
  }
}

TEST(MethodMemory, OutlivesAMove) {
  const State<1> start{.q = {1.0}, .p = {0.0}};
  const State<avi::dynamic> any{.q = {1.0}, .p = {0.0}};
  expect_to_outlive_a_move(avi::collocation(avi::poincare(spring, start), 8), start);
  expect_to_outlive_a_move(avi::collocation(avi::poincare(spring, any), 16), any);
  expect_to_outlive_a_move(avi::htvi<8>(avi::poincare(spring, start)), start);
  expect_to_outlive_a_move(avi::AnyMethod<1>(avi::htvi<4>(avi::poincare(spring, start))), start);
}

// A step of size 0 is none: the digits that a state cannot hold, and the polynomial of the last step, are
// kept.
TEST(MethodMemory, KeepsItOverAStepOfZero) {
  const State<2> start{.q = {0.4, 0.0}, .p = {0.0, 2.0}};
  const auto run = [&](auto method, bool pauses) {
    State<2> z = start;
    long evaluations = 0;
    for (int k = 0; k < 50; ++k) {
      evaluations += method.step(z, 0.05).evaluations;
      if (pauses) evaluations += method.step(z, 0.0).evaluations;
    }
    return std::pair(z, evaluations);
  };
  const auto problem = avi::poincare(kepler, start);
  for (const int order : {4, 16})
    EXPECT_EQ(run(avi::collocation(problem, order), true), run(avi::collocation(problem, order), false));
  EXPECT_EQ(run(avi::htvi<4>(problem), true), run(avi::htvi<4>(problem), false));
}

}  // namespace method_memory_test
