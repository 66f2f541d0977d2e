#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {
namespace {

/// 1 / (1 + e^-z) without overflow.
double sigmoid(double z) { return z >= 0.0 ? 1.0 / (1.0 + std::exp(-z)) : std::exp(z) / (1.0 + std::exp(z)); }

/// Mean of loss(z_i, slope_i, i), z = A x - b, plus (ridge / 2) |x|^2, from 0.
Problem mean_loss(const std::string& name, const Eigen::MatrixXd& a, const VectorX& b, const auto& loss,
                  double ridge = 0.0) {
  return {name, VectorX::Zero(a.cols()), [=](const VectorX& x, VectorX& g) {
            const double f = sum_of_losses(a, b, loss, x, g), mean = 1.0 / static_cast<double>(b.size());
            g = mean * g + ridge * x;
            return f * mean + 0.5 * ridge * avi::dot(x, x);
          }};
}

/// Mean logistic loss of labels +-1 plus (ridge / 2) |x|^2. `noise` 0: the classes are separable.
Problem logistic(const std::string& name, Index n, Index m, double noise, double ridge, unsigned long seed) {
  Numbers numbers(21 + seed);
  Eigen::MatrixXd a = numbers.matrix(m, n);
  for (Index j = 0; j < n; ++j)  // columns of different sizes, as in raw data
    a.col(j) *= std::pow(10.0, 1.0 - 2.0 * j / n);
  const VectorX truth = numbers.normals(n);
  for (Index i = 0; i < m; ++i) {
    const double score = a.row(i).dot(truth);
    const bool positive = noise > 0.0 ? numbers.uniform() < sigmoid(score / noise) : score > 0.0;
    if (!positive) a.row(i) *= -1.0;
  }
  return mean_loss(name, a, VectorX::Zero(m), logistic_loss, ridge);
}

/// A robust loss of residuals, of which one in ten is an outlier.
Problem regression(const std::string& name, Index n, Index m, unsigned long seed, const auto& loss) {
  Numbers numbers(31 + seed);
  Eigen::MatrixXd a = numbers.matrix(m, n);
  for (Index j = 0; j < n; ++j)
    a.col(j) *= std::pow(10.0, -1.5 * j / n);
  VectorX b = a * numbers.normals(n) + 0.1 * numbers.normals(m);
  for (Index i = 0; i < m; i += 10)
    b[i] += 5.0 * numbers.normal();
  return mean_loss(name, a, b, loss);
}

double huber(double r, double& slope, Index) {
  constexpr double width = 0.1;
  slope = std::abs(r) <= width ? r : std::copysign(width, r);
  return std::abs(r) <= width ? 0.5 * r * r : width * (std::abs(r) - 0.5 * width);
}
double student(double r, double& slope, Index) {
  constexpr double scale = 0.1;
  slope = r / (scale * scale + r * r);
  return 0.5 * std::log1p(r * r / (scale * scale));
}

/// Least squares with the smoothed 1-norm of x.
Problem lasso(Index n, Index m, double weight, unsigned long seed) {
  Numbers numbers(41 + seed);
  const Eigen::MatrixXd a = numbers.matrix(m, n);
  VectorX truth = VectorX::Zero(n);
  for (Index i = 0; i < n; i += 10)
    truth[i] = numbers.normal();
  const VectorX b = a * truth + 0.05 * numbers.normals(m);
  return {"lasso", VectorX::Zero(n), [=](const VectorX& x, VectorX& g) {
            const VectorX z = a * x - b;
            const double mean = 1.0 / static_cast<double>(m);
            g.noalias() = a.transpose() * z * mean;
            double f = 0.5 * mean * avi::dot(z, z), slope = 0.0;
            for (Index i = 0; i < n; ++i) {
              f += smooth_size(weight, 1e-6, x[i], slope);
              g[i] += slope;
            }
            return f;
          }};
}

/// A noisy step function b from its total variation: |x - b|^2 / 2 + weight sum |x_{i+1} - x_i|, smoothed.
Problem total_variation(Index n, double weight, unsigned long seed) {
  Numbers numbers(51 + seed);
  VectorX b = 0.1 * numbers.normals(n);
  for (Index i = 0; i < n; ++i)
    b[i] += (i * 5 / n) % 2 == 0 ? 1.0 : -1.0;
  return {"total_variation", b, [=](const VectorX& x, VectorX& g) {
            g = x - b;
            return add_neighbours(x, 0.5 * avi::dot(g, g), g, [=](double d, double& slope) {
              return smooth_size(weight, 1e-4, d, slope);
            });
          }};
}

/// Counts of mean exp(a.x): the negative log-likelihood of Poisson's law, mean over the data.
Problem poisson_regression(Index n, Index m, unsigned long seed) {
  Numbers numbers(61 + seed);
  const Eigen::MatrixXd a = numbers.matrix(m, n) / std::sqrt(static_cast<double>(n));
  const VectorX mean = (a * (2.0 * numbers.normals(n))).array().exp();
  VectorX count(m);
  for (Index i = 0; i < m; ++i) {
    double sum = -std::log(numbers.uniform());
    for (count[i] = 0.0; sum < mean[i]; ++count[i])
      sum -= std::log(numbers.uniform());
  }
  return mean_of_losses("poisson_regression", a, [count](double z, double& slope, Index i) {
    const double rate = std::exp(z);
    slope = rate - count[i];
    return rate - count[i] * z;
  });
}

/// Softmax regression with `classes` classes, ridge 1e-3.
Problem softmax(Index features, Index classes, Index m, unsigned long seed) {
  Numbers numbers(71 + seed);
  const Eigen::MatrixXd a = numbers.matrix(m, features), truth = numbers.matrix(features, classes);
  const Eigen::MatrixXd score = a * truth + 2.0 * numbers.matrix(m, classes);
  Eigen::VectorX<Index> label(m);
  for (Index i = 0; i < m; ++i)
    score.row(i).maxCoeff(&label[i]);
  return {"softmax", VectorX::Zero(features * classes), [=](const VectorX& x, VectorX& g) {
            const Eigen::Map<const Eigen::MatrixXd> w(x.data(), features, classes);
            Eigen::MatrixXd z = a * w;
            double f = 0.0;
            for (Index i = 0; i < m; ++i) {
              const double top = z.row(i).maxCoeff(), mine = z(i, label[i]);
              double sum = 0.0;
              for (Index c = 0; c < classes; ++c)
                sum += z(i, c) = std::exp(z(i, c) - top);
              f += top + std::log(sum) - mine;
              z.row(i) /= sum;
              z(i, label[i]) -= 1.0;
            }
            const double mean = 1.0 / static_cast<double>(m);
            Eigen::Map<Eigen::MatrixXd>(g.data(), features, classes).noalias() = a.transpose() * z * mean;
            g += 1e-3 * x;
            return f * mean + 0.5e-3 * avi::dot(x, x);
          }};
}

}  // namespace

std::vector<Problem> statistics_problems(Index k, unsigned long seed) {
  return {logistic("logistic", 50 * k, 400 * k, 3.0, 0.0, seed),
          logistic("logistic_separable", 50 * k, 200 * k, 0.0, 1e-4, seed),
          regression("huber", 50 * k, 300 * k, seed, huber),
          regression("student", 50 * k, 300 * k, seed, student),
          lasso(100 * k, 60 * k, 0.02, seed),
          total_variation(300 * k, 0.5, seed),
          poisson_regression(40 * k, 300 * k, seed),
          softmax(20 * k, 6, 300 * k, seed)};
}

}  // namespace arena
