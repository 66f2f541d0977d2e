#pragma once
#include "avi/autodiff/reverse.hpp"
#include "avi/core/inverse.hpp"
#include "beyond/speed/automatic_monitors/monomial.hpp"
#include "beyond/speed/automatic_monitors/orbit.hpp"
#include "beyond/speed/automatic_monitors/terms.hpp"

#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

/// @file
/// The square of the frequency scale of a Hamiltonian, term by term, from its second derivatives.

namespace experiment {

using avi::ExpressionGraph, avi::Operation, avi::Reverse, avi::Matrix, avi::Vector, avi::dynamic,
    avi::inverse;

/// A Hamiltonian as a graph, and the quantities that monitors are made of.
///
/// H is a sum of terms \f$H_k\f$ as it is written (a pair of bodies is one). With the metric
/// \f$K = \partial^2 H/\partial p^2\f$ of the start, in whose units all masses are 1,
/// \f[ n_0 = \tfrac1n |H_{pp}|^2 \sum_k |H_{k,qq}|^2 + \Big(\sum_k |H_{k,qp}|^2\Big)^2, \f]
/// norms of Frobenius in that metric: \f$|A_{qq}|^2 = tr(A K A K)\f$, \f$|A_{qp}|^2 = tr(A K^{-1} A^T K)\f$,
/// \f$|A_{pp}|^2 = tr(A K^{-1} A K^{-1})\f$. It is a frequency to the power 4; linear changes of coordinates
/// (with their momenta) leave it as it is. Squares do not cancel where attraction and repulsion do.
class Curvature {
 public:
  /// Of the orbit's H, with the metric at its start. @throws std::invalid_argument where H_pp is not
  /// symmetric and positive definite there, as a metric must be.
  explicit Curvature(const Orbit& orbit)
      : graph(2 * static_cast<int>(orbit.start.q.size())), n_(static_cast<int>(orbit.start.q.size())),
        start_(orbit.start.q.data(), orbit.start.q.data() + orbit.start.q.size()) {
    energy = graph.substitute(orbit.energy.graph(), orbit.energy.node(), inputs(2 * n_));
    start_.insert(start_.end(), orbit.start.p.data(), orbit.start.p.data() + orbit.start.p.size());
    for (const Terms::Term& term : Terms::of(graph, energy))
      terms_.push_back({term.node, hessian(term)});
    find_metric();
  }

  ExpressionGraph graph;  ///< Of (q, p).
  int energy = -1;        ///< H.

  /// n_0.
  int squared_frequency_squared() {
    int all_qq = graph.constant(0.0), all_qp = all_qq;
    Monomial monomial(graph, start_);
    for (const Term& term : terms_) {
      int qq = graph.constant(0.0), qp = qq;
      for (const auto& [ij, a] : term.hessian)
        for (const auto& [lk, b] : term.hessian) {
          const auto [i, j] = ij;
          const auto [l, k] = lk;
          if (i < n_ && j < n_ && l < n_ && k < n_)  // A_ij K_jl A_lk K_ki
            qq = plus(qq, scaled(metric_(j, l) * metric_(k, i), times(a, b)));
          if (i < n_ && j >= n_ && l < n_ && k >= n_)  // A_ij K^-1_jk A_lk K_li
            qp = plus(qp, scaled(inverse_(j - n_, k - n_) * metric_(l, i), times(a, b)));
        }
      all_qq = plus(all_qq, monomial.simplified(qq, term.node));
      all_qp = plus(all_qp, monomial.simplified(qp, term.node));
    }
    return plus(times(spread(), all_qq), times(all_qp, all_qp));
  }

