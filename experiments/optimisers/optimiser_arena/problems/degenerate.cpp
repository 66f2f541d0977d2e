#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {

namespace {

/// Between 1/2 and 3/2. From (1, 1, ...) methods whose first step has the length of their learning rate in
/// every entry would land on the minimiser by accident.
VectorX scattered(Eigen::Index n) {
  Numbers numbers(161);
  VectorX x(n);
  for (double& entry : x)
    entry = 0.5 + numbers.uniform();
  return x;
}

/// sum_i i |x_i|^k / k, k even: the Hessian vanishes at the minimum.
Problem power(const std::string& name, Eigen::Index n, int k) {
  return {.name = name, .kind = "degenerate", .x0 = scattered(n), .f = [k](const VectorX& x, VectorX& g) {
            double f = 0.0;
            for (Eigen::Index i = 0; i < x.size(); ++i) {
              const double c = static_cast<double>(i) + 1.0;
              double up = c;
              for (int j = 1; j < k; ++j)
                up *= x[i];
              g[i] = up;
              f += up * x[i] / k;
            }
            return f;
          }};
}

/// sum_i i (x_i^2 + 1e-4)^(3/4): nearly |x|^1.5, steep beside the minimum.
Problem blunt(Eigen::Index n) {
  return {.name = "blunt", .kind = "degenerate", .x0 = scattered(n), .f = [](const VectorX& x, VectorX& g) {
            double f = 0.0;
            for (Eigen::Index i = 0; i < x.size(); ++i) {
              const double c = static_cast<double>(i) + 1.0, square = x[i] * x[i] + 1e-4;
              const double root = std::sqrt(std::sqrt(square));
              f += c * root * root * root;
              g[i] = 1.5 * c * x[i] / root;
            }
            return f;
          }};
}

/// Least squares of rank n / 2 without noise: a subspace of minimisers.
Problem rank_deficient(Eigen::Index n) {
  Numbers numbers(141);
  Eigen::MatrixXd a = numbers.matrix(n / 2, n);
  for (Eigen::Index i = 0; i < n / 2; ++i)
    a.row(i) *= std::pow(10.0, -2.0 * static_cast<double>(i) / static_cast<double>(n / 2));
  const VectorX b = a * VectorX::Ones(n);
  return {.name = "rank_deficient",
          .kind = "degenerate",
          .x0 = VectorX::Zero(n),
          .f = [=](const VectorX& x, VectorX& g) {
            const VectorX r = a * x - b;
            g.noalias() = a.transpose() * r;
            return 0.5 * avi::dot(r, r);
          }};
}

/// Mean of softplus(-a.x) over separable data without a ridge: the infimum 0 is at infinity.
Problem at_infinity(Eigen::Index n, Eigen::Index m) {
  Numbers numbers(151);
  Eigen::MatrixXd a = numbers.matrix(m, n);
  const VectorX truth = numbers.normals(n);
  for (Eigen::Index i = 0; i < m; ++i)
    if (a.row(i).dot(truth) < 0.0) a.row(i) *= -1.0;
  return {.name = "at_infinity",
          .kind = "degenerate",
          .x0 = VectorX::Zero(n),
          .f = [=](const VectorX& x, VectorX& g) {
            VectorX z = a * x;
            const double f = logistic_loss(z);
            g.noalias() = a.transpose() * z / static_cast<double>(m);
            return f / static_cast<double>(m);
          }};
}

}  // namespace

std::vector<Problem> degenerate_problems(bool large) {
  return {power("power_4", 100, 4),
          power("power_8", 50, 8),
          blunt(50),
          rank_deficient(100),
          at_infinity(20, 100),
          power("power_4_large", large ? 1'000'000 : 100'000, 4)};
}

}  // namespace arena
