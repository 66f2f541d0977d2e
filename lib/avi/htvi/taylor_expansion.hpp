#pragma once
#include "avi/autodiff/recorded.hpp"
#include "avi/autodiff/taylor_series.hpp"
#include "avi/transform/poincare.hpp"

#include <array>
#include <utility>
#include <vector>

/// @file
/// TaylorExpansion: the Taylor method together with its first derivatives.

namespace avi {

/// Taylor expansion of (q, p, t) over one step of a Poincare-transformed problem, with the first partials by
/// the initial values (q, p), and by p^t where the field contains it. The field is recorded once.
/// @tparam r order of the Taylor method Psi^(r); avi::dynamic if given at run time, at most `capacity`
/// @tparam Construction determines which form of the field the expansion follows
template <class Problem, int r, class Construction>
class TaylorExpansion {
  static_assert(Problem::dimension != dynamic,
                "An HTVI needs a dimension known at compile time; avi::collocation() takes any.");
  static_assert(Problem::dimension <= 15,
                "An HTVI carries 2n + 1 partials at a time: n is at most 15; avi::collocation() takes any.");

 public:
  static constexpr int n = Problem::dimension <= 15 ? Problem::dimension : 15;  ///< Dimension of the problem.
  /// p^t is a variable of the expansion.
  static constexpr bool energy_partial = !Problem::unit && Construction::energy_is_variable;
  static constexpr int variables =
      2 * n + (energy_partial ? 1 : 0);                   ///< Number of partials: by q, p and p^t.
  static constexpr bool unit = Problem::unit;             ///< True without a monitor.
  using Number = DualNumber<variables>;                   ///< A number with its partials.
  static constexpr int capacity = r == dynamic ? 15 : r;  ///< The largest order for which there is memory.
  /// Scaled coefficients: entry k is h^k / k! times the k-th derivative.
  using Series = std::array<Number, capacity + 2>;

  /// Increments of the Taylor method over one step.
  struct Increments {
    std::array<Number, n> q;  ///< Up to order r + 1.
    std::array<Number, n> p;  ///< Up to order r.
    Number t;                 ///< Up to order r + 1.
  };

  /// For a problem, which is copied. @throws std::invalid_argument for an order out of range.
  TaylorExpansion(const Problem& problem, int run_time_order)
      : problem_(problem), order_(checked(run_time_order)), field_(problem, order_) {}

  /// The Taylor order r.
  [[nodiscard]] int order() const {
    if constexpr (r == dynamic)
      return order_;
    else
      return r;
  }
  [[nodiscard]] const Problem& problem() const { return problem_; }  ///< The problem.
  /// Coefficients 0 to r + 1 of each position.
  [[nodiscard]] std::array<const Number*, n> q() const { return inputs(0); }
  /// Coefficients 0 to r of each momentum.
  [[nodiscard]] std::array<const Number*, n> p() const { return inputs(n); }

  [[nodiscard]] const Series& t() const { return t_; }  ///< Coefficients 1 to r + 1 of time.

  /// p^t as a variable, or as a constant where the field does not contain it.
  [[nodiscard]] Number energy_momentum() const {
    const double value = problem_.energy_momentum();
    return energy_partial ? Number::variable(value, variables - 1) : Number(value);
  }

  /// Expands around (q, p) over a fictive step h, and returns the increments.
  [[gnu::noinline]] Increments expand(const Vector<double, n>& q, const Vector<double, n>& p, double h) {
    TaylorSeries<Number>& series = field_.series;
    std::array<Number*, n> at_q, at_p;
    for (int i = 0; i < n; ++i) {
      at_q[i] = series.input(i);
      at_p[i] = series.input(n + i);
      at_q[i][0] = Number::variable(q[i], i);
      at_p[i][0] = Number::variable(p[i], n + i);
    }
    if constexpr (energy_partial)
      *series.input(2 * n) = Construction::on_level ? level(q, p) : energy_momentum();
    for (int k = 0; k <= order(); ++k) {
      const bool forces = k < order();  // forces are not needed at the last order
      series.run(k, forces);
      const double factor = h / (k + 1);
      for (int i = 0; i < n; ++i)
        at_q[i][k + 1] = factor * series.output(field_.dq[i])[k];
      t_[k + 1] = factor * series.output(field_.dt)[k];
      if (forces)
        for (int i = 0; i < n; ++i)
          at_p[i][k + 1] = -factor * series.output(field_.dp[i])[k];
    }
    Increments out;
    for (int i = 0; i < n; ++i) {
      out.q[i] = tail(at_q[i], order() + 1, 1.0);
      out.p[i] = tail(at_p[i], order(), 1.0);
    }
    out.t = tail(t_.data(), order() + 1, 1.0);
    return out;
  }

  /// Sum over k = 1..last of s_k c^(k-1).
  [[nodiscard]] static Number tail(const Number* s, int last, double c) {
    if (last == 0) return Number(0.0);
    Number sum = s[last];
    for (int k = last - 1; k >= 1; --k)
      sum = s[k] + c * sum;
    return sum;
  }

 private:
  /// The recorded field and the positions of its outputs in the series.
  struct RecordedField {
    RecordedField(const Problem& problem, int order) : RecordedField(Nodes(problem), order) {}

    TaylorSeries<Number> series;
    std::array<int, n> dq, dp;  // positions of the outputs
    int dt;

   private:
    struct Nodes {
      explicit Nodes(const Problem& problem) {
        const Vector<Recorded, n> q = recorded_inputs<n>(graph, 0, n), p = recorded_inputs<n>(graph, n, n);
        const Recorded pt = energy_partial ? Recorded(graph, 2 * n) : Recorded(problem.energy_momentum());
        Vector<Recorded, n> velocity, force;
        Recorded rate;
        Construction::field(problem, q, p, pt, velocity, force, rate);
        for (int i = 0; i < n; ++i) {
          velocities.push_back(velocity[i].node_in(graph));
          forces.push_back(force[i].node_in(graph));
        }
        velocities.push_back(rate.node_in(graph));
      }
      ExpressionGraph graph{variables};
      std::vector<int> velocities, forces;  // nodes of the rates of q and t; nodes of the rates of p
    };
    RecordedField(const Nodes& nodes, int order)
        : series(nodes.graph, nodes.velocities, nodes.forces, order), dt(series.place(nodes.velocities[n])) {
      for (int i = 0; i < n; ++i) {
        dq[i] = series.place(nodes.velocities[i]);
        dp[i] = series.place(nodes.forces[i]);
      }
    }
  };

  static int checked(int order) {
    require(order >= 0 && order <= capacity, "Taylor order r", order, "in [0, ", capacity, "]");
    return order;
  }
  [[nodiscard]] std::array<const Number*, n> inputs(int first) const {
    std::array<const Number*, n> at;
    for (int i = 0; i < n; ++i)
      at[i] = field_.series.input(first + i);
    return at;
  }
  /// H-bar at the start of the step.
  [[nodiscard]] Number level(const Vector<double, n>& q, const Vector<double, n>& p) const {
    Vector<Number, n> at_q, at_p;
    for (int i = 0; i < n; ++i) {
      at_q[i] = Number::variable(q[i], i);
      at_p[i] = Number::variable(p[i], n + i);
    }
    return problem_.transformed(at_q, at_p, energy_momentum());
  }

  const Problem problem_;
  const int order_;
  RecordedField field_;
  Series t_{};
};

}  // namespace avi
