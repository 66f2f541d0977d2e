#pragma once
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

/// @file
/// Linear equations of a size known at run time.

namespace avi {

/// A square matrix and a right-hand side in memory of their own. A copy has the room and nothing in it:
/// methods are copied where a step is repeated.
class LinearSystem {
 public:
  /// For that many unknowns.
  explicit LinearSystem(Eigen::Index count) { reserve(count); }
  /// Room for as many.
  LinearSystem(const LinearSystem& other) : LinearSystem(other.count_) {}
  /// Room for as many.
  LinearSystem& operator=(const LinearSystem& other) {
    if (count_ != other.count_) reserve(other.count_);
    decomposed = false;
    return *this;
  }
  ~LinearSystem() = default;

  bool decomposed = false;  ///< decompose() was called, and what it found still serves.

  [[nodiscard]] Eigen::Index count() const { return count_; }  ///< Number of unknowns.
  /// An entry of the matrix.
  [[nodiscard]] double& at(Eigen::Index row, Eigen::Index column) { return matrix_[row * count_ + column]; }
  [[nodiscard]] double* right() {
    return right_.get();
  }  ///< The right-hand side; after solve() the solution.
  /// A matrix of zeros.
  void clear() { std::fill(matrix_.get(), matrix_.get() + count_ * count_, 0.0); }

  /// LU decomposition in place, with pivots by column. A vanishing pivot leaves infinities, which a step
  /// reports.
  void decompose() {
    decomposed = true;
    for (Eigen::Index k = 0; k < count_; ++k) {
      Eigen::Index best = k;
      for (Eigen::Index i = k + 1; i < count_; ++i)
        if (std::abs(at(i, k)) > std::abs(at(best, k))) best = i;
      pivots_[k] = best;
      if (best != k) std::swap_ranges(&at(k, 0), &at(k, 0) + count_, &at(best, 0));
      for (Eigen::Index i = k + 1; i < count_; ++i) {
        const double factor = at(i, k) /= at(k, k);
        if (factor != 0.0)
          for (Eigen::Index j = k + 1; j < count_; ++j)
            at(i, j) -= factor * at(k, j);
      }
    }
  }

  /// Replaces the right-hand side by the solution.
  void solve() {
    double* const x = right_.get();
    for (Eigen::Index k = 0; k < count_; ++k)
      std::swap(x[k], x[pivots_[k]]);
    for (Eigen::Index i = 1; i < count_; ++i)
      for (Eigen::Index k = 0; k < i; ++k)
        x[i] -= at(i, k) * x[k];
    for (Eigen::Index k = count_; k-- > 0;) {
      for (Eigen::Index i = k + 1; i < count_; ++i)
        x[k] -= at(k, i) * x[i];
      x[k] /= at(k, k);
    }
  }

 private:
  void reserve(Eigen::Index count) {
    count_ = count;
    matrix_.reset(new double[count * count]);
    right_.reset(new double[count]);
    pivots_.reset(new Eigen::Index[count]);
  }

  Eigen::Index count_ = 0;
  std::unique_ptr<double[]> matrix_, right_;
  std::unique_ptr<Eigen::Index[]> pivots_;
};

}  // namespace avi
