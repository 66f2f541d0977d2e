#pragma once
#include "avi/adaptive/poincare.hpp"
#include "avi/htvi/quadrature.hpp"
#include "avi/taylor/jet.hpp"
#include "avi/taylor/jet_functions.hpp"

#include <array>
#include <string>
#include <utility>

/// @file
/// The Taylor discrete Hamiltonian with its first derivatives.

namespace avi {

/// To which order the position at the quadrature nodes is expanded; the momentum always has order r.
enum class NodePosition {
  r,           ///< Order r at every node, as the construction is printed (Section 2.2 of the paper).
  end_raised,  ///< Order r + 1 at the node c = 1, where q~_1 is at hand, and r elsewhere.
  raised       ///< Order r + 1 at every node.
};

/// The freedom that the text of the paper leaves in an HTVI of given order and quadrature.
struct Construction {
  Field field;
  NodePosition nodes;
  bool operator==(const Construction&) const = default;
};

/// The construction as printed.
inline constexpr Construction printed{Field::full, NodePosition::r};
/// The construction that gives the errors printed in Tables 1 and 2.
inline constexpr Construction authors{Field::on_shell, NodePosition::end_raised};
/// Order r + 1 for the position at all nodes. Without monitor, for H = T(p) + V(q), q' = dH/dp then holds
/// exactly along the trial curve, the action is stationary on it, and the order becomes min(2 (r + 1), s)
/// (measured by the experiment order_verification); a monitor breaks that identity and the order is the
/// theorem's.
inline constexpr Construction superconvergent{Field::on_shell, NodePosition::raised};

/// Taylor expansion, over one step of a Poincare-transformed problem, of (q, p, t) with first partials with
/// respect to the initial values, and what the discrete Hamiltonian needs from it. r is the order of the
/// Taylor method Psi^(r); with r = avi::dynamic it is given at run time, at most `capacity`.
template <class Problem, int r, Construction construction>
class TaylorAction {
 public:
  static constexpr int n = Problem::dimension;
  /// p^t is a variable of H_d^+ in its own right, unless the expansion does not contain it; then dt is the
  /// plain integral of g.
  static constexpr bool energy_lane = !Problem::unit && construction.field == Field::full;
  static constexpr int lanes = 2 * n + (energy_lane ? 1 : 0);
  using Lane = Lanes<lanes>;
  static constexpr int capacity = r == dynamic ? 15 : r;

  /// @throws std::invalid_argument for an improper rule or an order out of range.
  TaylorAction(const Problem& problem, Quadrature rule, int run_time_order, std::size_t tape_slots)
      : problem_(problem), rule_(std::move(rule)), tape_(tape_slots), order_(run_time_order) {
    validate(rule_);
    require(order_ >= 0 && order_ <= capacity, "Taylor order r", order_,
            "in [0, " + std::to_string(capacity) + "]");
  }

  /// r.
  [[nodiscard]] int order() const {
    if constexpr (r == dynamic)
      return order_;
    else
      return r;
  }

  /// Results of expand(): increments over the step, partials in the order q_0, p_0, p^t.
  struct Increments {
    std::array<Lane, n> q;  ///< to order r + 1
    std::array<Lane, n> p;  ///< to order r
    Lane t;                 ///< to order r + 1
    Lane action;            ///< h sum_i b_i [p . dH-bar/dp + p^t dH-bar/dp^t - H-bar]
  };

  /// Expands from (q, p) over a step h.
  /// Flattened: the replays are straight-line code only when every operation of H and g is inlined.
  [[gnu::flatten]] void expand(const Vector<double, n>& q, const Vector<double, n>& p, double h,
                               Increments& out) {
    for (int i = 0; i < n; ++i) {
      q_[i][0] = Lane::variable(q[i], i);
      p_[i][0] = Lane::variable(p[i], n + i);
    }
    if constexpr (energy_lane) {
      for (auto& c : pt_)
        c = Lane(0.0);
      pt_[0] = Lane::variable(problem_.energy_momentum(), 2 * n);
    }
    if constexpr (unrolled) {
      [&]<int... k>(std::integer_sequence<int, k...>) { (replay<k, true>(k, h), ...); }
      (std::make_integer_sequence<int, r>{});
      replay<r, r == 0>(r, h);
    } else {
      for (int k = 0; k < order(); ++k)
        replay<-1, true>(k, h);
      // The step of order 0 still needs p' once, for energy_slope().
      if (order() == 0)
        replay<-1, true>(0, h);
      else
        replay<-1, false>(order(), h);
    }
    for (int i = 0; i < n; ++i) {
      out.q[i] = tail<1>(q_[i], 1.0);
      out.p[i] = tail<0>(p_[i], 1.0);
    }
    out.t = tail<1>(t_, 1.0);
    out.action = h * action();
  }

