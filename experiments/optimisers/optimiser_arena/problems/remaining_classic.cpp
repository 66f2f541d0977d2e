#include "avi/optim/recorded_objective.hpp"
#include "optimisers/optimiser_arena/problems/problem.hpp"

#include <memory>

// More, Garbow and Hillstrom's problems (1981) that classic.cpp lacks and that need no table of measured
// numbers, the linear ones apart; 10 dimensions where it is free, 6 for Watson's. Formulas, whose gradients
// are automatic, and at the end the table of names and starts.

namespace arena {
namespace {

auto square(const auto& r) { return r * r; }

/// f and the squares of residual(first) to residual(last).
auto add_squares(auto f, Index first, Index last, const auto& residual) {
  for (Index i = first; i <= last; ++i)
    f += square(residual(i));
  return f;
}

constexpr auto freudenstein_roth = [](const auto& x) {
  return square(-13.0 + x[0] + ((5.0 - x[1]) * x[1] - 2.0) * x[1]) +
         square(-29.0 + x[0] + ((x[1] + 1.0) * x[1] - 14.0) * x[1]);
};

constexpr auto powell_badly_scaled = [](const auto& x) {
  return square(1e4 * x[0] * x[1] - 1.0) + square(exp(-x[0]) + exp(-x[1]) - 1.0001);
};

constexpr auto jennrich_sampson = [](const auto& x) {
  return add_squares(x[0] * 0.0, 1, 10,
                     [&](double i) { return 2.0 + 2.0 * i - exp(i * x[0]) - exp(i * x[1]); });
};

constexpr auto gulf = [](const auto& x) {
  return add_squares(x[0] * 0.0, 1, 99, [&](double i) {
    const double t = 0.01 * i, y = 25.0 + std::cbrt(square(-50.0 * std::log(t)));
    return exp(-exp(x[2] * log(abs(y - x[1]))) / x[0]) - t;
  });
};

constexpr auto box = [](const auto& x) {
  return add_squares(x[0] * 0.0, 1, 10, [&](double i) {
    const double t = 0.1 * i;
    return exp(-t * x[0]) - exp(-t * x[1]) - (std::exp(-t) - std::exp(-10.0 * t)) * x[2];
  });
};

constexpr auto brown_dennis = [](const auto& x) {
  return add_squares(x[0] * 0.0, 1, 20, [&](double i) {
    const double t = 0.2 * i;
    return square(x[0] + t * x[1] - std::exp(t)) + square(x[2] + std::sin(t) * x[3] - std::cos(t));
  });
};

constexpr auto watson = [](const auto& x) {
  const Index last = x.size() - 1;
  return add_squares(square(x[0]) + square(x[1] - x[0] * x[0] - 1.0), 1, 29, [&](double i) {
    const double t = i / 29.0;
    auto sum = x[last] * 1.0, slope = x[last] * static_cast<double>(last);
    for (Index j = last; j-- > 0;) {
      sum = sum * t + x[j];
      if (j > 0) slope = slope * t + x[j] * static_cast<double>(j);
    }
    return slope - sum * sum - 1.0;
  });
};

constexpr auto penalty_2 = [](const auto& x) {
  const Index n = x.size();
  auto f = square(x[0] - 0.2), weighed = x[0] * x[0] * static_cast<double>(n);
  for (Index i = 1; i < n; ++i) {
    const auto now = exp(x[i] * 0.1);
    f += 1e-5 * square(now + exp(x[i - 1] * 0.1) - std::exp(0.1 * (i + 1.0)) - std::exp(0.1 * i));
    f += 1e-5 * square(now - std::exp(-0.1));
    weighed += x[i] * x[i] * static_cast<double>(n - i);
  }
  return f + square(weighed - 1.0);
};

constexpr auto brown_almost_linear = [](const auto& x) {
  const Index n = x.size();
  auto sum = x[0] * 1.0, product = x[0] * 1.0;
  for (Index i = 1; i < n; ++i)
    sum += x[i], product = product * x[i];
  auto f = square(product - 1.0);
  for (Index i = 0; i + 1 < n; ++i)
    f += square(x[i] + sum - (n + 1.0));
  return f;
};

double node(Index i, Index n) { return (i + 1.0) / (n + 1.0); }

constexpr auto integral_equation = [](const auto& x) {
  const Index n = x.size();
  return add_squares(x[0] * 0.0, 0, n - 1, [&](Index i) {
    const double t = node(i, n), h = 1.0 / (n + 1.0);
    auto r = x[i] * 1.0;
    for (Index j = 0; j < n; ++j) {
      const double u = node(j, n), weight = j <= i ? (1.0 - t) * u : t * (1.0 - u);
      const auto c = x[j] + (u + 1.0);
      r += 0.5 * h * weight * c * c * c;
    }
    return r;
  });
};

constexpr auto broyden_banded = [](const auto& x) {
  const Index last = x.size() - 1;
  return add_squares(x[0] * 0.0, 0, last, [&](Index i) {
    auto r = x[i] * (2.0 + 5.0 * x[i] * x[i]) + 1.0;
    for (Index j = std::max<Index>(0, i - 5); j <= std::min(last, i + 1); ++j)
      if (j != i) r = r - x[j] * (1.0 + x[j]);
    return r;
  });
};

Problem formula(const char* name, VectorX x0, const auto& f) {
  const auto recorded = std::make_shared<avi::RecordedObjective>(f, x0.size());
  return {name, std::move(x0), [recorded](const VectorX& x, VectorX& g) { return (*recorded)(x, g); }};
}

}  // namespace

std::vector<Problem> remaining_classic_problems() {
  VectorX nodes(10);
  for (Index i = 0; i < 10; ++i)
    nodes[i] = node(i, 10) * (node(i, 10) - 1.0);
  return {formula("freudenstein_roth", Eigen::Vector2d(0.5, -2.0), freudenstein_roth),
          formula("powell_badly_scaled", Eigen::Vector2d(0.0, 1.0), powell_badly_scaled),
          formula("jennrich_sampson", Eigen::Vector2d(0.3, 0.4), jennrich_sampson),
          formula("gulf", Eigen::Vector3d(5.0, 2.5, 0.15), gulf),
          formula("box", Eigen::Vector3d(0.0, 10.0, 20.0), box),
          formula("brown_dennis", Eigen::Vector4d(25.0, 5.0, -5.0, -1.0), brown_dennis),
          formula("watson", VectorX::Zero(6), watson),
          formula("penalty_2", VectorX::Constant(10, 0.5), penalty_2),
          formula("brown_almost_linear", VectorX::Constant(10, 0.5), brown_almost_linear),
          formula("integral_equation", nodes, integral_equation),
          formula("broyden_banded", VectorX::Constant(10, -1.0), broyden_banded)};
}

}  // namespace arena
