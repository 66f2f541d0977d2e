#pragma once
#include "avi/core/require.hpp"

#include <array>
#include <memory>

/// @file
/// GaussRule: the coefficients of Gauss collocation.

namespace avi {

/// Gauss-Legendre nodes \f$c_i\f$ and weights \f$b_i\f$ on [0, 1] for s = 1 ... 16 stages, and the integrals
/// \f$a_{ij} = \int_0^{c_i} \ell_j\f$ of the Lagrange polynomials, stored as \f$\mu_{ij} = a_{ij}/b_j\f$
/// (Antonana, Makazaga and Murua 2017). In this form the condition of symplecticity, \f$b_i a_{ij} + b_j
/// a_{ji} = b_i b_j\f$, reads \f$\mu_{ij} + \mu_{ji} = 1\f$ and holds without any rounding error.
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
  [[nodiscard]] double node(int i) const { return table_->node[i]; }        ///< c_i, increasing with i.
  [[nodiscard]] double weight(int i) const { return table_->weight[i]; }    ///< b_i.
  [[nodiscard]] double mu(int i, int j) const { return table_->mu[i][j]; }  ///< a_ij / b_j.

  /// \f$P_{s-1}(2 c_j - 1)\f$ at node j: the Legendre polynomial of the highest degree in the velocity of a
  /// step.
  [[nodiscard]] double last_legendre(int j) const { return table_->last_legendre[j]; }

  /// \f$(2k + 1)\, P_k(2 c_j - 1)\f$, the coefficient of \f$P_k\f$ in \f$\ell_j / b_j\f$.
  [[nodiscard]] double series(int j, int k) const { return static_cast<double>(table_->series[j][k]); }

  /// \f$b_j^{-1} \int_0^c \ell_j\f$ for every j, at any real c. With these numbers \f$r_j\f$, the collocation
  /// polynomial at the fraction c of a step is \f$y_0 + \sum_j (h b_j y'_j)\, r_j\f$.
  [[nodiscard]] Row integrals(long double c) const { return table_->integrals(c); }

  /// \f$b_j^{-1} \int_1^{1 + c_i} \ell_j\f$ for every j: continues the polynomial of a step to stage i of the
  /// next one.
  [[nodiscard]] const Row& ahead(int i) const { return table_->ahead[i]; }

  /// The same as integrals(), in double precision, for points inside a step: four times as fast.
  [[nodiscard]] Row quick_integrals(double c) const;

 private:
  /// The coefficients, shared by all copies of a rule.
  struct Table {
    explicit Table(int s);
    [[nodiscard]] Row integrals(long double c) const;

    int stages;
    std::array<long double, most> exact_node{};
    std::array<std::array<long double, most>, most> series{};
    Row node{}, weight{}, last_legendre{};
    std::array<Row, most> mu{}, slopes{}, ahead{};

   private:
    using Polynomials = std::array<long double, most + 1>;
    /// Legendre polynomials P_0 ... P_s at x in [-1, 1].
    [[nodiscard]] Polynomials legendre(long double x) const;
    /// Node, weight and P_k(2 c_i - 1) of stage i, by Newton's method on P_s.
    void find_node(int i);
  };

  int stages_;
  std::shared_ptr<const Table> table_;
};

/// Settings of the iteration for the stages: when a step counts as solved.
struct SweepSettings {
  /// Relative change that one more sweep would make, in the scale of each entry (see EntryScales). The
  /// default leaves only rounding.
  double tolerance = 6.25e-19;
  int max_sweeps = 100;  ///< After this many, the step ends as Outcome::not_converged.
};

namespace detail {
/// The rule of this order, computed once and kept.
/// @throws std::invalid_argument for an order that is odd or out of [2, largest], or an improper setting.
const GaussRule& collocation_rule(int order, int largest, SweepSettings settings);
}  // namespace detail

}  // namespace avi
