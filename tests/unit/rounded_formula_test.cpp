#include "src/autodiff/rounded_formula.hpp"

#include "avi/autodiff/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

/// @file
/// What rounding takes from the value of a formula.

namespace rounded_formula_test {

template <class F>
double rounded_once(const F& f, const std::vector<double>& x) {
  const auto formula = avi::Formula::of_point(f, static_cast<Eigen::Index>(x.size()));
  return avi::detail::RoundedFormula(formula.graph(), formula.node()).rounded_once(x);
}

// What is left of each is the rounding of one operation.
TEST(RoundedFormula, KnowsWhatRoundingTakesFromEachOperation) {
  for (const double x : {0.3, 1.7, 5.1e-5, 43.21}) {
    const double square = x * x, inverse = 1.0 / x, root = std::sqrt(x), sum = x + 0.1, less = x - 0.1,
                 exponential = std::exp(0.001 * x);
    const auto left = [&](const auto& f) { return rounded_once(f, {x}); };
    EXPECT_EQ(left([&](const auto& z) { return z[0] * z[0] - square; }), std::fma(x, x, -square));
    EXPECT_EQ(left([&](const auto& z) { return 1.0 / z[0] - inverse; }), std::fma(-inverse, x, 1.0) / x);
    EXPECT_EQ(left([&](const auto& z) { return sqrt(z[0]) - root; }),
              std::fma(-root, root, x) / (2.0 * root));
    EXPECT_EQ(left([&](const auto& z) { return z[0] + 0.1 - sum; }),
              static_cast<double>(static_cast<long double>(x) + 0.1 - sum));
    EXPECT_EQ(left([&](const auto& z) { return z[0] - 0.1 - less; }),
              static_cast<double>(static_cast<long double>(x) - 0.1 - less));
    const double its_argument = std::fma(0.001, x, -0.001 * x);
    EXPECT_NEAR(left([&](const auto& z) { return exp(0.001 * z[0]) - exponential; }),
                static_cast<double>(std::exp(static_cast<long double>(0.001 * x)) - exponential) +
                    exponential * its_argument,
                1e-3 * 1.1e-16 * exponential);
  }
}

// Nearly all of it cancels: (x - y)(x + y) has no error.
TEST(RoundedFormula, HasTheDigitsThatCancellationLoses) {
  const double x = 1.0 + 0x1p-30, y = 1.0 + 0x1p-31;
  const auto difference = [](const auto& z) { return z[0] * z[0] - z[1] * z[1]; };
  EXPECT_EQ(rounded_once(difference, {x, y}), (x - y) * (x + y));
  EXPECT_NE(x * x - y * y, (x - y) * (x + y));
}

// Neither a jump nor a pole of a slope is taken for rounding.
TEST(RoundedFormula, GoesOnAsDoublesDo) {
  const auto jump = [](const auto& z) { return select(z[0] * 0.1 < 0.3 - 1e-17, z[0] * 0.0, z[0]); };
  for (const double x : {std::nextafter(3.0, 0.0), 3.0, std::nextafter(3.0, 4.0)})
    EXPECT_EQ(rounded_once(jump, {x}), x * 0.1 < 0.3 - 1e-17 ? 0.0 : x) << x;
  EXPECT_EQ(rounded_once([](const auto& z) { return sqrt(z[0] - 1.0); }, {1.0}), 0.0);
  EXPECT_TRUE(std::isnan(rounded_once([](const auto& z) { return sqrt(z[0]); }, {-1.0})));
}

}  // namespace rounded_formula_test
