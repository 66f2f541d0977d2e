#pragma once
#include "avi/core/state.hpp"

#include <array>
#include <cmath>

// Reference solutions for Hamiltonians that are not separable, by a method independent of the library.

namespace experiment {

/// A step of y' = f(y) by Gragg's midpoint rule with 2, 4, ..., 2 `rows` substeps, extrapolated to order
/// 2 `rows` (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, Section II.9).
template <int rows, class Vec>
class ExtrapolatedStep {
 public:
  /// For vectors of the same size as `any`.
  explicit ExtrapolatedStep(const Vec& any) : before_(any), now_(any), point_(any), slope_(any) {
    column_.fill(any);
  }

  /// Computes the increment of y over h. @param field called as field(y, slope), fills the slope @param slope
  /// the slope at y
  void find(const auto& field, const Vec& y, const Vec& slope, long double h) {
    const auto size = y.size();
    for (int row = 0; row < rows; ++row) {
      const int pieces = 2 * (row + 1);
      const long double piece = h / pieces;
      for (auto i = 0 * size; i < size; ++i)
        before_[i] = 0.0L, now_[i] = piece * slope[i];
      for (int j = 1; j < pieces; ++j) {
        for (auto i = 0 * size; i < size; ++i)
          point_[i] = y[i] + now_[i];
        field(point_, slope_);
        for (auto i = 0 * size; i < size; ++i) {
          const long double next = before_[i] + 2 * piece * slope_[i];
          before_[i] = now_[i];
          now_[i] = next;
        }
      }
      // Neville's scheme in place: column_[j] holds the entry of column row - j of this row.
      column_[row] = now_;
      for (int j = row - 1; j >= 0; --j) {
        const long double ratio = (row + 1.0L) / (j + 1.0L), weight = 1 / (ratio * ratio - 1);
        for (auto i = 0 * size; i < size; ++i)
          column_[j][i] = column_[j + 1][i] + (column_[j + 1][i] - column_[j][i]) * weight;
      }
    }
  }

  [[nodiscard]] const Vec& increment() const { return column_[0]; }  ///< The increment of order 2 `rows`.
  /// The increment without the coarsest row.
  [[nodiscard]] const Vec& coarser() const { return column_[1]; }

 private:
  std::array<Vec, rows> column_;
  Vec before_, now_, point_, slope_;
};

/// y after a step h of y' = field(y), by an extrapolated step of order 2 `columns`.
template <int columns, class Vec>
Vec extrapolated_step(const auto& field, const Vec& y, long double h) {
  ExtrapolatedStep<columns, Vec> step(y);
  step.find([&](const Vec& at, Vec& slope) { slope = field(at); }, y, field(y), h);
  return y + step.increment();
}

/// A run of order 20 in extended precision. `Problem` provides d_dq(q, p) and d_dp(q, p).
template <class Problem>
class Extrapolation {
 public:
  static constexpr int n = Problem::dimension;

  Extrapolation(const Problem& problem, const avi::State<n>& start, long double h)
      : problem_(problem), h_(h), t_(start.t) {
    now_ << start.q.template cast<long double>(), start.p.template cast<long double>();
  }

  /// Takes steps as long as they end at or before `horizon`.
  void run_to(double horizon) {
    for (; t_ + h_ <= horizon; t_ += h_)
      now_ = stepped(now_, h_);
  }

  /// Position at a time t after the last step; run_to() should have come close to it.
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
