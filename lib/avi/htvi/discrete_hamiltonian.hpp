#pragma once
#include "avi/htvi/construction.hpp"
#include "avi/htvi/quadrature.hpp"
#include "avi/htvi/workspace.hpp"
#include "avi/taylor/jet.hpp"
#include "avi/taylor/jet_functions.hpp"

#include <array>
#include <string>
#include <tuple>
#include <utility>

/// @file
/// The Taylor discrete Hamiltonian with its first derivatives.

namespace avi {

/// Taylor expansion, over one step of a Poincare-transformed problem, of (q, p, t) with first partials with
/// respect to the initial values, and what the discrete Hamiltonian needs from it. r is the order of the
/// Taylor method Psi^(r); with r = avi::dynamic it is given at run time, at most `capacity`. With n =
/// avi::dynamic the partials are computed lane_chunk at a time, one expansion for each chunk.
template <class Problem, int r, Construction construction>
class TaylorAction {
 public:
  static constexpr int n = Problem::dimension;  ///< Dimension of the problem, or avi::dynamic.
  /// p^t is a variable of H_d^+ in its own right, unless the expansion does not contain it; then dt is the
  /// plain integral of g.
  static constexpr bool energy_lane = !Problem::unit && construction.field == Field::full;
  static constexpr bool fixed = n != dynamic;  ///< The dimension is known at compile time.
  static constexpr int lanes = fixed ? 2 * n + (energy_lane ? 1 : 0) : lane_chunk;  ///< Partials in a chunk.
  using Lane = Lanes<lanes>;                              ///< A number with the partials of one chunk.
  static constexpr int capacity = r == dynamic ? 15 : r;  ///< The largest Taylor order there is room for.

