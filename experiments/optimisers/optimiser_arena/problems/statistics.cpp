#include "optimisers/optimiser_arena/problems/problem.hpp"

namespace arena {

namespace {

/// Mean logistic loss of labels +-1 plus (ridge / 2) |x|^2. `noise` 0: the classes are separable.
Problem logistic(const std::string& name, Eigen::Index n, Eigen::Index m, double noise, double ridge,
                 unsigned long seed) {
  Numbers numbers(21 + seed);
  Eigen::MatrixXd a = numbers.matrix(m, n);
  for (Eigen::Index j = 0; j < n; ++j)  // columns of different sizes, as in raw data
    a.col(j) *= std::pow(10.0, 1.0 - 2.0 * static_cast<double>(j) / static_cast<double>(n));
  const VectorX truth = numbers.normals(n);
  for (Eigen::Index i = 0; i < m; ++i) {
    const double score = a.row(i).dot(truth);
    const bool positive = noise > 0.0 ? numbers.uniform() < sigmoid(score / noise) : score > 0.0;
    if (!positive) a.row(i) *= -1.0;
  }
  return {.name = name, .kind = "statistics", .x0 = VectorX::Zero(n), .f = [=](const VectorX& x, VectorX& g) {
            VectorX z = a * x;
            const double f = logistic_loss(z);
            const double mean = 1.0 / static_cast<double>(m);
            g.noalias() = a.transpose() * z * mean;
            g += ridge * x;
            return f * mean + 0.5 * ridge * avi::dot(x, x);
          }};
}

/// A robust or smoothed loss of residuals A x - b: rho(residual) with its slope.
template <class Loss>
Problem regression(const std::string& name, Eigen::Index n, Eigen::Index m, unsigned long seed, Loss loss) {
  Numbers numbers(31 + seed);
  Eigen::MatrixXd a = numbers.matrix(m, n);
  for (Eigen::Index j = 0; j < n; ++j)
    a.col(j) *= std::pow(10.0, -1.5 * static_cast<double>(j) / static_cast<double>(n));
  VectorX b = a * numbers.normals(n) + 0.1 * numbers.normals(m);
  for (Eigen::Index i = 0; i < m; i += 10)
    b[i] += 5.0 * numbers.normal();  // one residual in ten is an outlier
  return {.name = name, .kind = "statistics", .x0 = VectorX::Zero(n), .f = [=](const VectorX& x, VectorX& g) {
            VectorX z = a * x - b;
            double f = 0.0;
            for (double& entry : z) {
              double slope = 0.0;
              f += loss(entry, slope);
              entry = slope;
            }
            const double mean = 1.0 / static_cast<double>(m);
            g.noalias() = a.transpose() * z * mean;
            return f * mean;
          }};
}

double huber(double r, double& slope) {
  constexpr double width = 0.1;
  slope = std::abs(r) <= width ? r : std::copysign(width, r);
  return std::abs(r) <= width ? 0.5 * r * r : width * (std::abs(r) - 0.5 * width);
}
double student(double r, double& slope) {
  constexpr double scale = 0.1;
  slope = r / (scale * scale + r * r);
  return 0.5 * std::log1p(r * r / (scale * scale));
}

/// Least squares with the smoothed 1-norm sum_i sqrt(x_i^2 + 1e-6).
Problem lasso(Eigen::Index n, Eigen::Index m, double weight, unsigned long seed) {
  Numbers numbers(41 + seed);
  const Eigen::MatrixXd a = numbers.matrix(m, n);
  VectorX truth = VectorX::Zero(n);
  for (Eigen::Index i = 0; i < n; i += 10)
    truth[i] = numbers.normal();
  const VectorX b = a * truth + 0.05 * numbers.normals(m);
  return {
      .name = "lasso", .kind = "statistics", .x0 = VectorX::Zero(n), .f = [=](const VectorX& x, VectorX& g) {
        const VectorX z = a * x - b;
        const double mean = 1.0 / static_cast<double>(m);
        g.noalias() = a.transpose() * z * mean;
        double f = 0.5 * mean * avi::dot(z, z);
        for (Eigen::Index i = 0; i < n; ++i) {
          const double size = std::sqrt(x[i] * x[i] + 1e-6);
          f += weight * size;
          g[i] += weight * x[i] / size;
        }
        return f;
      }};
}

/// A noisy step function, |x - b|^2 / 2 + weight sum sqrt((x_{i+1} - x_i)^2 + 1e-4).
Problem total_variation(Eigen::Index n, double weight, unsigned long seed) {
  Numbers numbers(51 + seed);
  VectorX b = 0.1 * numbers.normals(n);
  for (Eigen::Index i = 0; i < n; ++i)
    b[i] += (i * 5 / n) % 2 == 0 ? 1.0 : -1.0;
  return {.name = "total_variation", .kind = "statistics", .x0 = b, .f = [=](const VectorX& x, VectorX& g) {
            g = x - b;
            double f = 0.5 * avi::dot(g, g);
            for (Eigen::Index i = 0; i + 1 < n; ++i) {
              const double d = x[i + 1] - x[i], size = std::sqrt(d * d + 1e-4);
              f += weight * size;
              g[i + 1] += weight * d / size;
              g[i] -= weight * d / size;
            }
            return f;
          }};
}

/// Counts of mean exp(a.x): the negative log-likelihood of Poisson's law, mean over the data.
Problem poisson_regression(Eigen::Index n, Eigen::Index m, unsigned long seed) {
  Numbers numbers(61 + seed);
  const Eigen::MatrixXd a = numbers.matrix(m, n) / std::sqrt(static_cast<double>(n));
  const VectorX mean = (a * (2.0 * numbers.normals(n))).array().exp();
  VectorX count(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    double sum = -std::log(numbers.uniform());
    for (count[i] = 0.0; sum < mean[i]; ++count[i])
      sum -= std::log(numbers.uniform());
  }
  return {.name = "poisson_regression",
          .kind = "statistics",
          .x0 = VectorX::Zero(n),
          .f = [=](const VectorX& x, VectorX& g) {
            VectorX z = a * x;
            double f = 0.0;
            for (Eigen::Index i = 0; i < m; ++i) {
              const double rate = std::exp(z[i]);
              f += rate - count[i] * z[i];
              z[i] = rate - count[i];
            }
            g.noalias() = a.transpose() * z / static_cast<double>(m);
            return f / static_cast<double>(m);
          }};
}

/// Softmax regression with `classes` classes, ridge 1e-3.
Problem softmax(Eigen::Index features, Eigen::Index classes, Eigen::Index m, unsigned long seed) {
  Numbers numbers(71 + seed);
  const Eigen::MatrixXd a = numbers.matrix(m, features), truth = numbers.matrix(features, classes);
  const Eigen::MatrixXd score = a * truth + 2.0 * numbers.matrix(m, classes);
  std::vector<Eigen::Index> label(static_cast<std::size_t>(m));
  for (Eigen::Index i = 0; i < m; ++i)
    score.row(i).maxCoeff(&label[static_cast<std::size_t>(i)]);
  return {.name = "softmax",
          .kind = "statistics",
          .x0 = VectorX::Zero(features * classes),
          .f = [=](const VectorX& x, VectorX& g) {
            const Eigen::Map<const Eigen::MatrixXd> w(x.data(), features, classes);
            Eigen::MatrixXd z = a * w;
            double f = 0.0;
            for (Eigen::Index i = 0; i < m; ++i) {
              const Eigen::Index own = label[static_cast<std::size_t>(i)];
              const double top = z.row(i).maxCoeff(), mine = z(i, own);
              double sum = 0.0;
              for (Eigen::Index c = 0; c < classes; ++c)
                sum += z(i, c) = std::exp(z(i, c) - top);
              f += top + std::log(sum) - mine;
              z.row(i) /= sum;
              z(i, own) -= 1.0;
            }
            const double mean = 1.0 / static_cast<double>(m);
            Eigen::Map<Eigen::MatrixXd>(g.data(), features, classes).noalias() = a.transpose() * z * mean;
            g += 1e-3 * x;
            return f * mean + 0.5e-3 * avi::dot(x, x);
          }};
}

}  // namespace

std::vector<Problem> statistics_problems(const Draw& draw) {
  const Eigen::Index k = draw.times;
  const unsigned long seed = draw.seed;
  return named(draw, {logistic("logistic", 50 * k, 400 * k, 3.0, 0.0, seed),
                      logistic("logistic_separable", 50 * k, 200 * k, 0.0, 1e-4, seed),
                      regression("huber", 50 * k, 300 * k, seed, huber),
                      regression("student", 50 * k, 300 * k, seed, student),
                      lasso(100 * k, 60 * k, 0.02, seed), total_variation(300 * k, 0.5, seed),
                      poisson_regression(40 * k, 300 * k, seed), softmax(20 * k, 6, 300 * k, seed)});
}

}  // namespace arena
