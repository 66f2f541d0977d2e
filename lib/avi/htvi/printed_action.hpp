#pragma once
#include "avi/htvi/action_remainder.hpp"
#include "avi/htvi/construction.hpp"
#include "avi/htvi/quadrature.hpp"

#include <utility>

/// @file
/// The action of the paper, whose velocity is that of the field.

namespace avi {

/// The action \f$A = h\sum_i b_i [p\cdot q' + p^t t' - \bar H](c_i h)\f$ of Section 2.2 of the paper, with q'
/// and t' from the field at the nodes, and not from the curve: it is not stationary on the solution, and its
/// order is r + 1. Its variation is that of a formula, differentiated automatically.
template <class Expansion, Construction construction>
class PrintedAction {
  static_assert(construction != Construction::stationary);

 public:
  using Lane = typename Expansion::Lane;  ///< A number with its partials.
  static constexpr int n = Expansion::n;  ///< Dimension of the problem.
  /// What the trial curve follows.
  static constexpr Field field = construction == Construction::printed ? Field::full : Field::on_shell;

  /// For this quadrature rule. @throws std::invalid_argument for an improper rule.
  explicit PrintedAction(Quadrature rule) : rule_(std::move(rule)) { validate(rule_); }

  [[nodiscard]] const Quadrature& rule() const { return rule_; }  ///< b_i and c_i.

  /// R of the last expansion, of step h, whose increments are d.
  [[nodiscard, gnu::noinline, gnu::flatten]] ActionRemainder<Lane>
  remainder(const Expansion& e, const typename Expansion::Increments& d, double h) const {
    const Lane pt = e.energy_momentum();
    Lane sum(0.0);
    for (std::size_t j = 0; j < rule_.nodes.size(); ++j) {
      const double c = rule_.nodes[j];
      const bool raised = construction == Construction::authors && c == 1.0;
      Vector<Lane, n> q, p;
      for (int i = 0; i < n; ++i) {
        q[i] = e.q()[i][0] + c * Expansion::tail(e.q()[i], e.order() + (raised ? 1 : 0), c);
        p[i] = e.p()[i][0] + c * Expansion::tail(e.p()[i], e.order(), c);
      }
      sum += rule_.weights[j] * e.problem().template action_rate<field>(q, p, pt);
    }
    // [p . dq]_0^h = p(h) . d(q(h) - q(0)) + (p(h) - p(0)) . dq(0), and p^t dt(h) where p^t is a variable.
    Lane remainder = h * sum - e.problem().energy_momentum() * d.t;
    for (int i = 0; i < n; ++i)
      remainder -= (e.p()[i][0].value() + d.p[i].value()) * d.q[i] + d.p[i].value() * e.q()[i][0];
    return {remainder, d.t.value()};
  }

 private:
  Quadrature rule_;
};

}  // namespace avi
