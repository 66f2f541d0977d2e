#pragma once
#include "avi/core/dot.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

// A problem of the arena, and the pieces that several problems share.

namespace arena {

using avi::VectorX, Eigen::Index;

/// A function to minimise, with its start.
struct Problem {
  std::string name;                                   ///< As in the data file.
  VectorX x0;                                         ///< The usual start.
  std::function<double(const VectorX&, VectorX&)> f;  ///< Value; fills the gradient.
  std::string group{};                                ///< tuned, looked_at or held_out (all.cpp).
};

/// Every problem, in the order of the data file. `large` adds and enlarges those of dimension up to 1e6,
/// `again` adds the draws that were held out for earlier defaults.
std::vector<Problem> all_problems(bool large, bool again);

/// One kind each, without group. Where data or starts are drawn at random, dimension and number of data are k
/// times the usual, and `seed` is added to each class's own.
std::vector<Problem> convex_problems(bool large);
std::vector<Problem> statistics_problems(Index k, unsigned long seed);
std::vector<Problem> classic_problems();
std::vector<Problem> remaining_classic_problems();
std::vector<Problem> drawn_non_convex_problems(Index k, unsigned long seed);
std::vector<Problem> other_non_convex_problems();
std::vector<Problem> degenerate_problems(bool large);

/// Numbers that are the same with every standard library: uniform from the bits of mt19937_64, normal by Box
/// and Muller.
class Numbers {
 public:
  explicit Numbers(unsigned long seed) : bits_(seed) {}
  double uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  VectorX normals(Index n) { return matrix(n, 1); }
  Eigen::MatrixXd matrix(Index rows, Index columns) {
    Eigen::MatrixXd m(rows, columns);
    for (double& entry : m.reshaped())
      entry = normal();
    return m;
  }

 private:
  std::mt19937_64 bits_;
};

/// sum_i term(x_i, slope_i, i).
Problem separable(std::string name, VectorX x0, const auto& term) {
  return {std::move(name), std::move(x0), [term](const VectorX& x, VectorX& g) {
            double f = 0.0;
            for (Index i = 0; i < x.size(); ++i)
              f += term(x[i], g[i], i);
            return f;
          }};
}

/// sum_i loss(z_i, slope_i, i), z = A x - b, and its gradient. loss() takes z_i by value.
double sum_of_losses(const Eigen::MatrixXd& a, const VectorX& b, const auto& loss, const VectorX& x,
                     VectorX& g) {
  VectorX z = a * x - b;
  double f = 0.0;
  for (Index i = 0; i < z.size(); ++i)
    f += loss(z[i], z[i], i);
  g.noalias() = a.transpose() * z;
  return f;
}

/// Mean of loss(z_i, slope_i, i), z = A x, from 0.
Problem mean_of_losses(const char* name, const Eigen::MatrixXd& a, const auto& loss) {
  return {name, VectorX::Zero(a.cols()), [=](const VectorX& x, VectorX& g) {
            const double count = static_cast<double>(a.rows());
            const double f = sum_of_losses(a, VectorX::Zero(a.rows()), loss, x, g);
            g /= count;
            return f / count;
          }};
}

/// log(1 + e^-z): of the margin z of one datum.
inline double logistic_loss(double z, double& slope, Index) {
  const double decay = std::exp(-std::abs(z));
  slope = -(z <= 0.0 ? 1.0 : decay) / (1.0 + decay);
  return (z < 0.0 ? -z : 0.0) + std::log1p(decay);
}

/// f and the sum of term(x_{i+1} - x_i, slope), whose gradient is added to g.
double add_neighbours(const VectorX& x, double f, VectorX& g, const auto& term) {
  for (Index i = 0; i + 1 < x.size(); ++i) {
    double slope = 0.0;
    f += term(x[i + 1] - x[i], slope);
    g[i + 1] += slope;
    g[i] -= slope;
  }
  return f;
}

/// weight |d|, smoothed: weight sqrt(d^2 + width).
inline double smooth_size(double weight, double width, double d, double& slope) {
  const double size = std::sqrt(d * d + width);
  slope = weight * d / size;
  return weight * size;
}
inline double half_square(double d, double& slope) { return slope = d, 0.5 * d * d; }

/// A first step along -g for methods that have none of their own: a hundredth of x, or of the way to where a
/// linear f would vanish, or of length 1 / |g|.
inline double first_length(const VectorX& x, const VectorX& g, double value) {
  const double size = x.lpNorm<Eigen::Infinity>(), slope = g.lpNorm<Eigen::Infinity>();
  if (size > 0.0) return 0.01 * size / slope;
  return value != 0.0 ? 0.01 * std::abs(value) / avi::dot(g, g) : 1.0 / slope;
}

}  // namespace arena
