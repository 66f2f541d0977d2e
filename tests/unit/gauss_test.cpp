#include "avi/collocation/collocation.hpp"
#include "avi/transform/poincare.hpp"
#include "src/steps/builds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

using avi::dynamic, avi::Program, avi::State, avi::Vector, avi::VectorX, avi::detail::Formulas,
    avi::detail::Stepper;

namespace gauss_test {

/// Oscillators with quartic bonds in a row, any number of them, softer and heavier from one to the next.
const auto row = [](const auto& q, const auto& p) {
  auto sum = 0.5 * (p[0] * p[0]) + 0.5 * (q[0] * q[0]);
  for (Eigen::Index i = 1; i < q.size(); ++i) {
    const auto x = q[i] - q[i - 1];
    sum += 0.3 * (p[i] * p[i]) + 0.4 * (x * x) + 0.1 * ((x * x) * (x * x)) + 0.02 * (p[i - 1] * q[i]);
  }
  return sum;
};
/// A monitor of (q, p).
const auto lively = [](const auto& q, const auto& p) {
  using std::pow;
  return pow(1.0 + q[0] * q[0] + 0.5 * (p[0] * p[0]), -0.75);
};

/// None: g = 1.
const auto steady = [](const auto&, const auto&) { return 1.0; };

VectorX start(int n) {
  VectorX z(2 * n);
  for (int i = 0; i < 2 * n; ++i)
    z[i] = std::cos(1.7 * i) + 0.1 * i;
  return z;
}

/// \f$g (H + p^t)\f$ recorded in the order of Collocation's own recording.
template <class G>
std::shared_ptr<const Formulas> formulas(int n, const G& monitor) {
  avi::ExpressionGraph graph(2 * n);
  const auto q = avi::recorded_inputs(graph, 0, n), p = avi::recorded_inputs(graph, n, n);
  const VectorX z = start(n);
  const double pt = -row(VectorX(z.head(n)), VectorX(z.tail(n)));
  const avi::Recorded g = monitor(q, p);
  const int transformed = avi::Recorded(g * (row(q, p) + pt)).node_in(graph);
  return std::make_shared<const Formulas>(Formulas::of(graph, transformed, g.node_in(graph)));
}

/// Where the steps are.
struct Orbit {
  VectorX z;
  double t = 0.0;
  long sweeps = 0;
  [[nodiscard]] bool operator==(const Orbit&) const = default;
};
Orbit advance(Stepper& steps, Orbit run, double h, int count) {
  for (int i = 0; i < count; ++i) {
    const avi::StepReport report = steps.step(run.z.data(), run.t, h);
    EXPECT_TRUE(report.ok());
    run.sweeps += report.evaluations;
  }
  return run;
}

// With n at run time only, collocation records the same formulas and works them off in the same order.
TEST(Gauss, HasTheBitsOfCollocationByHand) {
  for (const int n : {5, 9})
    for (const int order : {2, 8, 10, 16}) {
      const VectorX z = start(n);
      State<dynamic> by_hand{.q = z.head(n), .p = z.tail(n)};
      auto method = avi::collocation(avi::poincare(row, by_hand, lively), order);
      const auto steps = avi::detail::gauss_steps(formulas(n, lively), order);
      Orbit run{z};
      for (int k = 0; k < 8; ++k) {
        const avi::StepReport report = method.step(by_hand, 0.2);
        ASSERT_TRUE(report.ok());
        run = advance(*steps, run, 0.2, 1);
        for (int i = 0; i < n; ++i) {
          ASSERT_EQ(run.z[i], by_hand.q[i]) << n << ", order " << order << ", step " << k;
          ASSERT_EQ(run.z[n + i], by_hand.p[i]);
        }
        ASSERT_EQ(run.t, by_hand.t);
      }
      const State<dynamic> inside = method.polynomial(0.3, 0.0);
      VectorX at(2 * n);
      double t = 0.0;
      steps->polynomial(0.3, at.data(), t);
      EXPECT_EQ(at[1], inside.q[1]);
      EXPECT_EQ(at[n + 2], inside.p[2]);
      EXPECT_EQ(t, inside.t);
    }
}

/// The row with the gradient of its recording, so that a step of few degrees of freedom is the same there and
/// here.
template <int n>
class RecordedRow {
 public:
  explicit RecordedRow(const Formulas& formulas)
      : forces_(&formulas.forces), velocities_(&formulas.velocities) {}
  double operator()(const Vector<double, n>& q, const Vector<double, n>& p) const { return row(q, p); }
  template <class S>
  S operator()(const Vector<S, n>& q, const Vector<S, n>& p) const {
    return row(q, p);
  }
  template <class S>
  Vector<S, n> d_dq(const Vector<S, n>& q, const Vector<S, n>& p) const {
    return slopes(*forces_, q, p);
  }
  template <class S>
  Vector<S, n> d_dp(const Vector<S, n>& q, const Vector<S, n>& p) const {
    return slopes(*velocities_, q, p);
  }