  /// For a problem and a rule. @throws std::invalid_argument for an improper rule or an order out of range.
  TaylorAction(const Problem& problem, Quadrature rule, int run_time_order, std::size_t tape_slots)
      : problem_(problem), rule_(std::move(rule)), tape_(tape_slots), order_(run_time_order),
        q_(many<Series, n>(size())), p_(q_), jets_(workspaces(size())), nodes_(size()) {
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

  /// n.
  [[nodiscard]] int size() const { return static_cast<int>(problem_.size()); }
  /// Number of variables that partials are taken with respect to: q_0, p_0, p^t, in this order.
  [[nodiscard]] int variables() const { return 2 * size() + (energy_lane ? 1 : 0); }
  /// Number of expansions for all of them; chunk c holds those from c * lanes on.
  [[nodiscard]] int chunks() const { return fixed ? 1 : (variables() + lanes - 1) / lanes; }
  /// Variable number i at `value`, as chunk c sees it: a constant when it belongs to another.
  static Lane seeded(double value, int i, int c) {
    if constexpr (!fixed) {
      i -= c * lanes;
      if (i < 0 || i >= lanes) return Lane(value);
    }
    return Lane::variable(value, i);
  }

  /// Results of expand(): increments over the step with the partials of one chunk.
  struct Increments {
    Many<Lane, n> q;  ///< to order r + 1
    Many<Lane, n> p;  ///< to order r
    Lane t;           ///< to order r + 1
    /// \f$h \sum_i b_i [p \cdot \partial\bar H/\partial p + p^t \partial\bar H/\partial p^t - \bar H](c_i
    /// h)\f$
    Lane action;
  };

  /// Expands from (q, p) over a step h, with the partials of chunk c. At run-time dimension the tape grows to
  /// the length that the formulas turn out to have.
  void expand(const Vector<double, n>& q, const Vector<double, n>& p, double h, Increments& out, int c = 0) {
    if constexpr (fixed) {
      expand_flattened(q, p, h, out);
    } else {
      for (;;)
        try {
          return expand_once(q, p, h, out, c);
        } catch (const TapeOverflow&) {
          tape_.grow();
        }
    }
  }

  /// slope = dH/dp (or dH/dq) at the start of the last expansion, from q' = g dH/dp and p' = -g dH/dq on the
  /// energy shell.
  void energy_slope(bool momentum, Vector<double, n>& slope) const {
    for (int i = 0; i < size(); ++i)
      slope[i] = (momentum ? q_[i][1].value() : -p_[i][1].value()) / t_[1].value();
  }

  /// Taylor polynomial of the last expansion at the fraction c of the step, position to order r + 1.
  [[nodiscard]] State<n> polynomial(double c, double t0) const {
    State<n> z{.q = Vector<double, n>(size()), .p = Vector<double, n>(size())};
    for (int i = 0; i < size(); ++i) {
      z.q[i] = at<1>(q_[i], c).value();
      z.p[i] = at<0>(p_[i], c).value();
    }
    z.t = t0 + c * tail<1>(t_, c).value();
    return z;
  }

  [[nodiscard]] const Problem& problem() const { return problem_; }  ///< What is expanded.
  [[nodiscard]] const Quadrature& rule() const { return rule_; }     ///< b_i and c_i.

 private:
  /// One copy of the formulas per order is a fifth faster where they are short; long ones fit the instruction
  /// cache, and the compiler's patience, only once.
  static constexpr bool unrolled = construction.field == Field::on_shell && r != dynamic && r <= 4;
  /// A workspace for the handles of each order that has its own copy of the formulas.
  template <int... k>
  using Workspaces = std::tuple<Workspace<Jet<Lane, capacity, k>, n>...>;
  static auto workspaces(int size) {
    if constexpr (unrolled) return [&]<int... k>(std::integer_sequence<int, k...>) {
        return Workspaces<k...>(Workspace<Jet<Lane, capacity, k>, n>(size)...);
      }
    (std::make_integer_sequence<int, r + 1>{});
    else return Workspaces<-1>(size);
  }
  /// Scaled coefficients: entry k is h^k / k! times the k-th derivative.
  using Series = std::array<Lane, capacity + 2>;

  /// The replays are straight-line code only when every operation of H and g is inlined.
  [[gnu::flatten]] void expand_flattened(const Vector<double, n>& q, const Vector<double, n>& p, double h,
                                         Increments& out) {
    expand_once(q, p, h, out, 0);
  }
  void expand_once(const Vector<double, n>& q, const Vector<double, n>& p, double h, Increments& out, int c) {
    for (int i = 0; i < size(); ++i) {
      q_[i][0] = seeded(q[i], i, c);
      p_[i][0] = seeded(p[i], size() + i, c);
    }
    if constexpr (energy_lane) {
      pt_.fill(Lane(0.0));
      pt_[0] = seeded(problem_.energy_momentum(), 2 * size(), c);
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
    if constexpr (!fixed) {
      out.q.resize(q_.size());
      out.p.resize(p_.size());
    }
    for (int i = 0; i < size(); ++i) {
      out.q[i] = tail<1>(q_[i], 1.0);
      out.p[i] = tail<0>(p_[i], 1.0);
    }
    out.t = tail<1>(t_, 1.0);
    out.action = h * action();
  }

  /// Coefficients k + 1 from coefficients 0 to k; forces are not needed at the last order, k = r.
  template <int K, bool forces>
  [[gnu::flatten]] void replay(int k, double h) {
    using S = Jet<Lane, capacity, K>;
    tape_.rewind(k);
    auto&& [q, p, dq, dp, room] = std::get<Workspace<S, n>>(jets_).at();
    for (int i = 0; i < size(); ++i) {
      q[i] = S(q_[i].data(), &tape_);
      p[i] = S(p_[i].data(), &tape_);
    }
    S pt, dt;
    if constexpr (energy_lane) pt = S(pt_.data(), &tape_);
    problem_.template field<construction.field, forces>(q, p, pt, dq, dp, dt, room);
    const double factor = h / (k + 1);
    for (int i = 0; i < size(); ++i)
      q_[i][k + 1] = factor * dq[i][k];
    t_[k + 1] = factor * dt[k];
    if constexpr (forces)
      for (int i = 0; i < size(); ++i)
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

  [[nodiscard, gnu::flatten]] Lane action() {
    Lane sum(0.0);
    const Lane pt = energy_lane ? pt_[0] : Lane(problem_.energy_momentum());
    for (std::size_t j = 0; j < rule_.nodes.size(); ++j) {
      const double c = rule_.nodes[j];
      constexpr NodePosition nodes = construction.nodes;
      const bool raised = nodes == NodePosition::raised || (nodes == NodePosition::end_raised && c == 1.0);
      auto&& [q, p, dq, dp, room] = nodes_.at();
      for (int i = 0; i < size(); ++i) {
        q[i] = raised ? at<1>(q_[i], c) : at<0>(q_[i], c);
        p[i] = at<0>(p_[i], c);
      }
      sum += rule_.weights[j] * problem_.template action_rate<construction.field>(q, p, pt, room);
    }
    return sum;
  }

  const Problem problem_;
  const Quadrature rule_;
  JetTape<Lane, capacity> tape_;
  const int order_;
  Many<Series, n> q_, p_;
  Series t_, pt_;
  decltype(workspaces(0)) jets_;
  Workspace<Lane, n> nodes_;
};

}  // namespace avi
