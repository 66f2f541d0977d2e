#pragma once
#include "avi/adaptive/poincare.hpp"
#include "avi/taylor/jet.hpp"
#include "avi/taylor/jet_functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

/// @file
/// The Taylor expansion of one step without derivatives.

namespace avi {

/// Taylor polynomial of order r of (q, p, t) over one step of a Poincare-transformed problem, on the energy
/// shell: what an HTVI expands, but numbers in place of numbers with their partials - about a quarter of the
/// work.
template <class Problem, int r>
class TaylorValues {
 public:
  static_assert(r >= 2,
                "The test of convergence looks at the coefficients r and r - 2: r must be at least 2.");
  static constexpr int n = Problem::dimension;  ///< Dimension of the problem.
  static_assert(n != dynamic, "Expansions without derivatives need a dimension known at compile time.");

  /// For a problem. @param problem copied @param tape_slots room for the intermediate results of H and g
  explicit TaylorValues(const Problem& problem, std::size_t tape_slots = 512)
      : problem_(problem), tape_(tape_slots) {}

  /// Expands from (q, p) over the fictive step h.
  void expand(const Vector<double, n>& q, const Vector<double, n>& p, double h) {
    for (int i = 0; i < n; ++i) {
      q_[i][0] = q[i];
      p_[i][0] = p[i];
    }
    [&]<int... k>(std::integer_sequence<int, k...>) { (replay<k>(h), ...); }
    (std::make_integer_sequence<int, r>{});
  }

  /// Sets q, p and t to their increments over the step.
  void increments(Vector<double, n>& q, Vector<double, n>& p, double& t) const {
    for (int i = 0; i < n; ++i) {
      q[i] = sum(q_[i]);
      p[i] = sum(p_[i]);
    }
    t = sum(t_);
  }

  /// Whether the expansion has converged to a relative tolerance: for q and for p, the remainder
  /// c_r rho / (1 - rho) of a geometric series of ratio rho = (c_r / c_(r-2))^(1/2) is at most that part of
  /// the largest entry, where c_k is the largest entry of coefficient k (Jorba and Zou 2005, Section 3.2,
  /// choose steps by such a ratio). An estimate, not a bound: a function with gaps in its series can deceive
  /// it.
  [[nodiscard]] bool converged(double tolerance = half_ulp) const {
    return converged(q_, tolerance) && converged(p_, tolerance);
  }
  /// Half a unit in the last place of 1: convergence to round-off.
  static constexpr double half_ulp = 0.5 * std::numeric_limits<double>::epsilon();

 private:
  using Series =
      std::array<double, r + 2>;  // scaled coefficients: entry k is h^k / k! times the k-th derivative

  template <int k>
  [[gnu::noinline, gnu::flatten]] void replay(double h) {
    using S = Jet<double, r, k>;
    tape_.rewind(k);
    Vector<S, n> q, p, dq, dp;
    for (int i = 0; i < n; ++i) {
      q[i] = S(q_[i].data(), &tape_);
      p[i] = S(p_[i].data(), &tape_);
    }
    S pt, dt;
    Room<S, n> room(n);
    problem_.template field<Field::on_shell, true>(q, p, pt, dq, dp, dt, room);
    const double factor = h / (k + 1);
    t_[k + 1] = factor * dt[k];
    for (int i = 0; i < n; ++i) {
      q_[i][k + 1] = factor * dq[i][k];
      p_[i][k + 1] = -factor * dp[i][k];
    }
  }

  static double sum(const Series& s) {
    double x = s[r];
    for (int k = r - 1; k >= 1; --k)
      x += s[k];
    return x;
  }

  static bool converged(const std::array<Series, n>& series, double tolerance) {
    const auto largest = [&](int k) {
      double most = 0.0;
      for (const Series& s : series)
        most = std::max(most, std::abs(s[static_cast<std::size_t>(k)]));
      return most;
    };
    const double last = largest(r), ratio = std::sqrt(last / largest(r - 2));
    // NaN, and a ratio of 1 and more, fail.
    return ratio < 1.0 && last * ratio <= tolerance * (1.0 - ratio) * largest(0);
  }

  const Problem problem_;
  JetTape<double, r> tape_;
  std::array<Series, n> q_, p_;
  Series t_;
};

}  // namespace avi
