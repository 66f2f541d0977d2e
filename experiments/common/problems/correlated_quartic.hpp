#pragma once
#include "avi/core/dot.hpp"
#include "avi/core/require.hpp"

// The objective of the paper's optimisation experiments.

namespace experiment {

using avi::VectorX, avi::require, avi::dot;

/// z = Sigma y with Sigma_ij = rho^|i-j|, in O(n): z_i = b_i + a_i with the two recurrences
/// b_i = y_i + rho b_{i-1} (entries up to i) and a_i = rho (y_{i+1} + a_{i+1}) (entries beyond i).
///
/// The operations have the order of the recurrences, whatever the vector width.
inline void multiply_by_correlation(double rho, const VectorX& y, VectorX& z) {
  // Both recurrences run at once, from opposite ends, since they are independent. The second one to reach an
  // entry adds its part.
  double up_to = 0.0, beyond = 0.0;
  for (Eigen::Index i = 0, j = y.size() - 1; j >= 0; ++i, --j) {
    up_to = y[i] + rho * up_to;
    z[i] = i > j ? z[i] + up_to : up_to;
    z[j] = i < j ? beyond : z[j] + beyond;
    beyond = rho * (beyond + y[j]);
  }
}

/// The objective \f$f(x) = \left[(x - 1)^T \Sigma\, (x - 1)\right]^2\f$, \f$\Sigma_{ij} = \rho^{|i-j|}\f$:
/// equation (4.21) of the paper, where n = 50 and \f$\rho = 0.9\f$. It is convex with minimum 0 at x = 1,
/// where the Hessian vanishes, so that no method converges geometrically. \f$\nabla f = 4\, (y^T \Sigma y)\,
/// \Sigma y\f$ with y = x - 1.
///
/// Uses memory of its own, so each thread needs its own object.
class CorrelatedQuartic {
 public:
  /// In dimension n. @throws std::invalid_argument unless n >= 1 and |rho| < 1.
  explicit CorrelatedQuartic(Eigen::Index n = 50, double rho = 0.9)
      : rho_(rho), offset_(positive(n)), image_(n) {
    require(rho > -1.0 && rho < 1.0, "Correlation rho", rho, "in (-1, 1)");
  }

  [[nodiscard]] Eigen::Index size() const { return offset_.size(); }         ///< n.
  [[nodiscard]] VectorX minimiser() const { return VectorX::Ones(size()); }  ///< x = 1, the only minimiser.
  static constexpr double minimum = 0.0;                                     ///< f at the minimiser.

  /// The start of the paper's runs, every entry 5. The paper does not state it; it was recovered from the
  /// iteration counts there.
  [[nodiscard]] VectorX start() const { return VectorX::Constant(size(), 5.0); }

  /// Value and gradient. @throws std::invalid_argument for an x of another size.
  double operator()(const VectorX& x, VectorX& gradient) const {
    const double form = quadratic_form(x, gradient);
    gradient *= 4.0 * form;
    return form * form;
  }

  /// Value alone.
  [[nodiscard]] double value(const VectorX& x) const {
    const double form = quadratic_form(x, image_);
    return form * form;
  }

 private:
  /// Checks n before any memory is allocated.
  static Eigen::Index positive(Eigen::Index n) {
    require(n >= 1, "Dimension", n, "at least 1");
    return n;
  }

  /// (x - 1)^T Sigma (x - 1); stores Sigma (x - 1) in z.
  double quadratic_form(const VectorX& x, VectorX& z) const {
    require(x.size() == size(), "Size of x", x.size(), "the objective's dimension, ", size());
    z.resize(size());
    offset_ = x.array() - 1.0;
    multiply_by_correlation(rho_, offset_, z);
    return dot(offset_, z);
  }

  double rho_;
  mutable VectorX offset_, image_;
};

}  // namespace experiment
