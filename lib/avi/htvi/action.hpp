#pragma once
#include "avi/htvi/quadrature.hpp"
#include "avi/transform/poincare.hpp"

#include <array>
#include <utility>
#include <vector>

/// @file
/// The discrete action of the trial curve of an HTVI, and its variation.

namespace avi {

/// The remainder R in \f$\delta A = [p\cdot\delta q]_0^h + R\f$, the variation of a discrete action A on the
/// trial curve of one step. R vanishes for every variation exactly where the curve makes the action
/// stationary (Hamilton's principle). The right-hand side of the discrete Hamilton's equations consists of R
/// alone (DiscreteEquations).
/// @tparam Number a number with partials along the variations of the curve: of its initial values, and of p^t
template <class Number>
struct ActionRemainder {
  Number variation;  ///< R, given by its partials; its value has no meaning.
  double time;       ///< dA/dp^t for a fixed curve, without the part contained in R: t_1 - t_0 where R = 0.
};

/// The action \f$A = \int_0^h \tilde p\cdot d\tilde q - h\sum_i b_i\,\bar H(\tilde z(c_i h))\f$ of the Taylor
/// curve \f$\tilde z\f$ of the full field, with \f$\tilde q\f$ of degree r + 1 and \f$\tilde p\f$ of degree
/// r. The first term, a one-form on a polynomial curve, is integrated exactly. Where the quadrature rule is
/// exact up to degree 2r, as Gauss with r + 1 nodes is, A equals \f$h\sum_i b_i[\tilde p\cdot \tilde q' -
/// \bar H](c_i h)\f$.
///
/// With the defects \f$d_q = \tilde q' - \partial\bar H/\partial p\f$ and \f$d_p = \tilde p' + \partial\bar
/// H/\partial q\f$ its variation is \f[ \delta A = [\tilde p\cdot\delta\tilde q]_0^h + R, \quad R = \int_0^h
/// (d_q\cdot\delta\tilde p - d_p\cdot\delta\tilde q), \f] where the terms in H-bar are integrated by the
/// quadrature rule. All terms of R are small, so nothing cancels. Only the curve has to be differentiated; at
/// the nodes the field is evaluated with plain numbers. Because the curve is a polynomial, only the moments
/// of the defects with powers of \f$\tau\f$ are needed. For the order, 2r + 2, see \ref stationary_action.
template <class Expansion>
class StationaryAction {
 public:
  using Number = typename Expansion::Number;  ///< A number with its partials.
  static constexpr int n = Expansion::n;      ///< Dimension of the problem.

  /// The action with this quadrature rule. @throws std::invalid_argument for an improper rule.
  explicit StationaryAction(Quadrature rule) : rule_(std::move(rule)) {
    validate(rule_);
    for (std::size_t i = 0; i < rule_.nodes.size(); ++i) {
      std::array<double, powers> weights;
      weights[0] = rule_.weights[i];
      for (std::size_t k = 1; k < powers; ++k)
        weights[k] = weights[k - 1] * rule_.nodes[i];
      weights_.push_back(weights);
    }
    for (int k = 0; k < static_cast<int>(powers); ++k)
      for (int j = 1; j < static_cast<int>(powers); ++j)
        integrals_[k][j] = static_cast<double>(j) / (j + k);
  }

  [[nodiscard]] const Quadrature& rule() const { return rule_; }  ///< The quadrature rule b_i, c_i.

  /// R and the time of the step, for the last expansion, whose step is h.
  [[nodiscard, gnu::noinline]] ActionRemainder<Number>
  remainder(const Expansion& e, const typename Expansion::Increments&, double h) const {
    const int degree = e.order() + 1;
    const auto moments = defect_moments(e, h);
    const auto q = e.q(), p = e.p();
    Number sum(0.0);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < degree; ++k)
        sum += moments.of[k][i] * p[i][k] - moments.of[k][n + i] * q[i][k];
      sum -= moments.of[degree][n + i] * q[i][degree];
    }
    return {sum, moments.time};
  }

 private:
  static constexpr std::size_t powers = Expansion::capacity + 2;
  using Point = std::array<double, 2 * static_cast<std::size_t>(n)>;  // (q, p)
  struct Moments {
    std::array<Point, powers> of;  // moments of d_q and d_p with the powers of c
    double time;                   // h sum b_i g
  };

  [[gnu::flatten]] Moments defect_moments(const Expansion& e, double h) const {
    const int degree = e.order() + 1;
    std::array<Point, powers> curve;
    const auto q_series = e.q(), p_series = e.p();
    for (int k = 0; k <= degree; ++k)
      for (int i = 0; i < n; ++i) {
        curve[k][i] = q_series[i][k].value();
        curve[k][n + i] = k < degree ? p_series[i][k].value() : 0.0;
      }
    Moments moments;
    moments.time = 0.0;
    for (int k = 0; k <= degree; ++k) {
      moments.of[k].fill(0.0);
      for (int j = 1; j <= degree; ++j)
        for (int i = 0; i < 2 * n; ++i)
          moments.of[k][i] += integrals_[k][j] * curve[j][i];
    }
    for (std::size_t node = 0; node < weights_.size(); ++node) {
      const double c = rule_.nodes[node];
      Point z = curve[degree];
      for (int k = degree - 1; k >= 0; --k)
        for (int i = 0; i < 2 * n; ++i)
          z[i] = curve[k][i] + c * z[i];
      Vector<double, n> q, p, dq, dp;
      for (int i = 0; i < n; ++i) {
        q[i] = z[i];
        p[i] = z[n + i];
      }
      double dt;
      e.problem().field(q, p, e.problem().energy_momentum(), dq, dp, dt);
      for (int i = 0; i < n; ++i) {
        z[i] = h * dq[i];
        z[n + i] = -h * dp[i];
      }
      moments.time += h * weights_[node][0] * dt;
      for (int k = 0; k <= degree; ++k)
        for (int i = 0; i < 2 * n; ++i)
          moments.of[k][i] -= weights_[node][k] * z[i];
    }
    return moments;
  }

  Quadrature rule_;
  std::vector<std::array<double, powers>> weights_;           // b_i c_i^k
  std::array<std::array<double, powers>, powers> integrals_;  // of j c^(j-1) c^k over [0, 1]
};

}  // namespace avi