  /// \f$\dot q^T K^{-1}\dot q + \dot p^T K\,\dot p/\omega^2\f$, the square of the speed in phase space.
  int squared_speed(double frequency) {
    const std::vector<int> slope = Reverse(graph).gradient(energy);
    int sum = graph.constant(0.0);
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) {
        sum = plus(sum, scaled(inverse_(i, j), times(slope[n_ + i], slope[n_ + j])));
        sum = plus(sum, scaled(metric_(i, j) / (frequency * frequency), times(slope[i], slope[j])));
      }
    return sum;
  }
  /// Its two parts for a given velocity in phase space, without the factor of the second.
  [[nodiscard]] std::pair<double, double> squared_speeds(const Vector<double, dynamic>& velocity) const {
    double positions = 0.0, momenta = 0.0;
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) {
        positions += inverse_(i, j) * velocity[i] * velocity[j];
        momenta += metric_(i, j) * velocity[n_ + i] * velocity[n_ + j];
      }
    return {positions, momenta};
  }

  /// The angle between two ways in phase space in the metric of squared_speed().
  [[nodiscard]] double angle(const Vector<double, dynamic>& a, const Vector<double, dynamic>& b,
                             double frequency) const {
    const auto length = [&](const Vector<double, dynamic>& way) {
      const auto [positions, momenta] = squared_speeds(way);
      return std::sqrt(positions + momenta / (frequency * frequency));
    };
    const double of_a = length(a), of_b = length(b);
    Vector<double, dynamic> difference(a.size()), sum(a.size());
    for (Eigen::Index i = 0; i < a.size(); ++i) {
      const double x = a[i] / of_a, y = b[i] / of_b;
      difference[i] = x - y;
      sum[i] = x + y;
    }
    return 2.0 * std::atan2(length(difference), length(sum));
  }

  /// H(q, 0), the energy of a body at rest.
  int energy_at_rest() {
    std::vector<int> arguments = inputs(n_);
    arguments.resize(2 * static_cast<std::size_t>(n_), graph.constant(0.0));
    return graph.substitute(graph, energy, arguments);
  }

  ///@{

  /// Nodes of sums, products and powers.
  int plus(int a, int b) { return graph.binary(Operation::add, a, b); }
  int times(int a, int b) { return graph.binary(Operation::multiply, a, b); }
  int scaled(double a, int b) { return times(graph.constant(a), b); }
  ///@}

 private:
  using Square = Matrix<double, dynamic>;
  using Sparse = std::map<std::pair<int, int>, int>;  // entries of a Hessian that are not the constant 0
  struct Term {
    int node;
    Sparse hessian;
  };

  /// Second derivatives of a term, found in a graph of its own: the work grows with the term, not with H.
  Sparse hessian(const Terms::Term& term) {
    std::vector<int> used, place(2 * static_cast<std::size_t>(n_), -1);
    const std::vector<char> part = graph.parts(term.node);
    for (int i = 0; i < 2 * n_ && i <= term.node; ++i)
      if (part[i]) {
        place[i] = static_cast<int>(used.size());
        used.push_back(i);
      }
    const int count = static_cast<int>(used.size());
    ExpressionGraph own(count);
    const std::vector<int> slope = Reverse(own).gradient(own.substitute(graph, term.node, place));
    Sparse entries;
    std::vector<int> copies;
    for (int i = 0; i < count; ++i) {
      if (own.is_constant(slope[i])) continue;
      const std::vector<int> row = Reverse(own).gradient(slope[i]);
      copies.resize(own.size(), -1);
      for (int j = 0; j <= i; ++j)
        if (!own.is(row[j], 0.0))
          entries[{used[i], used[j]}] = entries[{used[j], used[i]}] =
              scaled(term.factor, copy(own, row[j], used, copies));
    }
    return entries;
  }

  /// The nodes of the first `count` arguments.
  static std::vector<int> inputs(int count) {
    std::vector<int> nodes(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
      nodes[i] = i;
    return nodes;
  }

  /// A node of another graph in this one; `copies` holds those that are there already.
  int copy(const ExpressionGraph& from, int node, const std::vector<int>& used, std::vector<int>& copies) {
    if (copies[node] >= 0) return copies[node];
    const ExpressionGraph::Node& what = from[node];
    if (what.operation == Operation::input) return copies[node] = used[what.a];
    if (what.a >= 0) copy(from, what.a, used, copies);
    if (what.b >= 0) copy(from, what.b, used, copies);
    return copies[node] = graph.again(from, node, copies);
  }

  /// |H_pp|^2 / n: 1 where the kinetic energy has a constant metric.
  int spread() {
    Sparse total;
    for (const Term& term : terms_)
      for (const auto& [ij, a] : term.hessian)
        if (ij.first >= n_ && ij.second >= n_) {
          const auto [place, fresh] = total.try_emplace(ij, a);
          if (!fresh) place->second = plus(place->second, a);
        }
    int sum = graph.constant(0.0);
    for (const auto& [ij, a] : total)
      for (const auto& [lk, b] : total)
        sum = plus(sum, scaled(inverse_(ij.second - n_, lk.first - n_) *
                                   inverse_(lk.second - n_, ij.first - n_) / n_,
                               times(a, b)));
    return sum;
  }

  /// K and its inverse.
  void find_metric() {
    metric_ = Square::Zero(n_, n_);
    std::vector<double> values = start_;
    for (const Term& term : terms_)
      for (const auto& [ij, node] : term.hessian)
        if (ij.first >= n_ && ij.second >= n_)
          metric_(ij.first - n_, ij.second - n_) += avi::detail::evaluate(graph, node, values);
    if (!positive(metric_))
      throw std::invalid_argument(
          "The second derivatives of H with respect to p are not positive definite at the start, so "
          "that speeds have no measure; give a monitor of your own, or none.");
    inverse_ = inverse(metric_);
  }
  /// All pivots of a symmetric matrix are positive and its entries finite.
  static bool positive(Square a) {
    for (Eigen::Index k = 0; k < a.rows(); ++k) {
      if (!(a(k, k) > 0.0 && std::isfinite(a(k, k)))) return false;
      for (Eigen::Index i = k + 1; i < a.rows(); ++i)
        for (Eigen::Index j = k + 1; j < a.rows(); ++j)
          a(i, j) -= a(i, k) * a(k, j) / a(k, k);
    }
    return true;
  }
  int n_;
  std::vector<double> start_;
  std::vector<Term> terms_;
  Square metric_, inverse_;
};

}  // namespace experiment
