#include "avi/autodiff/jet.hpp"
#include "avi/autodiff/partials.hpp"
#include "unit/elementary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

using avi::Jet;
using avi::JetTape;

namespace jet_test {

constexpr int R = 12;
using Number = avi::Lanes<1>;
using Scalar = Jet<Number, R>;
using Series = std::array<Number, R + 2>;

/// Taylor coefficients at t = 0 of f(x(t)), x given by its coefficients.
std::array<double, R + 1> expand(const std::function<Scalar(Scalar)>& f, const Series& x) {
  JetTape<Number, R> tape;
  const Scalar y = f(Scalar(x.data(), &tape));
  std::array<double, R + 1> c{};
  for (int k = 0; k <= R; ++k) {
    if (k > 0) tape.run(k, tape.size());
    c[k] = y[k].value();
  }
  return c;
}

/// x(t) = a + t.
Series line(double a) {
  Series x;
  x.fill(0.0);
  x[0] = a;
  x[1] = 1.0;
  return x;
}

/// The coefficients of f(a + t) are `exact`, to one rounding, or two to four.
void expect_series(double a, const std::function<Scalar(Scalar)>& f, const std::function<double(int)>& exact,
                   double tolerance = 1e-15) {
  const auto c = expand(f, line(a));
  for (int k = 0; k <= R; ++k)
    EXPECT_NEAR(c[k], exact(k), tolerance * std::max(1.0, std::abs(exact(k)))) << "coefficient " << k;
}

double factorial(int k) { return std::tgamma(k + 1.0); }

TEST(Jet, ElementarySeriesAgreeWithTheirClosedForms) {
  const auto odd = [](int k) { return k % 2 == 1; };
  expect_series(
      0.0, [](auto x) { return exp(x); }, [](int k) { return 1.0 / factorial(k); });
  expect_series(
      0.0, [](auto x) { return sin(x); }, [](int k) { return std::sin(k * M_PI_2) / factorial(k); });
  expect_series(
      0.0, [](auto x) { return cos(x); }, [](int k) { return std::cos(k * M_PI_2) / factorial(k); });
  expect_series(
      0.0, [](auto x) { return sinh(x); }, [&](int k) { return odd(k) ? 1.0 / factorial(k) : 0.0; });
  expect_series(
      1.0, [](auto x) { return log(x); }, [&](int k) { return k == 0 ? 0.0 : (odd(k) ? 1.0 : -1.0) / k; });
  expect_series(
      0.0, [](auto x) { return atan(x); },
      [&](int k) { return odd(k) ? (k % 4 == 1 ? 1.0 : -1.0) / k : 0.0; });
  expect_series(
      1.0, [](auto x) { return 1.0 / x; }, [&](int k) { return odd(k) ? -1.0 : 1.0; });
  const auto binomial = [](double power) {
    return [power](int k) {
      double c = 1.0;
      for (int j = 0; j < k; ++j)
        c *= (power - j) / (j + 1);
      return c;
    };
  };
  expect_series(
      1.0, [](auto x) { return pow(x, -1.5); }, binomial(-1.5), 4e-15);
  expect_series(
      1.0, [](auto x) { return sqrt(x); }, binomial(0.5), 4e-15);
}

TEST(Jet, IdentitiesHoldCoefficientByCoefficient) {
  const auto x = line(0.3);
  using S = Scalar;
  const std::vector<std::pair<std::function<S(S)>, std::function<S(S)>>> pairs = {
      {[](S a) { return sin(a) * sin(a) + cos(a) * cos(a); }, [](S a) { return 1.0 + 0.0 * a; }},
      {[](S a) { return tan(a) * cos(a); }, [](S a) { return sin(a); }},
      {[](S a) { return tanh(a) * cosh(a); }, [](S a) { return sinh(a); }},
      {[](S a) { return exp(log(a)); }, [](S a) { return a; }},
      {[](S a) { return (a * a - 1.0) / (a - 1.0); }, [](S a) { return a + 1.0; }},
      {[](S a) { return pow(a, 0.5) * sqrt(a); }, [](S a) { return a; }},
      {[](S a) { return abs(-exp(a)); }, [](S a) { return exp(a); }},
      {[](S a) {
         S b = a;
         b += 2.0;
         b *= a;
         b -= a * a;
         b /= 2.0;
         return b;
       },
       [](S a) { return a; }}};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto left = expand(pairs[i].first, x), right = expand(pairs[i].second, x);
    for (int k = 0; k <= R; ++k)
      EXPECT_NEAR(left[k], right[k], 1e-9 * std::pow(4.0, std::max(0, k - 4)) * 1e-4)
          << "pair " << i << " k " << k;
  }
}

