#pragma once
#include "avi/autodiff/jet.hpp"
#include "avi/autodiff/jet_functions.hpp"
#include "avi/transform/poincare.hpp"

#include <array>
#include <string>
#include <utility>

/// @file
/// The Taylor method with its first derivatives.

namespace avi {

/// Taylor expansion of (q, p, t) over one step of a Poincare-transformed problem, with first partials with
/// respect to the initial values (q, p), and to p^t where the field contains it. It is compiled once for each
/// problem, order and field, and shared by all that is built on it.
/// @tparam r order of the Taylor method Psi^(r); avi::dynamic: given at run time, at most `capacity`
template <class Problem, int r, Field form>
class TaylorExpansion {
  static_assert(Problem::dimension != dynamic,
                "An HTVI needs a dimension known at compile time; avi::collocation() takes any.");
  static_assert(Problem::dimension <= 15,
                "An HTVI carries 2n + 1 partials at a time: n is at most 15; avi::collocation() takes any.");

 public:
  static constexpr int n = Problem::dimension <= 15 ? Problem::dimension : 15;  ///< Dimension of the problem.
  /// p^t is a variable in its own right.
  static constexpr bool energy_lane = !Problem::unit && form == Field::full;
  static constexpr int variables = 2 * n + (energy_lane ? 1 : 0);  ///< Of the partials: q, p, p^t.
  static constexpr bool unit = Problem::unit;                      ///< Without a monitor.
  using Lane = Lanes<variables>;                                   ///< A number with its partials.
  static constexpr int capacity = r == dynamic ? 15 : r;           ///< The largest order there is room for.
  /// Scaled coefficients: entry k is h^k / k! times the k-th derivative.
  using Series = std::array<Lane, capacity + 2>;

  /// What the Taylor method adds over the step.
  struct Increments {
    std::array<Lane, n> q;  ///< To order r + 1.
    std::array<Lane, n> p;  ///< To order r.
    Lane t;                 ///< To order r + 1.
  };

  /// For a problem, which is copied. @throws std::invalid_argument for an order out of range.
  TaylorExpansion(const Problem& problem, int run_time_order) : problem_(problem), order_(run_time_order) {
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
  [[nodiscard]] const Problem& problem() const { return problem_; }    ///< What is expanded.
  [[nodiscard]] const std::array<Series, n>& q() const { return q_; }  ///< Coefficients 0 to r + 1.
  [[nodiscard]] const std::array<Series, n>& p() const { return p_; }  ///< Coefficients 0 to r.
  [[nodiscard]] const Series& t() const { return t_; }                 ///< Coefficients 1 to r + 1.

  /// p^t as a variable, or as a constant where the field does not contain it.
  [[nodiscard]] Lane energy_momentum() const {
    const double value = problem_.energy_momentum();
    return energy_lane ? Lane::variable(value, variables - 1) : Lane(value);
  }

  /// Expands from (q, p) over a fictive step h.
  [[gnu::noinline, gnu::flatten]] Increments expand(const Vector<double, n>& q, const Vector<double, n>& p,
                                                    double h) {
    for (int i = 0; i < n; ++i) {
      q_[i][0] = Lane::variable(q[i], i);
      p_[i][0] = Lane::variable(p[i], n + i);
    }
    if constexpr (energy_lane) {
      pt_.fill(Lane(0.0));
      pt_[0] = energy_momentum();
    }
    // The forces are not needed at the last order, but once at least, for energy_slope().
    if constexpr (unrolled) {
      do
        replay<0>(h, true, 0);
      while (tape_.outgrown());
      [&]<int... k>(std::integer_sequence<int, k...>) { (replay<k + 1>(h, k + 1 < r, k + 1), ...); }
      (std::make_integer_sequence<int, r>{});
    } else {
      for (int k = 0; k <= order();) {
        replay<-1>(h, k < order() || k == 0, k);
        if (!tape_.outgrown()) ++k;
      }
    }
    Increments out;
    for (int i = 0; i < n; ++i) {
      out.q[i] = tail(q_[i], order() + 1, 1.0);
      out.p[i] = tail(p_[i], order(), 1.0);
    }
    out.t = tail(t_, order() + 1, 1.0);
    return out;
  }

  /// Sum over k = 1..last of s_k c^(k-1).
  [[nodiscard]] static Lane tail(const Series& s, int last, double c) {
    if (last == 0) return Lane(0.0);
    Lane sum = s[last];
    for (int k = last - 1; k >= 1; --k)
      sum = s[k] + c * sum;
    return sum;
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
      z.q[i] = (q_[i][0] + c * tail(q_[i], order() + 1, c)).value();
      z.p[i] = (p_[i][0] + c * tail(p_[i], order(), c)).value();
    }
    z.t = problem_.clock(z.q, t0 + c * tail(t_, order() + 1, c).value());
    return z;
  }

 private:
  /// One copy of the formulas for each order is a fifth faster where they are short; several copies of long
  /// ones would not fit the instruction cache and would take long to compile.
  static constexpr bool unrolled = form == Field::on_shell && r != dynamic && r <= 4;

  /// Coefficients k + 1 from coefficients 0 to k. Straight-line code only when every operation of H and g is
  /// inlined; once for each K.
  template <int K>
  void replay(double h, bool forces, int order) {
    using S = Jet<Lane, capacity, K>;
    const int k = K < 0 ? order : K;
    tape_.rewind(k);
    Vector<S, n> q, p, dq, dp;
    for (int i = 0; i < n; ++i) {
      q[i] = S(q_[i].data(), &tape_);
      p[i] = S(p_[i].data(), &tape_);
    }
    S pt, dt;
    if constexpr (energy_lane) pt = S(pt_.data(), &tape_);
    problem_.template field<form>(q, p, pt, dq, dp, dt, forces);
    const double factor = h / (k + 1);
    for (int i = 0; i < n; ++i)
      q_[i][k + 1] = factor * dq[i][k];
    t_[k + 1] = factor * dt[k];
    if (forces)
      for (int i = 0; i < n; ++i)
        p_[i][k + 1] = -factor * dp[i][k];
  }

  const Problem problem_;
  const int order_;
  JetTape<Lane, capacity> tape_;
  std::array<Series, n> q_, p_;
  Series t_, pt_;
};

}  // namespace avi
