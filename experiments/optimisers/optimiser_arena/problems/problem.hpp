#pragma once
#include "avi/core/dot.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

/// @file
/// What the arena's problems have in common.

namespace arena {

using avi::VectorX;

/// A function to minimise, with its start.
struct Problem {
  std::string name;  ///< As in the data file.
  std::string kind;  ///< convex, statistics, classic, non_convex or degenerate.
  VectorX x0;        ///< The usual start.
  std::function<double(const VectorX&, VectorX&)> f;  ///< Value; fills the gradient.
  std::string group = "tuned";                        ///< tuned, looked_at or held_out (all.cpp).
};

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
  VectorX normals(Eigen::Index n) {
    VectorX v(n);
    for (double& entry : v)
      entry = normal();
    return v;
  }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd m(rows, columns);
    for (double& entry : m.reshaped())
      entry = normal();
    return m;
  }

 private:
  std::mt19937_64 bits_;
};

/// Which instances of the classes whose data or start is drawn at random.
struct Draw {
  std::string suffix;      ///< Of their names.
  Eigen::Index times = 1;  ///< Dimension and number of data, in units of the usual.
  unsigned long seed = 0;  ///< Added to each class's own.
};

/// The problems with the suffix of their draw.
inline std::vector<Problem> named(const Draw& draw, std::vector<Problem> problems) {
  for (Problem& problem : problems)
    problem.name += draw.suffix;
  return problems;
}

/// 1 / (1 + e^-z) without overflow.
inline double sigmoid(double z) {
  return z >= 0.0 ? 1.0 / (1.0 + std::exp(-z)) : std::exp(z) / (1.0 + std::exp(z));
}
/// Sum of log(1 + e^-z) over the entries of z, each of which becomes its slope.
inline double logistic_loss(VectorX& z) {
  double f = 0.0;
  for (double& entry : z) {
    const double decay = std::exp(-std::abs(entry));
    f += (entry < 0.0 ? -entry : 0.0) + std::log1p(decay);
    entry = -(entry <= 0.0 ? 1.0 : decay) / (1.0 + decay);
  }
  return f;
}

/// A first step along -g for methods that have none of their own: a hundredth of x, or of the way to where a
/// linear f would vanish, or of length 1 / |g|.
inline double first_length(const VectorX& x, const VectorX& g, double value) {
  const double size = x.lpNorm<Eigen::Infinity>(), slope = g.lpNorm<Eigen::Infinity>();
  if (size > 0.0) return 0.01 * size / slope;
  return value != 0.0 ? 0.01 * std::abs(value) / avi::dot(g, g) : 1.0 / slope;
}

/// @name One kind each
/// @{
std::vector<Problem> convex_problems(bool large);
std::vector<Problem> statistics_problems(const Draw& draw = {});
std::vector<Problem> classic_problems();
std::vector<Problem> remaining_classic_problems();
std::vector<Problem> drawn_non_convex_problems(const Draw& draw);
std::vector<Problem> non_convex_problems();
std::vector<Problem> degenerate_problems(bool large);
/// @}

}  // namespace arena
