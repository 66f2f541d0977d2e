#include "optimisers/optimiser_arena/problems/problem.hpp"

// Unconstrained test problems of More, Garbow and Hillstrom (1981): a function each, and at the end the table
// of names and starts.

namespace arena {
namespace {

double rosenbrock(const VectorX& x, VectorX& g) {
  double f = 0.0;
  for (Index i = 0; i < x.size(); i += 2) {
    const double a = 10.0 * (x[i + 1] - x[i] * x[i]), b = 1.0 - x[i];
    f += a * a + b * b;
    g[i] = -40.0 * a * x[i] - 2.0 * b;
    g[i + 1] = 20.0 * a;
  }
  return f;
}

double powell_singular(const VectorX& x, VectorX& g) {
  double f = 0.0;
  for (Index i = 0; i < x.size(); i += 4) {
    const double a = x[i] + 10.0 * x[i + 1], b = x[i + 2] - x[i + 3];
    const double c = x[i + 1] - 2.0 * x[i + 2], d = x[i] - x[i + 3];
    f += a * a + 5.0 * b * b + c * c * c * c + 10.0 * d * d * d * d;
    const double c3 = 4.0 * c * c * c, d3 = 40.0 * d * d * d;
    g.segment<4>(i) << 2.0 * a + d3, 20.0 * a + c3, 10.0 * b - 2.0 * c3, -10.0 * b - d3;
  }
  return f;
}

double wood(const VectorX& x, VectorX& g) {
  const double a = x[1] - x[0] * x[0], b = 1.0 - x[0], c = x[3] - x[2] * x[2], d = 1.0 - x[2];
  const double u = x[1] + x[3] - 2.0, v = x[1] - x[3];
  g[0] = -400.0 * a * x[0] - 2.0 * b;
  g[1] = 200.0 * a + 20.0 * u + 0.2 * v;
  g[2] = -360.0 * c * x[2] - 2.0 * d;
  g[3] = 180.0 * c + 20.0 * u - 0.2 * v;
  return 100.0 * a * a + b * b + 90.0 * c * c + d * d + 10.0 * u * u + 0.1 * v * v;
}

double beale(const VectorX& x, VectorX& g) {
  const double targets[3] = {1.5, 2.25, 2.625};
  double f = 0.0, power = 1.0;
  g.setZero();
  for (int i = 0; i < 3; ++i) {
    const double lower = power;
    power *= x[1];
    const double r = targets[i] - x[0] * (1.0 - power);
    f += r * r;
    g[0] -= 2.0 * r * (1.0 - power);
    g[1] += 2.0 * r * x[0] * (i + 1.0) * lower;
  }
  return f;
}

double helical_valley(const VectorX& x, VectorX& g) {
  const double turn = 2.0 * std::numbers::pi, square = x[0] * x[0] + x[1] * x[1], radius = std::sqrt(square);
  double theta = std::atan(x[1] / x[0]) / turn;
  if (x[0] < 0.0) theta += 0.5;
  if (x[0] == 0.0) theta = std::copysign(0.25, x[1]);
  const double a = 10.0 * (x[2] - 10.0 * theta), b = 10.0 * (radius - 1.0);
  g[0] = -200.0 * a * (-x[1] / (turn * square)) + 20.0 * b * x[0] / radius;
  g[1] = -200.0 * a * (x[0] / (turn * square)) + 20.0 * b * x[1] / radius;
  g[2] = 20.0 * a + 2.0 * x[2];
  return a * a + b * b + x[2] * x[2];
}

double brown_badly_scaled(const VectorX& x, VectorX& g) {
  const double a = x[0] - 1e6, b = x[1] - 2e-6, c = x[0] * x[1] - 2.0;
  g[0] = 2.0 * (a + c * x[1]);
  g[1] = 2.0 * (b + c * x[0]);
  return a * a + b * b + c * c;
}

double broyden_tridiagonal(const VectorX& x, VectorX& g) {
  const Index last = x.size() - 1;
  double f = 0.0;
  g.setZero();
  for (Index i = 0; i <= last; ++i) {
    const double before = i > 0 ? x[i - 1] : 0.0, after = i < last ? x[i + 1] : 0.0;
    const double r = (3.0 - 2.0 * x[i]) * x[i] - before - 2.0 * after + 1.0;
    f += r * r;
    g[i] += 2.0 * r * (3.0 - 4.0 * x[i]);
    if (i > 0) g[i - 1] -= 2.0 * r;
    if (i < last) g[i + 1] -= 4.0 * r;
  }
  return f;
}

double boundary_value(const VectorX& x, VectorX& g) {
  const Index last = x.size() - 1;
  const double h = 1.0 / (last + 2.0);
  double f = 0.0;
  g.setZero();
  for (Index i = 0; i <= last; ++i) {
    const double before = i > 0 ? x[i - 1] : 0.0, after = i < last ? x[i + 1] : 0.0;
    const double c = x[i] + (i + 1.0) * h + 1.0;
    const double r = 2.0 * x[i] - before - after + 0.5 * h * h * c * c * c;
    f += r * r;
    g[i] += 2.0 * r * (2.0 + 1.5 * h * h * c * c);
    if (i > 0) g[i - 1] -= 2.0 * r;
    if (i < last) g[i + 1] -= 2.0 * r;
  }
  return f;
}

double variably_dimensioned(const VectorX& x, VectorX& g) {
  double s = 0.0, f = 0.0;
  for (Index i = 0; i < x.size(); ++i) {
    s += (i + 1.0) * (x[i] - 1.0);
    f += (x[i] - 1.0) * (x[i] - 1.0);
  }
  for (Index i = 0; i < x.size(); ++i)
    g[i] = 2.0 * (x[i] - 1.0) + (i + 1.0) * (2.0 * s + 4.0 * s * s * s);
  return f + (s * s + s * s * s * s);
}

double penalty_1(const VectorX& x, VectorX& g) {
  const double excess = avi::dot(x, x) - 0.25;
  double f = excess * excess;
  for (Index i = 0; i < x.size(); ++i) {
    f += 1e-5 * (x[i] - 1.0) * (x[i] - 1.0);
    g[i] = 2e-5 * (x[i] - 1.0) + 4.0 * excess * x[i];
  }
  return f;
}

double trigonometric(const VectorX& x, VectorX& g) {
  const Index n = x.size();
  double f = 0.0, cosines = 0.0, residuals = 0.0;
  for (const double entry : x)
    cosines += std::cos(entry);
  for (Index i = 0; i < n; ++i) {
    g[i] = n - cosines + (i + 1.0) * (1.0 - std::cos(x[i])) - std::sin(x[i]);
    f += g[i] * g[i];
    residuals += g[i];
  }
  for (Index i = 0; i < n; ++i)
    g[i] = 2.0 * (std::sin(x[i]) * residuals + g[i] * ((i + 1.0) * std::sin(x[i]) - std::cos(x[i])));
  return f;
}

double biggs_exp6(const VectorX& x, VectorX& g) {
  double f = 0.0;
  g.setZero();
  for (int i = 1; i <= 13; ++i) {
    const double t = 0.1 * i, y = std::exp(-t) - 5.0 * std::exp(-10.0 * t) + 3.0 * std::exp(-4.0 * t);
    const double a = std::exp(-t * x[0]), b = std::exp(-t * x[1]), c = std::exp(-t * x[4]);
    const double r = x[2] * a - x[3] * b + x[5] * c - y;
    f += r * r;
    g[0] -= 2.0 * r * t * x[2] * a;
    g[1] += 2.0 * r * t * x[3] * b;
    g[2] += 2.0 * r * a;
    g[3] -= 2.0 * r * b;
    g[4] -= 2.0 * r * t * x[5] * c;
    g[5] += 2.0 * r * c;
  }
  return f;
}

/// (1, 2, ..., n).
Eigen::ArrayXd count(Index n) { return Eigen::ArrayXd::LinSpaced(n, 1.0, static_cast<double>(n)); }

}  // namespace

std::vector<Problem> classic_problems() {
  const Eigen::ArrayXd node = count(20) * (1.0 / 21.0);
  VectorX biggs = VectorX::Ones(6);
  biggs[1] = 2.0;
  return {{"rosenbrock", Eigen::Vector2d(-1.2, 1.0), rosenbrock},
          {"rosenbrock_100", Eigen::Vector2d(-1.2, 1.0).replicate(50, 1), rosenbrock},
          {"powell_singular", Eigen::Vector4d(3.0, -1.0, 0.0, 1.0).replicate(10, 1), powell_singular},
          {"wood", Eigen::Vector4d(-3.0, -1.0, -3.0, -1.0), wood},
          {"beale", Eigen::Vector2d(1.0, 1.0), beale},
          {"helical_valley", Eigen::Vector3d(-1.0, 0.0, 0.0), helical_valley},
          {"brown_badly_scaled", Eigen::Vector2d(1.0, 1.0), brown_badly_scaled},
          {"broyden_tridiagonal", VectorX::Constant(100, -1.0), broyden_tridiagonal},
          {"variably_dimensioned", 1.0 - count(50) / 50.0, variably_dimensioned},
          {"penalty_1", count(20), penalty_1},
          {"trigonometric", VectorX::Constant(50, 1.0 / 50.0), trigonometric},
          {"biggs_exp6", biggs, biggs_exp6},
          {"boundary_value", node * (node - 1.0), boundary_value}};
}

}  // namespace arena
