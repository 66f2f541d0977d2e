#pragma once
#include "avi/autodiff/jet.hpp"
#include "avi/transform/poincare.hpp"

#include <algorithm>
#include <array>

/// @file
/// The Taylor method with its first derivatives.

namespace avi {

/// Taylor expansion of (q, p, t) over one step of a Poincare-transformed problem, with first partials with
/// respect to the initial values (q, p), and to p^t where the field contains it. The field is called once and
/// written on a JetTape, which every expansion runs anew; a formula that looks at values is called at every
/// expansion.
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
  static constexpr bool energy_lane = !Problem::unit && form != Field::on_shell;
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
    require(order_ >= 0 && order_ <= capacity, "Taylor order r", order_, "in [0, ", capacity, "]");
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

  /// p^t as a variable, or as a constant where the field does not contain it.
  [[nodiscard]] Lane energy_momentum() const {
    const double value = problem_.energy_momentum();
    return energy_lane ? Lane::variable(value, variables - 1) : Lane(value);
  }

  /// Expands from (q, p) over a fictive step h.
  [[gnu::noinline]] Increments expand(const Vector<double, n>& q, const Vector<double, n>& p, double h) {
    for (int i = 0; i < n; ++i) {
      q_[i][0] = Lane::variable(q[i], i);
      p_[i][0] = Lane::variable(p[i], n + i);
    }
    if constexpr (energy_lane) pt_[0] = form == Field::on_level ? level() : energy_momentum();
    for (int k = 0; k <= order(); ++k) {
      // The forces are not needed at the last order, but once at least, for energy_slope().
      const bool forces = k < order() || k == 0;
      if (k == 0 && (tape_.size() == 0 || tape_.branched))
        write();
      else
        tape_.run(k, forces ? tape_.size() : velocities_);
      const double factor = h / (k + 1);
      for (int i = 0; i < n; ++i)
        q_[i][k + 1] = factor * dq_[i][k];
      t_[k + 1] = factor * dt_[k];
      if (forces)
        for (int i = 0; i < n; ++i)
          p_[i][k + 1] = -factor * dp_[i][k];
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
  using Written = Jet<Lane, capacity>;

  /// H-bar at the start.
  [[nodiscard]] Lane level() const {
    Vector<Lane, n> q, p;
    for (int i = 0; i < n; ++i) {
      q[i] = q_[i][0];
      p[i] = p_[i][0];
    }
    return problem_.transformed(q, p, energy_momentum());
  }
  /// Writes the field on the tape, with coefficients 0: first without the forces, to see where they begin.
  [[gnu::noinline]] void write() {
    for (const bool forces : {false, true}) {
      tape_.clear();
      Vector<Written, n> q, p;
      for (int i = 0; i < n; ++i) {
        q[i] = Written(q_[i].data(), &tape_);
        p[i] = Written(p_[i].data(), &tape_);
      }
      Written pt;
      if constexpr (energy_lane) {
        std::fill(pt_.begin() + 1, pt_.end(), Lane(0.0));
        pt = Written(pt_.data(), &tape_);
      }
      problem_.template field<form>(q, p, pt, dq_, dp_, dt_, forces);
      if (!forces) velocities_ = tape_.size();
    }
  }

  const Problem problem_;
  const int order_;
  JetTape<Lane, capacity> tape_;
  int velocities_ = 0;  // slots of the tape before the forces
  Vector<Written, n> dq_, dp_;
  Written dt_;
  std::array<Series, n> q_, p_;
  Series t_, pt_;  // pt_: p^t, or H-bar
};

}  // namespace avi
