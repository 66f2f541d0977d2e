#pragma once
#include "avi/collocation/entry_progress.hpp"
#include "avi/collocation/stage_equations.hpp"
#include "avi/core/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

/// @file
/// Newton's method for the stages of a step, where sweeps do not contract.

namespace avi {

/// A square matrix, stored by columns, and a right-hand side. Every loop inside adds a multiple of one
/// column: numbers that do not wait for each other, in the same order whatever the width of a vector.
class LinearSystem {
 public:
  /// For that many unknowns; its memory comes with clear().
  explicit LinearSystem(Eigen::Index count) : count_(count) {}

  /// An entry of the matrix.
  [[nodiscard]] double& at(Eigen::Index row, Eigen::Index column) { return matrix_[column * count_ + row]; }
  /// The right-hand side; after solve() the solution.
  [[nodiscard]] double* right() { return right_.data(); }
  /// A matrix of zeros.
  void clear() {
    matrix_.assign(count_ * count_, 0.0);
    right_.resize(count_);
    pivots_.resize(count_);
  }

  /// LU decomposition of the matrix plus 1, in place, with pivots by column. A vanishing pivot leaves
  /// infinities, which a step reports.
  void decompose() {
    for (Eigen::Index k = 0; k < count_; ++k)
      at(k, k) += 1.0;
    for (Eigen::Index k = 0; k < count_; ++k) {
      Eigen::Index best = k;
      for (Eigen::Index i = k + 1; i < count_; ++i)
        if (std::abs(at(i, k)) > std::abs(at(best, k))) best = i;
      pivots_[k] = best;
      if (best != k)
        for (Eigen::Index j = 0; j < count_; ++j)
          std::swap(at(k, j), at(best, j));
      double* const factors = &at(0, k);
      const double pivot = factors[k];
      for (Eigen::Index i = k + 1; i < count_; ++i)
        factors[i] /= pivot;
      for (Eigen::Index j = k + 1; j < count_; ++j)
        subtract(at(k, j), factors, &at(0, j), k + 1, count_);
    }
  }

  /// Replaces the right-hand side by the solution.
  void solve() {
    double* const x = right_.data();
    for (Eigen::Index k = 0; k < count_; ++k)
      std::swap(x[k], x[pivots_[k]]);
    for (Eigen::Index k = 0; k < count_; ++k)
      subtract(x[k], &at(0, k), x, k + 1, count_);
    for (Eigen::Index k = count_; k-- > 0;) {
      x[k] /= at(k, k);
      subtract(x[k], &at(0, k), x, 0, k);
    }
  }

 private:
  /// to -= factor * from, in the rows from `first` to before `last`.
  static void subtract(double factor, const double* __restrict from, double* __restrict to,
                       Eigen::Index first, Eigen::Index last) {
    if (factor == 0.0) return;
    for (Eigen::Index i = first; i < last; ++i)
      to[i] -= factor * from[i];
  }

  Eigen::Index count_;
  std::vector<double> matrix_, right_;
  std::vector<Eigen::Index> pivots_;
};

/// Simplified Newton iteration: with the Jacobian matrix J of the field at the start of the step, by central
/// differences of its gradients, the equations of the stages \f$z_i = z_0 + h \sum_j a_{ij} f(z_j)\f$ are
/// solved as if f were linear, by one LU decomposition of \f$I - h A \otimes J\f$. An iteration costs a field
/// at all stages and \f$(2 n s)^2\f$ products; a decomposition, which serves many steps, a third of its cube.
/// The first one takes the memory that all need.
///
/// More exact second derivatives would save nothing: with differences of order 4, right to about 1e-12, stiff
/// springs (omega = 50) take 25562, 12759 and 7214 iterations at orders 4, 8 and 16 for 25547, 12759 and 6936
/// with these.
template <int n, int w>
class NewtonIteration {
 public:
  using Step = StageValues<n, w>;  ///< The unknowns of the equations.
  /// Largest number of unknowns, twice the dimension times the number of stages.
  static constexpr Eigen::Index most = 256;

  /// For problems of this size.
  NewtonIteration(Eigen::Index size, int stages)
      : stages_(stages), possible_(2 * size * stages <= most), system_(possible_ ? 2 * size * stages : 0),
        units_(possible_ ? 2 * size : 0), progress_(size) {}

  [[nodiscard]] bool possible() const { return possible_; }  ///< The problem is small enough.

