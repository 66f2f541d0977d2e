#include "avi/autodiff/convolution.hpp"
#include "avi/autodiff/lanes.hpp"
#include "avi/autodiff/partials.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

using avi::Lanes;
using avi::Partials;

namespace {

/// A function of two variables for every operation, generic in its scalar.
template <class S>
std::vector<std::pair<std::string, std::function<S(S, S)>>> operations() {
  return {{"sum", [](S x, S y) { return 2.0 + x - y + 0.5; }},
          {"product", [](S x, S y) { return x * y * 3.0 * x; }},
          {"quotient", [](S x, S y) { return (x / y) / 4.0 + 1.0 / y; }},
          {"sqrt",
           [](S x, S y) {
             using std::sqrt;
             return sqrt(x * y);
           }},
          {"pow",
           [](S x, S y) {
             using avi::power, std::pow;
             return power(x, -1.5) * pow(y, 0.3) * power(x, 3.0);
           }},
          {"exp_log",
           [](S x, S y) {
             using std::exp, std::log;
             return exp(x) * log(y);
           }},
          {"sin_cos_tan",
           [](S x, S y) {
             using std::sin, std::cos, std::tan;
             return sin(x) * cos(y) + tan(x);
           }},
          {"hyperbolic",
           [](S x, S y) {
             using std::sinh, std::cosh, std::tanh;
             return sinh(x) * cosh(y) + tanh(y);
           }},
          {"atan_abs", [](S x, S y) {
             using std::atan, std::abs;
             return atan(x) * abs(-y);
           }}};
}

TEST(Lanes, PartialsAgreeWithCentralDifferences) {
  const double x = 0.7, y = 1.3, d = 1e-5;
  const auto plain = operations<double>();
  const auto lanes = operations<Lanes<2>>();
  const auto partials = operations<Partials<double, 2>>();
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const auto& f = plain[i].second;
    const double f_x = (f(x + d, y) - f(x - d, y)) / (2.0 * d), f_y = (f(x, y + d) - f(x, y - d)) / (2.0 * d);
    const auto v = lanes[i].second(Lanes<2>::variable(x, 0), Lanes<2>::variable(y, 1));
    EXPECT_NEAR(v.value(), f(x, y), 4e-16 * std::abs(f(x, y))) << plain[i].first;
    EXPECT_NEAR(v.partial(0), f_x, 2e-9) << plain[i].first;
    EXPECT_NEAR(v.partial(1), f_y, 2e-9) << plain[i].first;
    using P = Partials<double, 2>;
    const P p = partials[i].second(P::variable(x, 0), P::variable(y, 1));
    EXPECT_NEAR(p.value, v.value(), 4e-16 * std::abs(v.value())) << plain[i].first;
    EXPECT_NEAR(p.partial(0), v.partial(0), 1e-14) << plain[i].first;
    EXPECT_NEAR(p.partial(1), v.partial(1), 1e-14) << plain[i].first;
  }
}

/// Where the function has a derivative at zero, or one from the right.
template <class S>
void check_at_zero(S x) {
  using std::abs, avi::power;
  const auto slope = [](const S& f) { return f.partial(0); };
  EXPECT_EQ(slope(pow(x, 1.0)), 1.0);
  EXPECT_EQ(slope(pow(x, 1.5)), 0.0);
  EXPECT_EQ(slope(pow(x, 2.0)), 0.0);
  EXPECT_EQ(slope(power(x, 3.0)), 0.0);
  EXPECT_EQ(slope(abs(x)), 1.0) << "to the right of the kink";
}

TEST(Lanes, DerivativesAtZero) {
  check_at_zero(Lanes<2>::variable(0.0, 0));
  check_at_zero(Partials<double, 2>::variable(0.0, 0));
}

TEST(Lanes, ProductSumIsTheSumOfProducts) {
  const auto x = Lanes<3>::variable(1.5, 0), y = Lanes<3>::variable(-0.25, 2);
  avi::ProductSum<Lanes<3>> sum;
  sum.add(x, y);
  sum.add(2.0, y, y);
  const auto expected = x * y + 2.0 * y * y, result = sum.result();
  EXPECT_EQ(result.value(), expected.value());
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(result.partial(i), expected.partial(i));
}

TEST(Power, HalfIntegersAgreeWithTheLibrary) {
  for (double x : {1e-8, 0.3, 1.0, 7.5, 1e6})
    for (int m = -18; m <= 18; ++m)
      EXPECT_NEAR(avi::power(x, 0.5 * m) / std::pow(x, 0.5 * m), 1.0, 4e-15);
}

}  // namespace
