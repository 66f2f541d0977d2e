#include "avi/autodiff/recording.hpp"
#include "avi/problems/n_body.hpp"
#include "common/problems/chain.hpp"
#include "difference.hpp"
#include "refusal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using avi::dynamic, avi::Program, avi::Recorded, avi::Recording, avi::Vector;
using VectorX = Vector<double, dynamic>;

namespace recording_test {

using RecordedFormula = avi::detail::RecordedFormula<double>;

/// Largest difference between recorded and supplied derivatives, over the largest of them; the recorded value
/// must be that of a call.
template <class H>
double gap(const H& h, const VectorX& q, const VectorX& p) {
  const int n = static_cast<int>(q.size());
  const Recording recording = avi::record(h, n);
  const Program all = recording.value_and_gradient(), forces = recording.gradient(0, n),
                velocities = recording.gradient(n, n);
  const VectorX d_dq = h.d_dq(q, p), d_dp = h.d_dp(q, p);
  double most = 0.0;
  const auto compare = [&](const Program& program, int first, bool has_value = false) {
    RecordedFormula formula{program};
    formula.run(q, p);
    for (int i = 0; i < program.slopes(); ++i) {
      const int k = first + i;
      most = std::max(most, std::abs(formula.partial(i) - (k < n ? d_dq[k] : d_dp[k - n])));
    }
    if (has_value) {
      EXPECT_EQ(formula.value(), h(q, p));
    }
  };
  compare(all, 0, true);
  compare(forces, 0);
  compare(velocities, n);
  return most / std::max(d_dq.cwiseAbs().maxCoeff(), d_dp.cwiseAbs().maxCoeff());
}

TEST(Recording, HasTheGradientThatIsSupplied) {
  for (int n : {1, 2, 3, 33, 200}) {
    auto z = experiment::Chain::plucked(n);
    for (int i = 0; i < n; ++i)
      z.p[i] = 0.1 * std::cos(3.0 * i);
    EXPECT_LT(gap(experiment::Chain{}, z.q, z.p), 6.4e-16) << n;
  }
  for (int bodies : {2, 3, 9, 20}) {
    VectorX q(2 * bodies), p(2 * bodies);
    for (int i = 0; i < q.size(); ++i) {
      q[i] = std::sin(1.0 + i * i);
      p[i] = std::cos(2.0 * i);
    }
    EXPECT_LT(gap(avi::NBody<dynamic>(VectorX::LinSpaced(bodies, 1.0, 2.0)), q, p), 2e-15) << bodies;
  }
}

// A program grows with the function, not with its square, and gradients cost a small multiple of it.
TEST(Recording, IsAsLongAsTheFunction) {
  for (int n : {64, 512}) {
    const Recording recording = avi::record(experiment::Chain{}, n);
    EXPECT_LE(recording.gradient().operations(), 8u * n + 8u);
    EXPECT_LE(recording.value_and_gradient().operations(), 16u * n);
    EXPECT_LE(recording.value_and_gradient().slots(), 5u * n);
  }
}

TEST(Recording, CountsOperations) {
  const auto count = [](auto f) { return Recording(f, 4).value().operations(); };
  EXPECT_EQ(count([](const auto& x) { return sin(x[0]); }), 1u);
  EXPECT_EQ(count([](const auto& x) { return exp(sin(x[0]) / x[1]); }), 3u);
  EXPECT_EQ(count([](const auto& x) { return x[0] - x[1] * x[2]; }), 2u);
  EXPECT_EQ(count([](const auto& x) { return (x[0] + x[1]) * x[2] - sqrt(x[3]); }), 4u);
  // In a long sum a product and its addition are one.
  EXPECT_EQ(count([](const auto& x) { return x[0] * x[1] + x[1] * x[2] + x[2] * x[3] + x[0] * x[3]; }), 4u);
}

TEST(Recording, TakesEigensReductions) {
  const int n = 7;
  const auto f = [](const auto& q, const auto& p) {
    using S = typename std::decay_t<decltype(q)>::Scalar;
    const avi::Matrix<double, dynamic> springs = avi::Matrix<double, dynamic>::Identity(7, 7) * 2.0;
    const Vector<S, dynamic> forces = springs * q;
    S sum = q.dot(p) * q.squaredNorm() + p.head(3).sum() / p.segment(2, 3).norm() + forces.dot(q);
    sum += (2.0 * q - p / 3.0).cwiseProduct(q).sum() + q.tail(2).prod();
    return sum;
  };
  const VectorX q = VectorX::LinSpaced(n, 0.5, 2.0), p = VectorX::LinSpaced(n, 3.0, 1.0);
  RecordedFormula formula{avi::record(f, n).value_and_gradient()};
  formula.run(q, p);
  VectorX slopes(2 * n);
  for (int i = 0; i < 2 * n; ++i)
    slopes[i] = formula.partial(i);
  EXPECT_NEAR(formula.value(), f(q, p), 1e-13 * std::abs(f(q, p)));
  EXPECT_LT(gradient_defect([&](const VectorX& x) { return f(x, p); }, q, slopes.head(n), 1e-3), 1e-7);
  EXPECT_LT(gradient_defect([&](const VectorX& x) { return f(q, x); }, p, slopes.tail(n), 1e-3), 1e-7);
}

TEST(Recording, FindsEqualOperationsOnceAndDropsTheRest) {
  const auto distance = [](const auto& x) {
    using std::sqrt;
    return sqrt(x[0] * x[0] + x[1] * x[1]);
  };
  const Recording once([&](const auto& x) { return distance(x); }, 2);
  const Recording twice([&](const auto& x) { return 0.5 * distance(x) + 0.5 * distance(x); }, 2);
  EXPECT_LE(twice.value().operations(), once.value().operations() + 2);
  const Recording wasteful(
      [&](const auto& x) {
        const auto unused = exp(x[1]) / x[0];
        (void)unused;
        return 1.0 * x[0] + 0.0 * x[1] + (2.0 - 2.0);
      },
      2);
  EXPECT_EQ(wasteful.value_and_gradient().operations(), 0u);
  const Recording folded([](const auto& x) { return exp(Recorded(2.0)) * sin(Recorded(1.0)) + x[0]; }, 1);
  EXPECT_EQ(folded.value().operations(), 1u);
}

TEST(Recording, OfAConstantHasNoSlope) {
  const Recording recording([](const auto&) { return 3.0; }, 2);
  const Program program = recording.value_and_gradient();
  Program::Room<double> room(program);
  program.run(room);
  EXPECT_EQ(program.value(room), 3.0);
  EXPECT_EQ(program.slope(room, 0), 0.0);
  EXPECT_EQ(program.slope(room, 1), 0.0);
}

TEST(Recording, TakesASuppliedGradientWhereTheFunctionIsUsed) {
  const auto expect = [&](const auto& f, double first, double second) {
    avi::ExpressionGraph graph(2);
    const auto x = avi::recorded_inputs(graph, 0, 2);
    const Recorded h = x[0] * x[1], value = f(x, h);
    const int inner = h.node_in(graph), outer = value.node_in(graph);
    const std::vector<int> not_its_own{graph.constant(7.0), graph.constant(5.0)};
    const Program program = Recording(graph, outer, inner, not_its_own).gradient();
    Program::Room<double> room(program);
    room.arguments()[0] = 3.0, room.arguments()[1] = 4.0;
    program.run(room);
    EXPECT_EQ(program.slope(room, 0), first);
    EXPECT_EQ(program.slope(room, 1), second);
  };
  expect([](const auto& x, const auto& value) { return x[0] + 2.0 * value; }, 1.0 + 2.0 * 7.0, 2.0 * 5.0);
  expect([](const auto& x, const auto&) { return x[0] * x[0]; }, 6.0, 0.0);
}

TEST(Recording, TakesAGraphThatIsRecordedAlready) {
  const experiment::Chain chain;
  const int n = 5;
  avi::ExpressionGraph graph(2 * n);
  const int node = chain(avi::recorded_inputs(graph, 0, n), avi::recorded_inputs(graph, n, n)).node_in(graph);
  const Recording direct = avi::record(chain, n), twice(graph, node);
  (void)graph.unary(avi::Operation::exp, 0);  // the recording has a copy
  auto z = experiment::Chain::plucked(n);
  z.p = VectorX::LinSpaced(n, 0.0, 0.1 * (n - 1));
  for (const bool gradient : {false, true}) {
    const auto program = [&](const Recording& of) {
      return gradient ? of.gradient() : of.value_and_gradient();
    };
    const Program a = program(direct), b = program(twice);
    EXPECT_EQ(a.operations(), b.operations());
    EXPECT_EQ(a.slots(), b.slots());
    RecordedFormula of_a{a}, of_b{b};
    of_a.run(z.q, z.p), of_b.run(z.q, z.p);
    for (int i = 0; i < 2 * n; ++i)
      EXPECT_EQ(of_a.partial(i), of_b.partial(i)) << i;
    if (!gradient) {
      EXPECT_EQ(of_a.value(), of_b.value());
    }
  }
  // A node before the last one, and an input, are formulas too.
  EXPECT_EQ(Recording(graph, 0).gradient().operations(), 0u);
  EXPECT_EQ(refusal([&] { Recording(graph, graph.size()); }),
            "Node to differentiate is " + std::to_string(graph.size()) + "; it must be a node of the graph.");
  EXPECT_EQ(refusal([&] { Recording(graph, -1); }),
            "Node to differentiate is -1; it must be a node of the graph.");
  EXPECT_EQ(refusal([&] { Recording(avi::ExpressionGraph(0), 0); }),
            "Number of arguments to record is 0; it must be at least 1.");
}

const std::string mixes =
    "A recorded function mixes the arguments of two recordings; it must not keep numbers from one call "
    "to the next, nor an expression of Eigen in `auto`: (...).eval() makes a vector of it.";

TEST(Recording, RefusesWhatItCannotServe) {
  const auto first = [](const auto& x) -> Recorded { return x[0]; };
  EXPECT_EQ(refusal([&] { Recording(first, 0); }),
            "Number of arguments to record is 0; it must be at least 1.");
  const Recording recording(first, 2);
  EXPECT_EQ(refusal([&] { (void)recording.gradient(3, 1); }),
            "First entry to differentiate by is 3; it must be an entry of x.");
  EXPECT_EQ(refusal([&] { (void)recording.gradient(1, 2); }),
            "Number of derivatives is 2; it must be at most that of the entries left.");
  EXPECT_EQ(refusal([&] { Recording([](const auto& x) { return x[0] == 0.0 ? x[0] : x[1]; }, 2); }),
            "A function that asks whether its arguments are equal cannot be recorded; instead of a "
            "branch write select(a < b, x, y), min(x, y), max(x, y) or abs(x).");
  EXPECT_EQ(refusal([&] { Recording([](const auto& x) { return x[1] + x[2]; }, 2); }),
            "Index of an entry is 2; it must be at least 0 and below 2, the size of the vector.");
  EXPECT_EQ(refusal([&] { avi::record([](const auto& q, const auto&) { return q[0]; }, 0); }),
            "Number of degrees of freedom to record is 0; it must be at least 1.");
  EXPECT_EQ(refusal([&] { avi::record<2>([](const auto& q, const auto& p) { return q[0] * p(-1); }); }),
            "Index of an entry is -1; it must be at least 0 and below 2, the size of the vector.");
  EXPECT_EQ(refusal([&] { Recording([](const auto& x) { return x.segment(1, 2).sum(); }, 2); }),
            "Number of entries is 2; it must be at least 0 and at most 1, for the vector has not more.");
  EXPECT_EQ(refusal([&] { Recording([](const auto& x) { return x.head(3).sum(); }, 2); }),
            "Number of entries is 3; it must be at least 0 and at most 2, for the vector has not more.");
  Recorded kept;
  const Recording keeps([&](const auto& x) -> Recorded { return kept = x[0]; }, 1);
  EXPECT_EQ(refusal([&] { Recording([&](const auto& x) { return x[0] + kept; }, 1); }), mixes);
}

// The graph of the next recording may lie where that of the last one did.
TEST(Recording, RefusesNumbersOfOneThatIsGone) {
  Recorded kept;
  const auto record = [&](const auto& f) { return refusal([&] { (void)avi::Formula::of_point(f, 2); }); };
  EXPECT_EQ(record([&](const auto& x) { return kept = x[0] * x[0]; }), "accepted");
  EXPECT_EQ(record([&](const auto& x) { return kept + x[1]; }), mixes);
  EXPECT_EQ(record([&](const auto& x) { return x[1] / kept; }), mixes);
  EXPECT_EQ(record([&](const auto&) { return kept; }), mixes);
}

TEST(Recording, MayBeAnArgumentOrANumber) {
  for (const int i : {0, 1}) {
    const Program program =
        Recording([&](const auto& x) -> Recorded { return x[i]; }, 2).value_and_gradient();
    Program::Room<double> room(program);
    room.arguments()[0] = 3.0, room.arguments()[1] = 5.0;
    program.run(room);
    EXPECT_EQ(program.value(room), i == 0 ? 3.0 : 5.0);
    EXPECT_EQ(program.slope(room, i), 1.0);
    EXPECT_EQ(program.slope(room, 1 - i), 0.0);
  }
}

TEST(RecordedFormula, TakesPositionsAndMomenta) {
  const auto h = [](const auto& q, const auto& p) { return q[0] - 2.0 * q[1] + 4.0 * p[0] - 8.0 * p[1]; };
  RecordedFormula formula{avi::record<2>(h).value_and_gradient()};
  formula.run(Vector<double, 2>(1.0, 3.0), Vector<double, 2>(5.0, 7.0));
  EXPECT_EQ(formula.value(), 1.0 - 6.0 + 20.0 - 56.0);
  EXPECT_EQ(formula.partial(3), -8.0);
}

}  // namespace recording_test
