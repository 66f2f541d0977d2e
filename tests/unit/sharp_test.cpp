#include "src/features/sharp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace sharp_test {

using avi::VectorX, avi::detail::SharpFeatures;
using State = avi::State<avi::dynamic>;

/// H of one degree of freedom, with the motion seen from (q, p).
struct Seen {
  template <class H>
  Seen(const H& hamiltonian, double at, double moving = 1.0, double time = 1e-3)
      : graph(std::make_shared<avi::ExpressionGraph>(2)), q(avi::recorded_inputs(*graph, 0, 1)[0]),
        p(avi::recorded_inputs(*graph, 1, 1)[0]), energy(avi::Recorded(hamiltonian(q, p)).node_in(*graph)),
        field(*graph, energy, {}),
        sketch(field, VectorX(Eigen::Vector2d(at, moving)), time, VectorX::Ones(1)) {}

  std::shared_ptr<avi::ExpressionGraph> graph;
  avi::Recorded q, p;
  int energy;
  avi::detail::PointField field;
  avi::detail::Sketch sketch;
};

State moving(double q) { return {.q = VectorX::Constant(1, q), .p = VectorX::Ones(1)}; }

/// A step of size 1 from q to q + 1, nearly.
template <class H>
bool jumped(const H& hamiltonian, double q, double* far = nullptr) {
  const Seen seen(hamiltonian, q);
  SharpFeatures features(*seen.graph, seen.energy, seen.sketch);
  const auto method = avi::detail::Candidate("fixed", 0.0, seen.graph, seen.energy, 0.5, -1).steps(8, {});
  State z = moving(q);
  EXPECT_TRUE(method->step(z, 1.0).ok());
  if (far) *far = z.q[0];
  return features.jumped(*method, moving(q), z, [](const State&) { return true; });
}

/// H has a kink, a jump or a branch.
template <class H>
bool bends(const H& hamiltonian) {
  const Seen seen(hamiltonian, 0.3);
  return SharpFeatures(*seen.graph, seen.energy, seen.sketch).has_kinks();
}

TEST(SharpFeatures, KnowWhatBends) {
  EXPECT_TRUE(bends([](const auto& q, const auto& p) { return p * p + abs(q); }));
  EXPECT_TRUE(bends([](const auto& q, const auto& p) { return p * p + max(q, 0.0 * q); }));
  EXPECT_TRUE(bends([](const auto& q, const auto& p) { return p * p + select(q < 0.5, q, q * q); }));
  EXPECT_TRUE(bends([](const auto& q, const auto& p) { return p * p + select(q <= 0.5, q, q * q); }));
  EXPECT_FALSE(bends([](const auto& q, const auto& p) { return p * p + exp(q) / (1.0 + q * q); }));
}

/// A bump at q = 1, so low that nothing else is felt of it.
auto bump(double width) {
  return [=](const auto& q, const auto& p) {
    const auto x = (q - 1.0) / width;
    return 0.5 * p * p + 1e-9 * exp(-x * x);
  };
}
/// A wall at q = 1.
auto wall(double width) {
  return [=](const auto& q, const auto& p) { return 0.5 * p * p + 1e-9 * tanh((q - 1.0) / width); };
}

TEST(SharpFeatures, AreJumpedOverBetweenStages) {
  for (const double q : {0.4, 0.1, 0.9, 0.875, 0.125}) {
    EXPECT_TRUE(jumped(bump(1e-3), q)) << q;
    EXPECT_TRUE(jumped(bump(1e-5), q)) << q;
    EXPECT_TRUE(jumped(wall(1e-3), q)) << q;
  }
  EXPECT_TRUE(jumped(wall(1e-3), 0.5)) << "in the middle of the step, where the argument is 0";
  double far = 0.0;
  EXPECT_TRUE(jumped(bump(1e-3), 0.4, &far));
  EXPECT_NEAR(far, 1.4, 1e-6) << "the step has not seen it";
}

TEST(SharpFeatures, AreNotJumpedOverElsewhere) {
  for (const double q : {-1.5, 1.2}) {
    EXPECT_FALSE(jumped(bump(1e-3), q)) << q << ", before or after it";
    EXPECT_FALSE(jumped(wall(1e-3), q)) << q << ", before or after it";
  }
  EXPECT_FALSE(jumped(bump(0.5), 0.4)) << "broad";
  EXPECT_FALSE(jumped(bump(0.1), 0.4)) << "stages see it";
  EXPECT_FALSE(jumped(wall(0.5), 0.4)) << "broad";
  EXPECT_FALSE(jumped([](const auto&, const auto& p) { return 0.5 * p * p; }, 0.4));
}

/// Moves freely along q, and counts how often it is asked for a point on its way.
struct FreeMotion final : avi::detail::Stepper {
  double from = 0.0, h = 0.0;
  std::shared_ptr<int> asked = std::make_shared<int>(0);

  avi::StepReport step(double* z, double& t, double size) override {
    from = z[0], h = size, z[0] += h, t += h;
    return {};
  }
  void polynomial(double c, double* z, double& t) const override {
    ++*asked;
    z[0] = from + c * h, z[1] = 1.0, t = c * h;
  }
  [[nodiscard]] std::unique_ptr<Stepper> clone() const override {
    return std::make_unique<FreeMotion>(*this);
  }
};

TEST(SharpFeatures, AreNotSearchedForFarAway) {
  const Seen seen(bump(1e-3), 0.0);
  const auto asked = [&](double start, bool there) {
    SharpFeatures features(*seen.graph, seen.energy, seen.sketch);
    auto motion = std::make_unique<FreeMotion>();
    const auto count = motion->asked;
    avi::detail::OrbitSteps method(std::move(motion), 1);
    State z = moving(start);
    EXPECT_TRUE(method.step(z, 1.0).ok());
    EXPECT_EQ(features.jumped(method, moving(start), z, [](const State&) { return true; }), there) << start;
    return *count;
  };
  EXPECT_LE(asked(-5.0, false), 3) << "the points that every step is looked at";
  EXPECT_GT(asked(0.4, true), 5);  // measured 11
}

TEST(SharpFeatures, AreThoseOfH) {
  const Seen seen([](const auto& q, const auto& p) { return 0.5 * (p * p + q * q); }, 1.0, 0.0, 1.0);
  const auto& sketch = seen.sketch;
  avi::ExpressionGraph& graph = *seen.graph;
  EXPECT_TRUE(SharpFeatures(graph, seen.energy, sketch).none());
  const int with = graph.binary(avi::Operation::add, seen.energy, exp(seen.q).node_in(graph));
  EXPECT_FALSE(SharpFeatures(graph, with, sketch).none());
  for (const auto operation : {avi::Operation::tanh, avi::Operation::cosh, avi::Operation::sinh,
                               avi::Operation::erf, avi::Operation::erfc})
    EXPECT_FALSE(SharpFeatures(graph, graph.unary(operation, 0), sketch).none())
        << avi::detail::name(operation);
  EXPECT_TRUE(SharpFeatures(graph, graph.unary(avi::Operation::sin, 0), sketch).none());
}

}  // namespace sharp_test
