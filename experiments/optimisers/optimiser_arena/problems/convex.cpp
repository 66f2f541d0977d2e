#include "common/problems/correlated_quartic.hpp"
#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {
namespace {

/// Walsh and Hadamard's transform of 2^k entries, symmetric and orthogonal.
void mix(VectorX& x) {
  const Index n = x.size();
  for (Index width = 1; width < n; width *= 2)
    for (Index from = 0; from < n; from += 2 * width)
      for (Index i = from; i < from + width; ++i) {
        const double a = x[i], b = x[i + width];
        x[i] = a + b, x[i + width] = a - b;
      }
  x /= std::sqrt(static_cast<double>(n));
}

/// y . C y / 2 with y = W x, W orthogonal and dense (n a power of 2), C diagonal from 1 to kappa, equally
/// spaced in the logarithm. Without W, methods with a learning rate for each entry would know the
/// eigenvectors.
Problem quadratic(const std::string& name, double kappa, Index n) {
  VectorX c(n);
  for (Index i = 0; i < n; ++i)
    c[i] = std::pow(kappa, i / (n - 1.0));
  return {name, Numbers(7).normals(n), [c](const VectorX& x, VectorX& g) {
            VectorX y = x;
            mix(y);
            g = c.cwiseProduct(y);
            const double f = 0.5 * avi::dot(y, g);
            mix(g);
            return f;
          }};
}

Problem quartic(const std::string& name, Index n) {
  const experiment::CorrelatedQuartic f(n);
  return {name, f.start(), f};
}

/// Nesterov's worst case for methods of first order (2004, Section 2.1.2) with L = 4.
double worst_case(const VectorX& x, VectorX& g) {
  const double first = x[0], last = x[x.size() - 1];
  g.setZero();
  g[0] += first - 1.0;
  g[x.size() - 1] += last;
  return add_neighbours(x, 0.5 * (first * first + last * last) - first, g, half_square);
}

/// rho log sum_i exp((a_i . x - b_i) / rho).
Problem log_sum_exp(Index n, Index m, double rho) {
  Numbers numbers(11);
  const Eigen::MatrixXd a = numbers.matrix(m, n);
  const VectorX b = numbers.normals(m);
  return {"log_sum_exp", numbers.normals(n), [=](const VectorX& x, VectorX& g) {
            VectorX z = (a * x - b) / rho;
            const double top = z.maxCoeff();
            for (double& entry : z)
              entry = std::exp(entry - top);
            const double sum = z.sum();
            g.noalias() = a.transpose() * (z / sum);
            return rho * (top + std::log(sum));
          }};
}

/// Dirichlet energy of a membrane on the unit square, side x side inner points, under a smooth load.
Problem poisson(const std::string& name, Index side) {
  return {name, VectorX::Zero(side * side), [side](const VectorX& x, VectorX& g) {
            const double h = 1.0 / (side + 1.0);
            double f = 0.0;
            for (Index i = 0; i < side; ++i)
              for (Index j = 0; j < side; ++j) {
                const Index k = i * side + j;
                const double u = x[k], up = i > 0 ? x[k - side] : 0.0,
                             down = i + 1 < side ? x[k + side] : 0.0;
                const double left = j > 0 ? x[k - 1] : 0.0, right = j + 1 < side ? x[k + 1] : 0.0;
                const double load = h * h * std::exp((i + 1.0) * h),
                             image = 4.0 * u - up - down - left - right;
                g[k] = image - load;
                f += u * (0.5 * image - load);
              }
            return f;
          }};
}

/// Area of a surface over the unit square with boundary values sin(3 x) (1 - y) + y^2, by triangles.
Problem minimal_surface(Index side) {
  const double h = 1.0 / (side + 1.0);
  Eigen::MatrixXd frame = Eigen::MatrixXd::Zero(side + 2, side + 2);  // (j, i): what is inside is free
  for (Index i = 0; i < side + 2; ++i)
    for (Index j = 0; j < side + 2; ++j)
      frame(j, i) = std::sin(3.0 * (i * h)) * (1.0 - j * h) + (j * h) * (j * h);
  return {"minimal_surface", VectorX::Zero(side * side), [=](const VectorX& x, VectorX& g) {
            Eigen::MatrixXd z = frame, slope = Eigen::MatrixXd::Zero(side + 2, side + 2);
            z.block(1, 1, side, side) = Eigen::Map<const Eigen::MatrixXd>(x.data(), side, side);
            double f = 0.0;
            for (Index i = 0; i <= side; ++i)
              for (Index j = 0; j <= side; ++j)
                for (int half = 0; half < 2; ++half) {
                  const Index a = i + half, b = j + half, s = half == 0 ? 1 : -1;
                  const double u = (z(b, a + s) - z(b, a)) / h, v = (z(b + s, a) - z(b, a)) / h;
                  const double area = std::sqrt(1.0 + u * u + v * v);
                  f += 0.5 * h * h * area;
                  const double c = 0.5 * h / area;
                  slope(b, a + s) += c * u, slope(b + s, a) += c * v, slope(b, a) += -c * (u + v);
                }
            Eigen::Map<Eigen::MatrixXd>(g.data(), side, side) = slope.block(1, 1, side, side);
            return f;
          }};
}

}  // namespace

std::vector<Problem> convex_problems(bool large) {
  std::vector<Problem> all{quartic("quartic", 50),
                           quadratic("quadratic_1e2", 1e2, 1024),
                           quadratic("quadratic_1e4", 1e4, 1024),
                           quadratic("quadratic_1e6", 1e6, 512),
                           {"worst_case", VectorX::Zero(200), worst_case},
                           log_sum_exp(50, 200, 1.0),
                           poisson("membrane", 60),
                           minimal_surface(30),
                           quartic("quartic_large", large ? 1'000'000 : 100'000)};
  if (large) all.push_back(poisson("membrane_large", 400));
  return all;
}

}  // namespace arena
