#include "avi/autodiff/taylor_series.hpp"

#include "avi/autodiff/partials.hpp"
#include "avi/autodiff/recorded.hpp"
#include "unit/elementary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

using avi::TaylorSeries;

namespace taylor_series_test {

constexpr int R = 12;
using Number = avi::DualNumber<1>;
using Scalar = avi::Recorded;
using Series = std::array<Number, R + 2>;

/// Taylor coefficients at t = 0 of f(x(t)), x given by its coefficients.
std::array<double, R + 1> expand(const std::function<Scalar(Scalar)>& f, const Series& x) {
  avi::ExpressionGraph graph(1);
  const int node = f(Scalar(graph, 0)).node_in(graph);
  TaylorSeries<Number> series(graph, {}, {node}, R);
  std::copy(x.begin(), x.end(), series.input(0));
  std::array<double, R + 1> c{};
  for (int k = 0; k <= R; ++k) {
    series.run(k, true);
    c[k] = series.output(series.place(node))[k].value();
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

TEST(TaylorSeries, ElementarySeriesAgreeWithTheirClosedForms) {
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

TEST(TaylorSeries, IdentitiesHoldCoefficientByCoefficient) {
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

TEST(TaylorSeries, ConstantsJoinSeriesByTheirRules) {
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

TEST(TaylorSeries, BoundedFunctionsStayBounded) {
  const auto c = expand([](Scalar x) { return tanh(400.0 * x); }, line(2.0));
  EXPECT_EQ(c[0], 1.0);
  for (int k = 1; k <= R; ++k)
    EXPECT_EQ(c[k], 0.0);
}

TEST(TaylorSeries, TanhIsTheSameOnBothSidesOfZero) {
  const auto at_zero = expand([](Scalar x) { return tanh(x); }, line(0.0));
  const double series[] = {0.0, 1.0, 0.0, -1.0 / 3.0, 0.0, 2.0 / 15.0, 0.0, -17.0 / 315.0};
  for (int k = 0; k <= std::min(R, 7); ++k)
    EXPECT_NEAR(at_zero[k], series[k], 1e-15) << k;
  const auto left = expand([](Scalar x) { return tanh(x); }, line(-20.0));
  const auto right = expand([](Scalar x) { return tanh(x); }, line(20.0));
  const auto far = expand([](Scalar x) { return -2.0 * exp(-2.0 * x); }, line(20.0));  // tanh - 1, nearly
  for (int k = 1; k <= R; ++k) {
    EXPECT_EQ(left[k], k % 2 ? right[k] : -right[k]) << k;
    EXPECT_NEAR(right[k], far[k], 4e-14 * std::abs(far[k])) << k;
  }
}

TEST(TaylorSeries, TakesTheSideOfAZeroFromItsBit) {
  for (const double zero : {0.0, -0.0}) {
    const auto c = expand([](Scalar x) { return abs(x); }, line(zero));
    EXPECT_FALSE(std::signbit(c[0])) << zero;
    EXPECT_EQ(c[1], std::copysign(1.0, zero)) << zero;
  }
}

TEST(TaylorSeries, WholePowersHaveASeriesAtZero) {
  for (const int n : {3, 4, 5, 6, 7, 8, 9, 12, 64, 65, 100, 1023})
    for (const double at : {0.0, 1e-30, -1e-8, 0.7}) {
      const auto c = expand([n](Scalar x) { return pow(x, static_cast<double>(n)); }, line(at));
      double binomial = 1.0;
      for (int k = 0; k <= R; ++k) {
        const double exact = k > n ? 0.0 : binomial * std::pow(at, n - k);
        EXPECT_NEAR(c[k], exact, 1e-14 * (1.0 + n) * std::abs(exact)) << n << ", " << at << ", " << k;
        binomial *= static_cast<double>(n - k) / (k + 1);
      }
    }
}

TEST(TaylorSeries, ChoosesByTheValuesOfEachStart) {
  using avi::select;
  const auto f = [](Scalar x) {
    return select(x < 1.0, x * x, 3.0 * x) + select(x <= 2.0, Scalar(5.0), Scalar(7.0)) + max(x, 1.5);
  };
  const auto of = [&](double a) {
    const auto c = expand(f, line(a));
    return std::vector{c[0], c[1], c[2]};
  };
  EXPECT_EQ(of(0.5), (std::vector{0.25 + 5.0 + 1.5, 1.0, 1.0}));
  EXPECT_EQ(of(1.0), (std::vector{3.0 + 5.0 + 1.5, 3.0, 0.0}));
  EXPECT_EQ(of(4.0), (std::vector{12.0 + 7.0 + 4.0, 4.0, 0.0}));
}

TEST(TaylorSeries, RunsAFormulaOfAnyLengthAnewAtOtherPoints) {
  for (int factors : {10, 5000}) {
    avi::ExpressionGraph graph(1);
    Scalar y(graph, 0);
    for (int i = 0; i < factors; ++i)
      y *= Scalar(graph, 0);
    const int node = y.node_in(graph);
    TaylorSeries<Number> first(graph, {node}, {}, 1);
    TaylorSeries<Number> series = first;  // a copy works in memory of its own
    for (double at : {1.001, 0.999}) {
      series.input(0)[0] = at;
      series.input(0)[1] = 1.0;
      series.run(0, false);
      series.run(1, false);
      const Number* c = series.output(series.place(node));
      EXPECT_NEAR(c[0].value(), std::pow(at, factors + 1), 1e-12 * c[0].value());
      EXPECT_NEAR(c[1].value(), (factors + 1) * std::pow(at, factors), 1e-12 * c[1].value());
    }
    EXPECT_EQ(first.output(first.place(node))[0].value(), 0.0);
  }
}

TEST(TaylorSeries, LeavesOutWhatTheFirstOutputsDoNotNeed) {
  avi::ExpressionGraph graph(2);
  const Scalar x(graph, 0), y(graph, 1);
  const int first = (x * x).node_in(graph), rest = (sin(y) * x).node_in(graph);
  TaylorSeries<Number> series(graph, {first}, {rest, graph.constant(3.0)}, 2);
  series.input(0)[0] = 2.0;
  series.input(1)[0] = 1.0;
  series.run(0, false);
  EXPECT_EQ(series.output(series.place(first))[0].value(), 4.0);
  EXPECT_EQ(series.output(series.place(rest))[0].value(), 0.0);
  series.run(0, true);
  EXPECT_EQ(series.output(series.place(rest))[0].value(), 2.0 * std::sin(1.0));
}

/// Kepler's equations: the coefficients that a series of DualNumber gives do not depend on their number, and
/// its partials are the derivatives of those coefficients.
template <class T>
void expand(std::array<std::array<T, R + 2>, 4>& z) {
  avi::ExpressionGraph graph(4);
  std::array<Scalar, 4> s;
  for (int i = 0; i < 4; ++i)
    s[i] = Scalar(graph, i);
  const Scalar u = pow(s[0] * s[0] + s[1] * s[1], -1.5);
  const int force_x = (s[0] * u).node_in(graph), force_y = (s[1] * u).node_in(graph);
  TaylorSeries<T> series(graph, {}, {force_x, force_y}, 8);
  for (int i = 0; i < 4; ++i)
    series.input(i)[0] = z[i][0];
  for (int k = 0; k <= 8; ++k) {
    series.run(k, true);
    series.input(0)[k + 1] = series.input(2)[k] / (k + 1);
    series.input(1)[k + 1] = series.input(3)[k] / (k + 1);
    series.input(2)[k + 1] = -1.0 * series.output(series.place(force_x))[k] / (k + 1);
    series.input(3)[k + 1] = -1.0 * series.output(series.place(force_y))[k] / (k + 1);
  }
  for (int i = 0; i < 4; ++i)
    std::copy_n(series.input(i), 10, z[i].begin());
}

TEST(TaylorSeries, LanesDifferentiateTaylorCoefficients) {
  const std::array<double, 4> start{1.0, 0.2, -0.1, 0.9};
  const auto coefficients = [&](std::array<double, 4> at) {
    std::array<Series, 4> z;
    for (int i = 0; i < 4; ++i)
      z[i][0] = at[i];
    expand(z);
    return z;
  };
  using L = avi::DualNumber<4>;
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
TEST(TaylorSeries, ElementaryFunctionsHaveTheirThreeDerivatives) {
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

}  // namespace taylor_series_test
