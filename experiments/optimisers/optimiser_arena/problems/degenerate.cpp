#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {
namespace {

/// Between 1/2 and 3/2. From (1, 1, ...) methods whose first step has the length of their learning rate in
/// every entry would land on the minimiser by accident.
VectorX scattered(Index n) {
  Numbers numbers(161);
  VectorX x(n);
  for (double& entry : x)
    entry = 0.5 + numbers.uniform();
  return x;
}

/// sum_i i |x_i|^k / k, k even: the Hessian vanishes at the minimum.
Problem power(const std::string& name, Index n, int k) {
  return separable(name, scattered(n), [k](double x, double& g, Index i) {
    g = i + 1.0;
    for (int j = 1; j < k; ++j)
      g *= x;
    return g * x / k;
  });
}

/// sum_i i (x_i^2 + 1e-4)^(3/4): nearly |x|^1.5, steep beside the minimum.
double blunt(double x, double& g, Index i) {
  const double c = i + 1.0, root = std::sqrt(std::sqrt(x * x + 1e-4));
  g = 1.5 * c * x / root;
  return c * root * root * root;
}

/// Least squares of rank n / 2 without noise: a subspace of minimisers.
Problem rank_deficient(Index n) {
  Eigen::MatrixXd a = Numbers(141).matrix(n / 2, n);
  for (Index i = 0; i < n / 2; ++i)
    a.row(i) *= std::pow(10.0, -2.0 * i / (n / 2));
  return {"rank_deficient", VectorX::Zero(n),
          [a, b = VectorX(a * VectorX::Ones(n))](const VectorX& x, VectorX& g) {
            const VectorX r = a * x - b;
            g.noalias() = a.transpose() * r;
            return 0.5 * avi::dot(r, r);
          }};
}

/// Mean of softplus(-a.x) over separable data without a ridge: the infimum 0 is at infinity.
Problem at_infinity(Index n, Index m) {
  Numbers numbers(151);
  Eigen::MatrixXd a = numbers.matrix(m, n);
  const VectorX truth = numbers.normals(n);
  for (Index i = 0; i < m; ++i)
    if (a.row(i).dot(truth) < 0.0) a.row(i) *= -1.0;
  return mean_of_losses("at_infinity", a, logistic_loss);
}

}  // namespace

std::vector<Problem> degenerate_problems(bool large) {
  return {power("power_4", 100, 4),
          power("power_8", 50, 8),
          separable("blunt", scattered(50), blunt),
          rank_deficient(100),
          at_infinity(20, 100),
          power("power_4_large", large ? 1'000'000 : 100'000, 4)};
}

}  // namespace arena
