#pragma once
#include "avi/core/require.hpp"

#include <array>
#include <cmath>
#include <memory>

/// @file
/// Coefficients of Gauss collocation.

namespace avi {

/// Gauss-Legendre nodes \f$c_i\f$ and weights \f$b_i\f$ on [0, 1] for s = 1 ... 16 stages, and the integrals
/// \f$a_{ij} = \int_0^{c_i} \ell_j\f$ of their Lagrange polynomials as \f$\mu_{ij} = a_{ij}/b_j\f$ (Antonana,
/// Makazaga and Murua 2017). The condition of symplecticity, \f$b_i a_{ij} + b_j a_{ji} = b_i b_j\f$, is
/// \f$\mu_{ij} + \mu_{ji} = 1\f$ and holds without any rounding error.
class GaussRule {
 public:
  static constexpr int most = 16;        ///< Largest number of stages.
  using Row = std::array<double, most>;  ///< One number for each stage; zero beyond the last.

  /// The rule of s stages. @throws std::invalid_argument unless 1 <= s <= 16.
  explicit GaussRule(int s) : stages_(s) {
    require(s >= 1 && s <= most, "Number of stages", s, "in [1, 16]");
    table_ = std::make_shared<const Table>(s);
  }

  [[nodiscard]] int stages() const { return stages_; }                      ///< s.
  [[nodiscard]] double node(int i) const { return table_->node[i]; }        ///< c_i, rising.
  [[nodiscard]] double weight(int i) const { return table_->weight[i]; }    ///< b_i.
  [[nodiscard]] double mu(int i, int j) const { return table_->mu[i][j]; }  ///< a_ij / b_j.

  /// \f$P_{s-1}(2 c_j - 1)\f$, Legendre's polynomial of the highest degree in the velocity of a step, at node
  /// j.
  [[nodiscard]] double last_legendre(int j) const { return table_->last_legendre[j]; }

  /// \f$(2k + 1)\, P_k(2 c_j - 1)\f$: the coefficient of \f$P_k\f$ in \f$\ell_j / b_j\f$.
  [[nodiscard]] double series(int j, int k) const { return static_cast<double>(table_->series[j][k]); }

  /// \f$b_j^{-1} \int_0^c \ell_j\f$ for every j, at any real c: the collocation polynomial at the fraction c
  /// of a step is \f$y_0 + \sum_j (h b_j y'_j) \cdot\f$ this.
  [[nodiscard]] Row integrals(long double c) const { return table_->integrals(c); }

  /// \f$b_j^{-1} \int_1^{1 + c_i} \ell_j\f$ for every j: how the polynomial of a step goes on to stage i of
  /// the next one.
  [[nodiscard]] const Row& ahead(int i) const { return table_->ahead[i]; }

  /// The integrals in double precision, for points inside a step: four times as fast.
  [[nodiscard]] Row quick_integrals(double c) const {
    // int_0^c P_k = 2 c (c - 1) P_k'(2 c - 1) / (k (k + 1)) keeps its digits at both ends.
    const double x = 2.0 * c - 1.0;
    double before = 1.0, now = x, slope_before = 0.0, slope = 1.0;  // P_{k-1}, P_k and their derivatives
    Row row{};
    for (int k = 1; k < stages_; ++k) {
      for (int j = 0; j < stages_; ++j)
        row[j] += table_->slopes[k][j] * slope;
      const double next = ratio_[k][0] * x * now - ratio_[k][1] * before;
      const double next_slope = slope_before + (2 * k + 1) * now;
      before = now, now = next;
      slope_before = slope, slope = next_slope;
    }
    for (int j = 0; j < stages_; ++j)
      row[j] = c * (1.0 + (c - 1.0) * row[j]);
    return row;
  }

 private:
  /// All numbers, which copies of a rule share.
  struct Table {
    explicit Table(int s) : stages(s) {
      for (int i = 0; i < s; ++i)
        find_node(i);
      const Row end = integrals(1);
      for (int i = 0; i < s; ++i) {
        const Row row = integrals(exact_node[i]), next = integrals(1.0 + node[i]);
        for (int j = 0; j < s; ++j) {
          mu[i][j] = row[j];
          ahead[i][j] = next[j] - end[j];
        }
      }
      // The larger number of each pair is at least 1/2, so one minus it is exact.
      for (int i = 0; i < s; ++i) {
        mu[i][i] = 0.5;
        for (int j = 0; j < i; ++j)
          if (mu[i][j] >= mu[j][i])
            mu[j][i] = 1.0 - mu[i][j];
          else
            mu[i][j] = 1.0 - mu[j][i];
      }
    }
    [[nodiscard]] Row integrals(long double c) const {
      // l_j / b_j = sum_k (2 k + 1) P_k(c_j) P_k, with shifted Legendre polynomials P_k, since the rule is
      // exact.
      const Polynomials p = legendre(2 * c - 1);
      std::array<long double, most> integral{c};
      for (int k = 1; k < stages; ++k)
        integral[k] = (p[k + 1] - p[k - 1]) / (2 * (2 * k + 1));
      Row row{};
      for (int j = 0; j < stages; ++j) {
        long double sum = 0;
        for (int k = 0; k < stages; ++k)
          sum += series[j][k] * integral[k];
        row[j] = static_cast<double>(sum);
      }
      return row;
    }

    int stages;
    std::array<long double, most> exact_node{};
    std::array<std::array<long double, most>, most> series{};
    Row node{}, weight{}, last_legendre{};
    std::array<Row, most> mu{}, slopes{}, ahead{};

   private:
    using Polynomials = std::array<long double, most + 1>;
    /// Legendre's polynomials P_0 ... P_s at x in [-1, 1].
    [[nodiscard]] Polynomials legendre(long double x) const {
      Polynomials p{1, x};
      for (int k = 1; k < stages; ++k)
        p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
      return p;
    }
    /// Node, weight and P_k(c_i) of stage i, by Newton's method on P_s.
    void find_node(int i) {
      long double x = -std::cos(M_PI * (i + 0.75) / (stages + 0.5)), slope = 1;
      for (int iteration = 0; iteration < 10; ++iteration) {
        const Polynomials p = legendre(x);
        slope = stages * (x * p[stages] - p[stages - 1]) / (x * x - 1);
        x -= p[stages] / slope;
      }
      exact_node[i] = (1 + x) / 2;
      node[i] = static_cast<double>(exact_node[i]);
      weight[i] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
      const Polynomials p = legendre(x);
      last_legendre[i] = static_cast<double>(p[stages - 1]);
      for (int k = 0; k < stages; ++k)
        series[i][k] = (2 * k + 1) * p[k];
      for (int k = 1; k < stages; ++k)
        slopes[k][i] = static_cast<double>(2 * series[i][k] / (k * (k + 1)));
    }
  };

  int stages_;
  std::shared_ptr<const Table> table_;
  // (2 k + 1) / (k + 1) and k / (k + 1).
  static constexpr std::array<std::array<double, 2>, most> ratio_ = [] {
    std::array<std::array<double, 2>, most> all{};
    for (int k = 0; k < most; ++k)
      all[k] = {(2.0 * k + 1.0) / (k + 1.0), k / (k + 1.0)};
    return all;
  }();
};

}  // namespace avi
