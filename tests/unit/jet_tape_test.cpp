#include "avi/autodiff/jet.hpp"
#include "avi/autodiff/partials.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using avi::JetTape;

namespace jet_tape_test {

constexpr int R = 12;
using Number = avi::Lanes<1>;
using Scalar = avi::Jet<Number, R>;
using Series = std::array<Number, R + 2>;

/// x(t) = a + t.
Series line(double a) { return {a, 1.0}; }

TEST(JetTape, RunsAFormulaOfAnyLengthAnewAtOtherPoints) {
  for (int factors : {10, 5000}) {  // a slot for each product
    JetTape<Number, R> tape;
    auto x = line(1.001);
    Scalar y(x.data(), &tape);
    for (int i = 0; i < factors; ++i)
      y *= Scalar(x.data(), &tape);
    EXPECT_EQ(tape.size(), factors);
    for (double at : {1.001, 0.999}) {
      x[0] = at;
      tape.run(0, tape.size());
      tape.run(1, tape.size());
      EXPECT_NEAR(y[0].value(), std::pow(at, factors + 1), 1e-12 * y[0].value());
      EXPECT_NEAR(y[1].value(), (factors + 1) * std::pow(at, factors), 1e-12 * y[1].value());
    }
  }
}

TEST(JetTape, KnowsFormulasThatLookAtValues) {
  JetTape<Number, R> tape;
  auto x = line(-0.5);
  const Scalar s(x.data(), &tape);
  const auto y = abs(s) + pow(s * s, 1.5);
  EXPECT_FALSE(tape.branched);
  x[0] = 0.25;
  tape.run(0, tape.size());
  EXPECT_EQ(y[0].value(), 0.25 + 0.015625) << "the sign is that of the new point";
  EXPECT_FALSE(s < 0.0);
  EXPECT_TRUE(tape.branched);
  tape.clear();
  EXPECT_FALSE(tape.branched);
  (void)tanh(s);
  EXPECT_TRUE(tape.branched);
}

TEST(JetTape, AnAbsoluteValueWithDerivativesIsWrittenOnce) {
  JetTape<Number, R> tape;
  auto x = line(-0.5);
  const auto y = abs(avi::Partials<Scalar, 1>::variable(Scalar(x.data(), &tape), 0));
  EXPECT_FALSE(tape.branched);
  EXPECT_EQ(y.value[0].value(), 0.5);
  EXPECT_EQ(y.d[0][0].value(), -1.0);
  x[0] = 0.25;
  for (int k = 0; k <= 2; ++k)
    tape.run(k, tape.size());
  EXPECT_EQ(y.value[0].value(), 0.25);
  EXPECT_EQ(y.value[1].value(), 1.0);
  EXPECT_EQ(y.d[0][0].value(), 1.0);
  EXPECT_EQ(y.d[0][1].value(), 0.0);
}

}  // namespace jet_tape_test
