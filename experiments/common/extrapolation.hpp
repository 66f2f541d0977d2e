#pragma once
#include "avi/core/state.hpp"

#include <array>
#include <cmath>

/// @file
/// References for Hamiltonians that are not separable, by a method that shares nothing with the library's.

namespace experiment {

/// y a step h on, y' = field(y), by Gragg's midpoint rule with 2, 4, ..., 2 `columns` substeps, extrapolated
/// to order 2 `columns` (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, Section
/// II.9).
template <int columns, class Vec, class Field>
Vec extrapolated_step(const Field& field, const Vec& y, long double h) {
  std::array<Vec, columns> row;  // of Neville's scheme in the square of the substep, backwards
  for (int j = 0; j < columns; ++j) {
    const long double part = h / (2 * (j + 1));
    Vec before = y, now = y + part * field(y);
    for (int i = 1; i < 2 * (j + 1); ++i) {
      const Vec next = before + 2.0L * part * field(now);
      before = now;
      now = next;
    }
    row[j] = 0.5L * (before + now + part * field(now));
    for (int k = j; k > 0; --k) {
      const long double ratio = (j + 1.0L) / k;
      row[k - 1] = row[k] + (row[k] - row[k - 1]) / (ratio * ratio - 1.0L);
    }
  }
  return row[0];
}

/// A run of order 20 in extended precision. `Problem` gives d_dq(q, p) and d_dp(q, p).
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

  [[nodiscard]] Vec stepped(const Vec& y, long double h) const {
    const auto field = [this](const Vec& z) {
      const Half q = z.template head<n>(), p = z.template tail<n>();
      Vec f;
      f << problem_.d_dp(q, p), -problem_.d_dq(q, p);
      return f;
    };
    return extrapolated_step<10>(field, y, h);
  }

  Problem problem_;
  long double h_, t_;
  Vec now_;
};

}  // namespace experiment
