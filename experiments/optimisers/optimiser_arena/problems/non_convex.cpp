#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {

namespace {

Problem separable(std::string name, VectorX x0, const auto& term) {
  return {.name = std::move(name),
          .kind = "non_convex",
          .x0 = std::move(x0),
          .f = [term](const VectorX& x, VectorX& g) {
            double f = 0.0;
            for (Eigen::Index i = 0; i < x.size(); ++i)
              f += term(x[i], g[i], i);
            return f;
          }};
}

/// A start beside a saddle of (x_i^2 - 1)^2 c_i / 4, coupled by differences of neighbours.
Problem saddle(Eigen::Index n, unsigned long seed) {
  Numbers numbers(81 + seed);
  return {.name = "saddle",
          .kind = "non_convex",
          .x0 = 1e-3 * numbers.normals(n),
          .f = [n](const VectorX& x, VectorX& g) {
            double f = 0.0;
            for (Eigen::Index i = 0; i < n; ++i) {
              const double c = 1.0 + 9.0 * static_cast<double>(i) / static_cast<double>(n),
                           w = x[i] * x[i] - 1.0;
              f += 0.25 * c * w * w;
              g[i] = c * w * x[i];
            }
            for (Eigen::Index i = 0; i + 1 < n; ++i) {
              const double d = x[i + 1] - x[i];
              f += 0.5 * d * d;
              g[i + 1] += d;
              g[i] -= d;
            }
            return f;
          }};
}

/// |M - U V^T|^2 / 4 for a matrix of rank k with a little noise.
Problem factorisation(Eigen::Index rows, Eigen::Index k, unsigned long seed) {
  Numbers numbers(91 + seed);
  const Eigen::MatrixXd m =
      numbers.matrix(rows, k) * numbers.matrix(k, rows) + 0.1 * numbers.matrix(rows, rows);
  const VectorX x0 = 0.1 * numbers.normals(2 * rows * k);
  return {.name = "factorisation", .kind = "non_convex", .x0 = x0, .f = [=](const VectorX& x, VectorX& g) {
            const Eigen::Map<const Eigen::MatrixXd> u(x.data(), rows, k), v(x.data() + rows * k, rows, k);
            const Eigen::MatrixXd r = u * v.transpose() - m;
            Eigen::Map<Eigen::MatrixXd>(g.data(), rows, k).noalias() = 0.5 * r * v;
            Eigen::Map<Eigen::MatrixXd>(g.data() + rows * k, rows, k).noalias() = 0.5 * r.transpose() * u;
            return 0.25 * r.squaredNorm();
          }};
}

/// Intensities (a_i . x)^2 of an unknown x.
Problem phase_retrieval(Eigen::Index n, Eigen::Index m, unsigned long seed) {
  Numbers numbers(101 + seed);
  const Eigen::MatrixXd a = numbers.matrix(m, n);
  const VectorX b = (a * numbers.normals(n)).array().square();
  const VectorX x0 = numbers.normals(n);
  return {.name = "phase_retrieval", .kind = "non_convex", .x0 = x0, .f = [=](const VectorX& x, VectorX& g) {
            const VectorX z = a * x, r = z.array().square() - b.array();
            const double mean = 1.0 / static_cast<double>(m);
            g.noalias() = a.transpose() * (r.array() * z.array()).matrix() * mean;
            return 0.25 * mean * avi::dot(r, r);
          }};
}

/// Two inputs, one hidden layer of tanh, one output: a regression of sin(3 u) cos(2 v), weight decay 1e-4.
Problem perceptron(Eigen::Index hidden, Eigen::Index m, unsigned long seed) {
  Numbers numbers(111 + seed);
  const Eigen::MatrixXd in = numbers.matrix(m, 2);
  VectorX target(m);
  for (Eigen::Index i = 0; i < m; ++i)
    target[i] = std::sin(3.0 * in(i, 0)) * std::cos(2.0 * in(i, 1));
  const VectorX x0 = 0.5 * numbers.normals(4 * hidden + 1);
  return {.name = "perceptron", .kind = "non_convex", .x0 = x0, .f = [=](const VectorX& x, VectorX& g) {
            const double mean = 1.0 / static_cast<double>(m);
            g = 1e-4 * x;
            double f = 0.5e-4 * avi::dot(x, x);
            const double* out = x.data() + 3 * hidden;
            VectorX a(hidden);
            for (Eigen::Index i = 0; i < m; ++i) {
              double y = x[4 * hidden];
              for (Eigen::Index j = 0; j < hidden; ++j) {
                a[j] = std::tanh(x[3 * j] * in(i, 0) + x[3 * j + 1] * in(i, 1) + x[3 * j + 2]);
                y += out[j] * a[j];
              }
              const double r = y - target[i], w = mean * r;
              f += 0.5 * mean * r * r;
              g[4 * hidden] += w;
              for (Eigen::Index j = 0; j < hidden; ++j) {
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

/// 13 atoms, V = sum r^-12 - 2 r^-6, from the corners of a jittered lattice.
Problem lennard_jones() {
  Numbers numbers(121);
  VectorX x0(39);
  for (Eigen::Index i = 0; i < 13; ++i) {
    x0[3 * i] = static_cast<double>(i % 3), x0[3 * i + 1] = static_cast<double>(i / 3 % 3);
    x0[3 * i + 2] = static_cast<double>(i / 9);
  }
  x0 += 0.05 * numbers.normals(39);
  return {.name = "lennard_jones", .kind = "non_convex", .x0 = x0, .f = [](const VectorX& x, VectorX& g) {
            g.setZero();
            double f = 0.0;
            for (Eigen::Index i = 0; i < 13; ++i)
              for (Eigen::Index j = 0; j < i; ++j) {
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
Problem chained_rosenbrock(Eigen::Index n) {
  VectorX x0 = VectorX::Ones(n);
  for (Eigen::Index i = 0; i < n; i += 2)
    x0[i] = -1.2;
  return {
      .name = "chained_rosenbrock", .kind = "non_convex", .x0 = x0, .f = [n](const VectorX& x, VectorX& g) {
        g.setZero();
        double f = 0.0;
        for (Eigen::Index i = 0; i + 1 < n; ++i) {
          const double a = x[i + 1] - x[i] * x[i], b = 1.0 - x[i];
          f += 100.0 * a * a + b * b;
          g[i] += -400.0 * a * x[i] - 2.0 * b;
          g[i + 1] += 200.0 * a;
        }
        return f;
      }};
}

}  // namespace

std::vector<Problem> drawn_non_convex_problems(const Draw& draw) {
  const Eigen::Index k = draw.times;
  const unsigned long seed = draw.seed;
  const VectorX spread = 2.0 * Numbers(131 + seed).normals(50 * k);
  return named(draw, {saddle(200 * k, seed),
                      separable("styblinski_tang", spread,
                                [](double x, double& g, Eigen::Index i) {
                                  const double c = 1.0 + 0.1 * static_cast<double>(i);
                                  g = 0.5 * c * (4.0 * x * x * x - 32.0 * x + 5.0);
                                  return 0.5 * c * (x * x * x * x - 16.0 * x * x + 5.0 * x);
                                }),
                      separable("rastrigin", spread,
                                [](double x, double& g, Eigen::Index i) {
                                  const double c = 1.0 + 0.2 * static_cast<double>(i);
                                  g = 2.0 * c * x + 3.0 * std::sin(3.0 * x);
                                  return c * x * x + 1.0 - std::cos(3.0 * x);
                                }),
                      factorisation(30 * k, 3, seed), phase_retrieval(40 * k, 250 * k, seed),
                      perceptron(8 * k, 100 * k, seed)});
}

std::vector<Problem> non_convex_problems() {
  std::vector<Problem> all = drawn_non_convex_problems({});
  all.push_back(lennard_jones());
  all.push_back(chained_rosenbrock(30));
  return all;
}

}  // namespace arena
