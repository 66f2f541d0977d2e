#include "optimisers/optimiser_arena/problems/problem.hpp"

// Unconstrained test problems of More, Garbow and Hillstrom (1981), written as sums of squares: each gives
// its residuals and, for the gradient, adds residual times row of the Jacobian.

namespace arena {

namespace {

Problem squares(std::string name, VectorX x0, const auto& terms) {
  return {.name = std::move(name),
          .kind = "classic",
          .x0 = std::move(x0),
          .f = [terms](const VectorX& x, VectorX& g) {
            g.setZero();
            double f = 0.0;
            terms(x, g, f);
            return f;
          }};
}

VectorX repeat(const VectorX& pattern, Eigen::Index n) { return pattern.replicate(n / pattern.size(), 1); }

Problem rosenbrock(const std::string& name, Eigen::Index n) {
  return squares(name, repeat(Eigen::Vector2d(-1.2, 1.0), n), [](const VectorX& x, VectorX& g, double& f) {
    for (Eigen::Index i = 0; i < x.size(); i += 2) {
      const double a = 10.0 * (x[i + 1] - x[i] * x[i]), b = 1.0 - x[i];
      f += a * a + b * b;
      g[i] += -40.0 * a * x[i] - 2.0 * b;
      g[i + 1] += 20.0 * a;
    }
  });
}

Problem powell_singular(Eigen::Index n) {
  return squares("powell_singular", repeat(Eigen::Vector4d(3.0, -1.0, 0.0, 1.0), n),
                 [](const VectorX& x, VectorX& g, double& f) {
                   for (Eigen::Index i = 0; i < x.size(); i += 4) {
                     const double a = x[i] + 10.0 * x[i + 1], b = x[i + 2] - x[i + 3];
                     const double c = x[i + 1] - 2.0 * x[i + 2], d = x[i] - x[i + 3];
                     f += a * a + 5.0 * b * b + c * c * c * c + 10.0 * d * d * d * d;
                     const double c3 = 4.0 * c * c * c, d3 = 40.0 * d * d * d;
                     g[i] += 2.0 * a + d3;
                     g[i + 1] += 20.0 * a + c3;
                     g[i + 2] += 10.0 * b - 2.0 * c3;
                     g[i + 3] += -10.0 * b - d3;
                   }
                 });
}

Problem wood() {
  return squares(
      "wood", Eigen::Vector4d(-3.0, -1.0, -3.0, -1.0), [](const VectorX& x, VectorX& g, double& f) {
        const double a = x[1] - x[0] * x[0], b = 1.0 - x[0], c = x[3] - x[2] * x[2], d = 1.0 - x[2];
        const double u = x[1] + x[3] - 2.0, v = x[1] - x[3];
        f = 100.0 * a * a + b * b + 90.0 * c * c + d * d + 10.0 * u * u + 0.1 * v * v;
        g[0] = -400.0 * a * x[0] - 2.0 * b;
        g[1] = 200.0 * a + 20.0 * u + 0.2 * v;
        g[2] = -360.0 * c * x[2] - 2.0 * d;
        g[3] = 180.0 * c + 20.0 * u - 0.2 * v;
      });
}

Problem beale() {
  return squares("beale", Eigen::Vector2d(1.0, 1.0), [](const VectorX& x, VectorX& g, double& f) {
    const double targets[3] = {1.5, 2.25, 2.625};
    double power = 1.0;
    for (int i = 0; i < 3; ++i) {
      const double lower = power;
      power *= x[1];
      const double r = targets[i] - x[0] * (1.0 - power);
      f += r * r;
      g[0] += -2.0 * r * (1.0 - power);
      g[1] += 2.0 * r * x[0] * (i + 1.0) * lower;
    }
  });
}

Problem helical_valley() {
  return squares("helical_valley", Eigen::Vector3d(-1.0, 0.0, 0.0),
                 [](const VectorX& x, VectorX& g, double& f) {
                   const double turn = 2.0 * std::numbers::pi, square = x[0] * x[0] + x[1] * x[1],
                                radius = std::sqrt(square);
                   double theta = std::atan(x[1] / x[0]) / turn;
                   if (x[0] < 0.0) theta += 0.5;
                   if (x[0] == 0.0) theta = std::copysign(0.25, x[1]);
                   const double a = 10.0 * (x[2] - 10.0 * theta), b = 10.0 * (radius - 1.0);
                   f = a * a + b * b + x[2] * x[2];
                   const double t0 = -x[1] / (turn * square), t1 = x[0] / (turn * square);
                   g[0] = -200.0 * a * t0 + 20.0 * b * x[0] / radius;
                   g[1] = -200.0 * a * t1 + 20.0 * b * x[1] / radius;
                   g[2] = 20.0 * a + 2.0 * x[2];
                 });
}

Problem brown_badly_scaled() {
  return squares("brown_badly_scaled", Eigen::Vector2d(1.0, 1.0),
                 [](const VectorX& x, VectorX& g, double& f) {
                   const double a = x[0] - 1e6, b = x[1] - 2e-6, c = x[0] * x[1] - 2.0;
                   f = a * a + b * b + c * c;
                   g[0] = 2.0 * (a + c * x[1]);
                   g[1] = 2.0 * (b + c * x[0]);
                 });
}

Problem broyden_tridiagonal(Eigen::Index n) {
  return squares("broyden_tridiagonal", VectorX::Constant(n, -1.0),
                 [](const VectorX& x, VectorX& g, double& f) {
                   const Eigen::Index last = x.size() - 1;
                   for (Eigen::Index i = 0; i <= last; ++i) {
                     const double r = (3.0 - 2.0 * x[i]) * x[i] - (i > 0 ? x[i - 1] : 0.0) -
                                      (i < last ? 2.0 * x[i + 1] : 0.0) + 1.0;
                     f += r * r;
                     g[i] += 2.0 * r * (3.0 - 4.0 * x[i]);
                     if (i > 0) g[i - 1] -= 2.0 * r;
                     if (i < last) g[i + 1] -= 4.0 * r;
                   }
                 });
}

Problem variably_dimensioned(Eigen::Index n) {
  VectorX x0(n);
  for (Eigen::Index i = 0; i < n; ++i)
    x0[i] = 1.0 - static_cast<double>(i + 1) / static_cast<double>(n);
  return squares("variably_dimensioned", x0, [](const VectorX& x, VectorX& g, double& f) {
    double s = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      s += (static_cast<double>(i) + 1.0) * (x[i] - 1.0);
      f += (x[i] - 1.0) * (x[i] - 1.0);
    }
    f += s * s + s * s * s * s;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      g[i] = 2.0 * (x[i] - 1.0) + (static_cast<double>(i) + 1.0) * (2.0 * s + 4.0 * s * s * s);
  });
}

Problem penalty_1(Eigen::Index n) {
  VectorX x0(n);
  for (Eigen::Index i = 0; i < n; ++i)
    x0[i] = static_cast<double>(i + 1);
  return squares("penalty_1", x0, [](const VectorX& x, VectorX& g, double& f) {
    const double excess = avi::dot(x, x) - 0.25;
    f = excess * excess;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      f += 1e-5 * (x[i] - 1.0) * (x[i] - 1.0);
      g[i] = 2e-5 * (x[i] - 1.0) + 4.0 * excess * x[i];
    }
  });
}