 private:
  template <class S>
  static Vector<S, n> slopes(const Program& program, const Vector<S, n>& q, const Vector<S, n>& p) {
    avi::detail::RecordedFormula<S> formula{program};
    formula.run(q, p);
    Vector<S, n> all;
    for (int i = 0; i < n; ++i)
      all[i] = formula.partial(i);
    return all;
  }
  const Program *forces_, *velocities_;
};

TEST(Gauss, HasTheBitsOfCollocationByHandWithFewDegreesOfFreedom) {
  const auto compare = [&]<int n>() {
    const auto its = formulas(n, steady);
    for (const int order : {4, 8, 12, 16}) {
      const VectorX z = start(n);
      State<n> by_hand{.q = Vector<double, n>(z.head(n)), .p = Vector<double, n>(z.tail(n))};
      auto method = avi::collocation(avi::poincare(RecordedRow<n>(*its), by_hand), order);
      Orbit run{z};
      const auto steps = avi::detail::gauss_steps(its, order);
      for (int k = 0; k < 20; ++k) {
        ASSERT_TRUE(method.step(by_hand, 0.3).ok());
        run = advance(*steps, run, 0.3, 1);
        for (int i = 0; i < n; ++i) {
          ASSERT_EQ(run.z[i], by_hand.q[i]) << n << ", order " << order << ", step " << k;
          ASSERT_EQ(run.z[n + i], by_hand.p[i]) << n << ", order " << order << ", step " << k;
        }
      }
    }
  };
  compare.operator()<1>();
  compare.operator()<2>();
  compare.operator()<3>();
  compare.operator()<4>();
}

TEST(Gauss, HasTheSameBitsWhateverItIsBuiltFor) {
  for (const int n : {1, 2, 3, 4, 6})
    for (const int order : {2, 6, 8, 14, 16}) {
      const auto its = formulas(n, lively);
      const auto reference = avi::detail::gauss_steps_portable(its, order, {});
      const Orbit expected = advance(*reference, {start(n)}, 0.25, 40);
      for (const auto& build : avi::detail::builds())
        for (const char* code : {"on", "off"}) {
          if (!build.runs) continue;
          setenv("AVI_MACHINE_CODE", code, 1);
          const auto steps = build.make(formulas(n, lively), order, {});
          unsetenv("AVI_MACHINE_CODE");
          EXPECT_EQ(advance(*steps, {start(n)}, 0.25, 40), expected)
              << build.name << ", " << n << ", order " << order;
        }
    }
}

TEST(Gauss, CloneGoesOnWithTheSameBits) {
  for (const int n : {2, 6}) {
    const auto steps = avi::detail::gauss_steps(formulas(n, lively), 8);
    const Orbit half = advance(*steps, {start(n)}, 0.25, 10);
    const auto clone = steps->clone();
    const Orbit expected = advance(*steps, half, 0.25, 10);
    EXPECT_EQ(advance(*clone, half, 0.25, 10), expected);
    // One that has forgotten the way to here takes other starting values and other digits.
    const auto fresh = avi::detail::gauss_steps(formulas(n, lively), 8);
    EXPECT_NE(advance(*fresh, half, 0.25, 10), expected);
  }
}

TEST(Gauss, StaysWhereItIsUnlessAStepIsOk) {
  const auto steps = avi::detail::gauss_steps(formulas(3, steady), 8, {.max_sweeps = 2});
  const VectorX z = start(3);
  VectorX moved = z;
  double t = 0.5;
  EXPECT_EQ(steps->step(moved.data(), t, 0.5).outcome, avi::Outcome::not_converged);
  EXPECT_EQ(moved, z);
  EXPECT_EQ(t, 0.5);
}

TEST(Gauss, RefusesWhatCollocationRefuses) {
  const auto its = formulas(2, steady);
  EXPECT_THROW((void)avi::detail::gauss_steps(its, 7), std::invalid_argument);
  EXPECT_THROW((void)avi::detail::gauss_steps(its, 18), std::invalid_argument);
  EXPECT_THROW((void)avi::detail::gauss_steps(its, 8, {.tolerance = 0.0}), std::invalid_argument);
  EXPECT_THROW((void)avi::detail::gauss_steps(its, 8, {.max_sweeps = 0}), std::invalid_argument);
}

/// The sentence of a refusal.
std::string refused(const char* name) {
  try {
    return avi::detail::build_of(name).name;
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(Gauss, IsTheBuildThatTheEnvironmentNames) {
  const auto builds = avi::detail::builds();
  std::string names;
  for (const auto& build : builds) {
    names = build.name + (names.empty() ? "" : ", " + names);
    EXPECT_EQ(refused(build.name),
              build.runs ? build.name
                         : std::string("AVI_INSTRUCTIONS is ") + build.name +
                               ", which this processor does not have; leave it empty for the best it has.");
  }
  EXPECT_EQ(refused("v5"),
            "AVI_INSTRUCTIONS is v5; this library is built for " + names + ", of which it must be one.");
  const auto best = std::find_if(builds.begin(), builds.end(), [](const auto& build) { return build.runs; });
  EXPECT_EQ(refused(""), best->name);
  EXPECT_EQ(refused(nullptr), best->name);
}

}  // namespace gauss_test