TEST(Jet, ConstantsAndVanishingDerivativesCostNothing) {
  JetTape<Number, R> tape;
  const auto x = line(2.0);
  const Scalar s(x.data(), &tape);
  EXPECT_TRUE((0.0 * s).is(0.0));
  EXPECT_EQ((1.0 * s).coefficients, s.coefficients);
  EXPECT_EQ((s + 0.0).coefficients, s.coefficients);
  EXPECT_EQ((0.0 + s).coefficients, s.coefficients);
  EXPECT_EQ((s - 0.0).coefficients, s.coefficients);
  EXPECT_EQ(pow(s, 1.0).coefficients, s.coefficients);
  EXPECT_TRUE((0.0 / s).is(0.0));
  EXPECT_TRUE(pow(s, 0.0).is(1.0));
  EXPECT_TRUE((Scalar(2.0) * Scalar(3.0)).is(6.0));
  EXPECT_EQ(tape.size(), 0);
  (void)(s * s);
  EXPECT_EQ(tape.size(), 1);
}

TEST(Jet, FunctionsOfConstantsAreConstants) {
  const auto expect = [](const Scalar& found, double exact) {
    EXPECT_TRUE(found.is(exact)) << found.constant << " is not " << exact;
    EXPECT_EQ(found[0].value(), exact);
    EXPECT_EQ(found[1].value(), 0.0);
  };
  const Scalar x(0.75), y(-2.0);
  expect(-x, -0.75);
  expect(x + y, -1.25);
  expect(x - y, 2.75);
  expect(x * y, -1.5);
  expect(x / y, -0.375);
  expect(sqrt(x), std::sqrt(0.75));
  expect(exp(x), std::exp(0.75));
  expect(log(x), std::log(0.75));
  expect(sin(x), std::sin(0.75));
  expect(cos(x), std::cos(0.75));
  expect(tan(x), std::sin(0.75) * (1.0 / std::cos(0.75)));
  expect(sinh(x), std::sinh(0.75));
  expect(cosh(x), std::cosh(0.75));
  expect(tanh(x), std::tanh(0.75));
  expect(atan(x), std::atan(0.75));
  expect(abs(y), 2.0);
  expect(sign_of(y), -1.0);
  expect(pow(x, 0.0), 1.0);
  expect(pow(x, 1.0), 0.75);
  expect(pow(x, 2.0), 0.5625);
  expect(pow(x, -1.5), avi::power(0.75, -1.5));
  EXPECT_TRUE(y < x);
}

TEST(Jet, ConstantsJoinSeriesByTheirRules) {
  const auto of = [](const std::function<Scalar(Scalar)>& f) {
    const auto c = expand(f, line(2.0));
    return std::vector{c[0], c[1], c[2]};
  };
  using List = std::vector<double>;
  EXPECT_EQ(of([](Scalar x) { return x + 3.0; }), (List{5.0, 1.0, 0.0}));
  EXPECT_EQ(of([](Scalar x) { return 3.0 + x; }), (List{5.0, 1.0, 0.0}));
  EXPECT_EQ(of([](Scalar x) { return x - 3.0; }), (List{-1.0, 1.0, 0.0}));
  EXPECT_EQ(of([](Scalar x) { return 3.0 - x; }), (List{1.0, -1.0, 0.0}));
  EXPECT_EQ(of([](Scalar x) { return 4.0 * x; }), (List{8.0, 4.0, 0.0}));
  EXPECT_EQ(of([](Scalar x) { return x * 4.0; }), (List{8.0, 4.0, 0.0}));
  EXPECT_EQ(of([](Scalar x) { return x / 4.0; }), (List{0.5, 0.25, 0.0}));
  EXPECT_EQ(of([](Scalar x) { return 4.0 / x; }), (List{2.0, -1.0, 0.5}));
  EXPECT_EQ(of([](Scalar x) { return pow(x, 2.0); }), (List{4.0, 4.0, 1.0}));
  EXPECT_EQ(of([](Scalar x) { return abs(x - 3.0); }), (List{1.0, -1.0, 0.0}));
  EXPECT_EQ(of([](Scalar x) { return x * sign_of(x - 3.0); }), (List{-2.0, -1.0, 0.0}));
}

