#pragma once
#include "avi/core/state.hpp"

#include <array>
#include <cmath>

/// @file
/// Reference for a Hamiltonian that is not separable.

namespace experiment::work_precision {

/// Gragg's midpoint rule over a step with 2, 4, ... 20 substeps, extrapolated to order 20 (Hairer, Norsett
/// and Wanner, Solving Ordinary Differential Equations I, Section II.9), in extended precision. `Problem`
/// gives d_dq(q, p) and d_dp(q, p).
template <class Problem>
class Extrapolation {
 public:
  static constexpr int n = Problem::dimension;

  Extrapolation(const Problem& problem, const avi::State<n>& start, long double h)
      : problem_(problem), h_(h), t_(start.t) {
    now_ << start.q.template cast<long double>(), start.p.template cast<long double>();
  }

  /// Goes on as long as it stays before `horizon`.
  void run_to(double horizon) {
    for (; t_ + h_ <= horizon; t_ += h_)
      now_ = stepped(now_, h_);
  }

  /// Position at a time after the last step; run_to() has come close.
  [[nodiscard]] avi::Vector<double, n> position(double t) const {
    Vec y = now_;
    const long double rest = t - t_, parts = std::ceil(rest / h_);
    for (long double k = 0; k < parts; ++k)
      y = stepped(y, rest / parts);
    return y.template head<n>().template cast<double>();
  }

 private:
  using Half = avi::Vector<long double, n>;
  using Vec = avi::Vector<long double, 2 * n>;

  [[nodiscard]] Vec field(const Vec& y) const {
    const Half q = y.template head<n>(), p = y.template tail<n>();
    Vec f;
    f << problem_.d_dp(q, p), -problem_.d_dq(q, p);
    return f;
  }

  [[nodiscard]] Vec stepped(const Vec& y, long double h) const {
    constexpr std::size_t columns = 10;
    std::array<Vec, columns> table;  // the last row of Neville's scheme, backwards
    for (std::size_t j = 0; j < columns; ++j) {
      const auto substeps = static_cast<long double>(2 * (j + 1));
      const long double part = h / substeps;
      Vec before = y, now = y + part * field(y);
      for (std::size_t i = 1; i < 2 * (j + 1); ++i) {
        const Vec next = before + 2.0L * part * field(now);
        before = now;
        now = next;
      }
      table[j] = 0.5L * (before + now + part * field(now));
      for (std::size_t k = j; k > 0; --k) {
        const long double ratio = substeps / static_cast<long double>(2 * k);
        table[k - 1] = table[k] + (table[k] - table[k - 1]) / (ratio * ratio - 1.0L);
      }
    }
    return table[0];
  }

  Problem problem_;
  long double h_, t_;
  Vec now_;
};

}  // namespace experiment::work_precision