Problem trigonometric(Eigen::Index n) {
  return squares("trigonometric", VectorX::Constant(n, 1.0 / static_cast<double>(n)),
                 [](const VectorX& x, VectorX& g, double& f) {
                   const Eigen::Index size = x.size();
                   double cosines = 0.0, residuals = 0.0;
                   for (const double entry : x)
                     cosines += std::cos(entry);
                   VectorX r(size);
                   for (Eigen::Index i = 0; i < size; ++i) {
                     r[i] = static_cast<double>(size) - cosines +
                            (static_cast<double>(i) + 1.0) * (1.0 - std::cos(x[i])) - std::sin(x[i]);
                     f += r[i] * r[i];
                     residuals += r[i];
                   }
                   for (Eigen::Index i = 0; i < size; ++i)
                     g[i] = 2.0 * (std::sin(x[i]) * residuals +
                                   r[i] * ((static_cast<double>(i) + 1.0) * std::sin(x[i]) - std::cos(x[i])));
                 });
}

Problem biggs_exp6() {
  VectorX x0(6);
  x0 << 1.0, 2.0, 1.0, 1.0, 1.0, 1.0;
  return squares("biggs_exp6", x0, [](const VectorX& x, VectorX& g, double& f) {
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
  });
}

Problem boundary_value(Eigen::Index n) {
  const double h = 1.0 / static_cast<double>(n + 1);
  VectorX x0(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i + 1) * h;
    x0[i] = t * (t - 1.0);
  }
  return squares("boundary_value", x0, [h](const VectorX& x, VectorX& g, double& f) {
    const Eigen::Index last = x.size() - 1;
    for (Eigen::Index i = 0; i <= last; ++i) {
      const double c = x[i] + static_cast<double>(i + 1) * h + 1.0;
      const double r =
          2.0 * x[i] - (i > 0 ? x[i - 1] : 0.0) - (i < last ? x[i + 1] : 0.0) + 0.5 * h * h * c * c * c;
      f += r * r;
      g[i] += 2.0 * r * (2.0 + 1.5 * h * h * c * c);
      if (i > 0) g[i - 1] -= 2.0 * r;
      if (i < last) g[i + 1] -= 2.0 * r;
    }
  });
}

}  // namespace

std::vector<Problem> classic_problems() {
  return {rosenbrock("rosenbrock", 2),
          rosenbrock("rosenbrock_100", 100),
          powell_singular(40),
          wood(),
          beale(),
          helical_valley(),
          brown_badly_scaled(),
          broyden_tridiagonal(100),
          variably_dimensioned(50),
          penalty_1(20),
          trigonometric(50),
          biggs_exp6(),
          boundary_value(20)};
}

}  // namespace arena