  /// Entries of q, or of p, differ by more than 1e4 in size: there one matrix for all stages may not do.
  [[nodiscard]] bool wide() const {
    const auto half = units_.begin() + static_cast<std::ptrdiff_t>(units_.size() / 2);
    const auto differ = [](auto from, auto to) {
      return from != to && *std::max_element(from, to) > 1e4 * *std::min_element(from, to);
    };
    return differ(units_.begin(), half) || differ(half, units_.end());
  }

  /// The step size is another one.
  void forget() { known_ = false; }

  /// Solves for the stages of a step from those it has, with the Jacobian matrix of every stage, taken again
  /// where changes do not fall. It sees what the matrix at the start does not: a monitor multiplies its
  /// gradient by the energy that the stages lack, most of it that of heavy bodies, and to the momentum of a
  /// light one this is anything but small. A matrix costs 4 n + 1 fields at all stages and serves one step.
  /// Two in a row that do not halve the changes are enough. This method converges or meets noise: what stops
  /// improving below `noise` is solved.
  StepReport solve_at_stages(StageEquations<n, w>& equations, Step& step, Step& old, int cap) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon(), noise = 1e-7;
    StepReport report{.outcome = Outcome::not_converged};
    known_ = false;
    progress_.restart(noise);
    double least = std::numeric_limits<double>::infinity();
    bool fresh = false;
    for (int vain = 0; vain < 2 && report.evaluations < cap;) {
      if (!fresh) report.evaluations += decompose_at_stages(equations, step, old);
      ++report.evaluations;
      const double now = report.residual = improve(equations, step, old);
      if (!std::isfinite(now)) {
        report.outcome = Outcome::non_finite;
        return report;
      }
      if (now <= epsilon || progress_.settled(2, true)) {
        report.outcome = Outcome::ok;
        return report;
      }
      vain = fresh || now <= 0.5 * least || now <= noise ? 0 : vain + 1;
      fresh = now <= noise || now <= 0.1 * least;
      least = std::min(least, now);
    }
    return report;
  }

