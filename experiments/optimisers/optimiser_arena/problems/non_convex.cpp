#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {
namespace {

/// A start beside a saddle of (x_i^2 - 1)^2 c_i / 4, coupled by differences of neighbours.
Problem saddle(Index n, unsigned long seed) {
  return {"saddle", 1e-3 * Numbers(81 + seed).normals(n), [n](const VectorX& x, VectorX& g) {
            double f = 0.0;
            for (Index i = 0; i < n; ++i) {
              const double c = 1.0 + 9.0 * i / n, w = x[i] * x[i] - 1.0;
              f += 0.25 * c * w * w;
              g[i] = c * w * x[i];
            }
            return add_neighbours(x, f, g, half_square);
          }};
}

/// |M - U V^T|^2 / 4 for a matrix of rank k with a little noise.
Problem factorisation(Index rows, Index k, unsigned long seed) {
  Numbers numbers(91 + seed);
  const Eigen::MatrixXd m =
      numbers.matrix(rows, k) * numbers.matrix(k, rows) + 0.1 * numbers.matrix(rows, rows);
  return {"factorisation", 0.1 * numbers.normals(2 * rows * k), [=](const VectorX& x, VectorX& g) {
            const Eigen::Map<const Eigen::MatrixXd> u(x.data(), rows, k), v(x.data() + rows * k, rows, k);
            const Eigen::MatrixXd r = u * v.transpose() - m;
            Eigen::Map<Eigen::MatrixXd>(g.data(), rows, k).noalias() = 0.5 * r * v;
            Eigen::Map<Eigen::MatrixXd>(g.data() + rows * k, rows, k).noalias() = 0.5 * r.transpose() * u;
            return 0.25 * r.squaredNorm();
          }};
}

/// Intensities (a_i . x)^2 of an unknown x.
Problem phase_retrieval(Index n, Index m, unsigned long seed) {
  Numbers numbers(101 + seed);
  const Eigen::MatrixXd a = numbers.matrix(m, n);
  const VectorX b = (a * numbers.normals(n)).array().square();
  return {"phase_retrieval", numbers.normals(n), [=](const VectorX& x, VectorX& g) {
            const VectorX z = a * x, r = z.array().square() - b.array();
            const double mean = 1.0 / static_cast<double>(m);
            g.noalias() = a.transpose() * (r.array() * z.array()).matrix() * mean;
            return 0.25 * mean * avi::dot(r, r);
          }};
}

/// Two inputs, one hidden layer of tanh, one output: a regression of sin(3 u) cos(2 v), weight decay 1e-4.
Problem perceptron(Index hidden, Index m, unsigned long seed) {
  Numbers numbers(111 + seed);
  const Eigen::MatrixXd in = numbers.matrix(m, 2);
  VectorX target(m);
  for (Index i = 0; i < m; ++i)
    target[i] = std::sin(3.0 * in(i, 0)) * std::cos(2.0 * in(i, 1));
  return {"perceptron", 0.5 * numbers.normals(4 * hidden + 1), [=](const VectorX& x, VectorX& g) {
            const double mean = 1.0 / static_cast<double>(m);
            g = 1e-4 * x;
            double f = 0.5e-4 * avi::dot(x, x);
            const double* out = x.data() + 3 * hidden;
            VectorX a(hidden);
            for (Index i = 0; i < m; ++i) {
              double y = x[4 * hidden];
              for (Index j = 0; j < hidden; ++j) {
                a[j] = std::tanh(x[3 * j] * in(i, 0) + x[3 * j + 1] * in(i, 1) + x[3 * j + 2]);
                y += out[j] * a[j];
              }
              const double r = y - target[i], w = mean * r;
              f += 0.5 * mean * r * r;
              g[4 * hidden] += w;
              for (Index j = 0; j < hidden; ++j) {
                const double back = w * out[j] * (1.0 - a[j] * a[j]);
                g[3 * hidden + j] += w * a[j];
                g[3 * j] += back * in(i, 0);
                g[3 * j + 1] += back * in(i, 1);
                g[3 * j + 2] += back;
              }
            }
            return f;
          }};
}

double styblinski_tang(double x, double& g, Index i) {
  const double c = 1.0 + 0.1 * i;
  g = 0.5 * c * (4.0 * x * x * x - 32.0 * x + 5.0);
  return 0.5 * c * (x * x * x * x - 16.0 * x * x + 5.0 * x);
}
double rastrigin(double x, double& g, Index i) {
  const double c = 1.0 + 0.2 * i;
  g = 2.0 * c * x + 3.0 * std::sin(3.0 * x);
  return c * x * x + 1.0 - std::cos(3.0 * x);
}

/// 13 atoms, V = sum r^-12 - 2 r^-6, from the corners of a jittered lattice.
Problem lennard_jones() {
  VectorX x0(39);
  for (Index i = 0; i < 13; ++i)
    x0.segment<3>(3 * i) = Eigen::Vector3d(i % 3, i / 3 % 3, i / 9);
  x0 += 0.05 * Numbers(121).normals(39);
  return {"lennard_jones", x0, [](const VectorX& x, VectorX& g) {
            g.setZero();
            double f = 0.0;
            for (Index i = 0; i < 13; ++i)
              for (Index j = 0; j < i; ++j) {
                const Eigen::Vector3d apart = x.segment<3>(3 * i) - x.segment<3>(3 * j);
                const double inverse = 1.0 / apart.squaredNorm(), six = inverse * inverse * inverse;
                f += six * (six - 2.0);
                const Eigen::Vector3d force = (12.0 * six * (1.0 - six) * inverse) * apart;
                g.segment<3>(3 * i) += force;
                g.segment<3>(3 * j) -= force;
              }
            return f;
          }};
}

/// sum 100 (x_{i+1} - x_i^2)^2 + (1 - x_i)^2: a long curved valley.
double chained_rosenbrock(const VectorX& x, VectorX& g) {
  g.setZero();
  double f = 0.0;
  for (Index i = 0; i + 1 < x.size(); ++i) {
    const double a = x[i + 1] - x[i] * x[i], b = 1.0 - x[i];
    f += 100.0 * a * a + b * b;
    g[i] += -400.0 * a * x[i] - 2.0 * b;
    g[i + 1] += 200.0 * a;
  }
  return f;
}

}  // namespace

std::vector<Problem> drawn_non_convex_problems(Index k, unsigned long seed) {
  const VectorX spread = 2.0 * Numbers(131 + seed).normals(50 * k);
  return {saddle(200 * k, seed),
          separable("styblinski_tang", spread, styblinski_tang),
          separable("rastrigin", spread, rastrigin),
          factorisation(30 * k, 3, seed),
          phase_retrieval(40 * k, 250 * k, seed),
          perceptron(8 * k, 100 * k, seed)};
}

std::vector<Problem> other_non_convex_problems() {
  return {lennard_jones(),
          {"chained_rosenbrock", Eigen::Vector2d(-1.2, 1.0).replicate(15, 1), chained_rosenbrock}};
}

}  // namespace arena