  /// dH/dp (or dH/dq) at the start of the last expansion, from q' = g dH/dp and p' = -g dH/dq on the energy
  /// shell.
  [[nodiscard]] Vector<double, n> energy_slope(bool momentum) const {
    Vector<double, n> slope;
    for (int i = 0; i < n; ++i)
      slope[i] = (momentum ? q_[i][1].value() : -p_[i][1].value()) / t_[1].value();
    return slope;
  }

  /// Taylor polynomial of the last expansion at the fraction c of the step, position to order r + 1.
  [[nodiscard]] State<n> polynomial(double c, double t0) const {
    State<n> z;
    for (int i = 0; i < n; ++i) {
      z.q[i] = at<1>(q_[i], c).value();
      z.p[i] = at<0>(p_[i], c).value();
    }
    z.t = t0 + c * tail<1>(t_, c).value();
    return z;
  }

  [[nodiscard]] const Problem& problem() const { return problem_; }
  [[nodiscard]] const Quadrature& rule() const { return rule_; }

 private:
  /// One copy of the formulas per order is a fifth faster where they are short; long ones fit the instruction
  /// cache, and the compiler's patience, only once.
  static constexpr bool unrolled = construction.field == Field::on_shell && r != dynamic && r <= 4;
  using Series =
      std::array<Lane, capacity + 2>;  // scaled coefficients: entry k is h^k / k! times the k-th derivative

  /// Coefficients k + 1 from coefficients 0 to k; forces are not needed at the last order, k = r.
  template <int K, bool forces>
  void replay(int k, double h) {
    using S = Jet<Lane, capacity, K>;
    tape_.rewind(k);
    Vector<S, n> q, p, dq, dp;
    for (int i = 0; i < n; ++i) {
      q[i] = S(q_[i].data(), &tape_);
      p[i] = S(p_[i].data(), &tape_);
    }
    S pt, dt;
    if constexpr (energy_lane) pt = S(pt_.data(), &tape_);
    problem_.template field<construction.field, forces>(q, p, pt, dq, dp, dt);
    const double factor = h / (k + 1);
    for (int i = 0; i < n; ++i)
      q_[i][k + 1] = factor * dq[i][k];
    t_[k + 1] = factor * dt[k];
    if constexpr (forces)
      for (int i = 0; i < n; ++i)
        p_[i][k + 1] = -factor * dp[i][k];
  }

  /// Sum over k = 1..r + extra of s_k c^(k-1).
  template <int extra>
  [[nodiscard]] Lane tail(const Series& s, double c) const {
    const int last = order() + extra;
    if (last == 0) return Lane(0.0);
    Lane sum = s[last];
    for (int k = last - 1; k >= 1; --k)
      sum = s[k] + c * sum;
    return sum;
  }
  template <int extra>
  [[nodiscard]] Lane at(const Series& s, double c) const {
    return s[0] + c * tail<extra>(s, c);
  }

  [[nodiscard]] Lane action() const {
    Lane sum(0.0);
    const Lane pt = energy_lane ? pt_[0] : Lane(problem_.energy_momentum());
    for (std::size_t j = 0; j < rule_.nodes.size(); ++j) {
      const double c = rule_.nodes[j];
      constexpr NodePosition nodes = construction.nodes;
      const bool raised = nodes == NodePosition::raised || (nodes == NodePosition::end_raised && c == 1.0);
      Vector<Lane, n> q, p;
      for (int i = 0; i < n; ++i) {
        q[i] = raised ? at<1>(q_[i], c) : at<0>(q_[i], c);
        p[i] = at<0>(p_[i], c);
      }
      sum += rule_.weights[j] * problem_.template action_rate<construction.field>(q, p, pt);
    }
    return sum;
  }

  const Problem problem_;
  const Quadrature rule_;
  JetTape<Lane, capacity> tape_;
  const int order_;
  std::array<Series, n> q_, p_;
  Series t_, pt_;
};

}  // namespace avi