/// Kepler's equations: the coefficients that a series of Lanes gives do not depend on their number, and
/// its partials are the derivatives of those coefficients.
template <class T>
void expand(std::array<std::array<T, R + 2>, 4>& z) {
  using S = Jet<T, R>;
  JetTape<T, R> tape;
  std::array<S, 4> s;
  for (int i = 0; i < 4; ++i)
    s[i] = S(z[i].data(), &tape);
  const S u = pow(s[0] * s[0] + s[1] * s[1], -1.5);
  const S force_x = s[0] * u, force_y = s[1] * u;
  for (int k = 0; k <= 8; ++k) {
    if (k > 0) tape.run(k, tape.size());
    z[0][k + 1] = s[2][k] / (k + 1);
    z[1][k + 1] = s[3][k] / (k + 1);
    z[2][k + 1] = -1.0 * force_x[k] / (k + 1);
    z[3][k + 1] = -1.0 * force_y[k] / (k + 1);
  }
}

TEST(Jet, LanesDifferentiateTaylorCoefficients) {
  const std::array<double, 4> start{1.0, 0.2, -0.1, 0.9};
  const auto coefficients = [&](std::array<double, 4> at) {
    std::array<Series, 4> z;
    for (int i = 0; i < 4; ++i)
      z[i][0] = at[i];
    expand(z);
    return z;
  };
  using L = avi::Lanes<4>;
  std::array<std::array<L, R + 2>, 4> z;
  for (int i = 0; i < 4; ++i)
    z[i][0] = L::variable(start[i], i);
  expand(z);
  const auto plain = coefficients(start);
  for (int j = 0; j < 4; ++j) {
    auto ahead = start, behind = start;
    const double d = 1e-5;
    ahead[j] += d;
    behind[j] -= d;
    const auto plus = coefficients(ahead), minus = coefficients(behind);
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k <= 9; ++k) {
        EXPECT_NEAR(z[i][k].value(), plain[i][k].value(), 1e-14);
        EXPECT_NEAR(z[i][k].partial(j), (plus[i][k] - minus[i][k]).value() / (2.0 * d), 2e-7)
            << i << ' ' << k << ' ' << j;
      }
  }
}

// Against derivatives of derivatives, with either argument fixed.
TEST(Jet, ElementaryFunctionsHaveTheirThreeDerivatives) {
  using One = avi::Partials<double, 1>;
  using Two = avi::Partials<One, 1>;
  using Three = avi::Partials<Two, 1>;
  const auto variable = [](double x) {
    return Three::variable(Two::variable(One::variable(x, 0), 0, One(1.0)), 0, Two(1.0));
  };
  const auto check = [&](const auto& f) {
    for (const bool first : {true, false}) {
      const double x = 0.7, y = 1.9;
      const auto c =
          expand([&](Scalar t) { return first ? f(t, Scalar(y)) : f(Scalar(x), t); }, line(first ? x : y));
      const Three z = first ? f(variable(x), Three(y)) : f(Three(x), variable(y));
      const double d[] = {z.value.value.value, z.partial(0).value.value, z.partial(0).partial(0).value / 2.0,
                          z.partial(0).partial(0).partial(0) / 6.0};
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(c[k], d[k], 1e-13 * (1.0 + std::abs(d[k]))) << "coefficient " << k;
    }
  };
  std::apply([&](const auto&... f) { (check(f), ...); }, elementary);
}

}  // namespace jet_test