  /// Solves for the stages of a step, from a constant. Changes may grow for a while; if eight in a row are
  /// more than half of the smallest one before them, the step is too long for the motion.
  /// @param old scratch, q and p only @param cap on evaluations of the field @return ok, not_converged or
  ///   non_finite
  StepReport solve(StageEquations<n, w>& equations, Step& step, Step& old, int cap) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    StepReport report{.outcome = Outcome::not_converged};
    const bool known = std::exchange(known_, false);
    const int of_matrix = known ? 0 : decompose(equations, step);
    report.evaluations = of_matrix;
    equations.begin(step);
    progress_.restart();
    double least = std::numeric_limits<double>::infinity();
    for (int idle = 0; report.evaluations < cap;) {
      ++report.evaluations;
      const double now = report.residual = improve(equations, step, old);
      if (!std::isfinite(now)) report.outcome = Outcome::non_finite;
      idle = now <= 0.5 * least ? 0 : idle + 1;
      if (now <= epsilon || (idle > 0 && now <= 16.0 * epsilon) || progress_.settled(2, true)) {
        report.outcome = Outcome::ok;
        known_ = report.evaluations - of_matrix <= 12;
        return report;
      }
      if (idle == 8 || report.outcome == Outcome::non_finite) break;
      least = std::min(least, now);
    }
    if (!known) return report;
    const int spent = report.evaluations;
    report = solve(equations, step, old, cap - spent);  // with the matrix of this start
    report.evaluations += spent;
    return report;
  }

 private:
  /// Decomposes the matrix of steps like this one from their start. @param step is used as a scratch
  /// @return evaluations of the field
  [[gnu::noinline]] int decompose(StageEquations<n, w>& equations, Step& step) {
    system_.clear();
    equations.begin(step);
    equations.evaluate(step);
    int evaluations = 1;
    const Eigen::Index size = step.q.size();
    set_units(step);
    for (Eigen::Index first = 0; first < 2 * size; first += stages_) {
      const int columns = static_cast<int>(std::min<Eigen::Index>(stages_, 2 * size - first));
      for (const double side : {1.0, -1.0}) {
        equations.begin(step);
        for (int lane = 0; lane < columns; ++lane)
          entry(step.q, step.p, first + lane)
              .set(lane, start(step, first + lane) + side * reach(first + lane));
        equations.evaluate(step);
        ++evaluations;
        for (int lane = 0; lane < columns; ++lane) {
          const double scale = -0.5 * side / (reach(first + lane) * equations.weight()[lane]);
          for (Eigen::Index row = 0; row < 2 * size; ++row) {
            const double slope =
                scale * units_[first + lane] / units_[row] * entry(step.dq, step.dp, row)[lane];
            for (int j = 0; j < stages_; ++j)
              for (int i = 0; i < stages_; ++i)
                system_.at(row * stages_ + i, (first + lane) * stages_ + j) +=
                    slope * equations.rule().mu(i, j) * equations.weight()[j];
          }
        }
      }
    }
    system_.decompose();
    return evaluations;
  }

  /// Decomposes the matrix at the stages as they are. @param old scratch @return evaluations of the field
  [[gnu::noinline]] int decompose_at_stages(StageEquations<n, w>& equations, Step& step, Step& old) {
    system_.clear();
    equations.evaluate(step);
    set_units(step);
    old.q = step.q;
    old.p = step.p;
    const Eigen::Index rows = 2 * step.q.size();
    for (Eigen::Index column = 0; column < rows; ++column)
      for (const double side : {1.0, -1.0}) {
        entry(step.q, step.p, column) = entry(old.q, old.p, column) + Pack<w>(side * reach(column));
        equations.evaluate(step);
        entry(step.q, step.p, column) = entry(old.q, old.p, column);
        for (Eigen::Index row = 0; row < rows; ++row) {
          const double scale = -0.5 * side / reach(column) * (units_[column] / units_[row]);
          const Pack<w> slope = Pack<w>(scale) * entry(step.dq, step.dp, row);
          for (int j = 0; j < stages_; ++j)
            for (int i = 0; i < stages_; ++i)
              system_.at(row * stages_ + i, column * stages_ + j) += slope[j] * equations.rule().mu(i, j);
        }
      }
    system_.decompose();
    return static_cast<int>(2 * rows + 1);
  }

  /// The next iterate, from a sweep. @param old gets q and p of the last one @return relative change
  [[gnu::noinline]] double improve(StageEquations<n, w>& equations, Step& step, Step& old) {
    old.q = step.q;
    old.p = step.p;
    equations.sweep_at_once(step);
    const Eigen::Index rows = 2 * old.q.size();
    double* const x = system_.right();
    for (Eigen::Index v = 0; v < rows; ++v)
      for (int i = 0; i < stages_; ++i)
        x[v * stages_ + i] = (entry(step.q, step.p, v)[i] - entry(old.q, old.p, v)[i]) / units_[v];
    system_.solve();
    for (Eigen::Index v = 0; v < rows; ++v) {
      Pack<w>& next = entry(step.q, step.p, v);
      for (int i = 0; i < w; ++i) {
        const int stage = std::min(i, stages_ - 1);
        next.set(i, entry(old.q, old.p, v)[stage] + x[v * stages_ + stage] * units_[v]);
      }
    }
    step.per.set(step.start.state, step.dq, step.dp);
    progress_.look(old, step);
    return progress_.change();
  }
  /// Number v of (q, p).
  template <class V>
  static auto& entry(V& q, V& p, Eigen::Index v) {
    return v < q.size() ? q[v] : p[v - q.size()];
  }
  static double start(const Step& step, Eigen::Index v) {
    return entry(step.start.state.q, step.start.state.p, v);
  }
  /// A unit for each unknown, of its own size, a power of two: in it the matrix has pivots that compare, and
  /// differences reach as far for a light body as for a heavy one. A number near zero may be on its way.
  void set_units(const Step& step) {
    const Eigen::Index size = step.q.size();
    for (Eigen::Index v = 0; v < 2 * size; ++v) {
      const double largest = largest_entry(v < size ? step.start.state.q : step.start.state.p),
                   way = sum(abs(entry(step.dq, step.dp, v)));
      double unit = std::abs(start(step, v)) + (largest > 0.0 ? std::min(way, largest) : way);
      if (!(unit > 1e-290)) unit = largest;
      units_[v] = std::isfinite(unit) && unit > 1e-290 ? std::exp2(std::ilogb(unit)) : 1.0;
    }
  }
  /// How far to look for a difference: the cube root of the rounding error.
  [[nodiscard]] double reach(Eigen::Index v) const { return 6e-6 * units_[v]; }

  int stages_;
  bool possible_, known_ = false;  // the matrix that is decomposed serves the next step
  LinearSystem system_;
  std::vector<double> units_;
  EntryProgress<n, w> progress_;
};

}  // namespace avi
