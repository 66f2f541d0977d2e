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
/// Newton's method for the stages of a step, used where sweeps do not contract.

namespace avi {

/// A square matrix, stored by columns, with a right-hand side. Every inner loop adds a multiple of one
/// column. Its operations are independent of each other and have the same order for any vector width.
class LinearSystem {
 public:
  /// For this number of unknowns; clear() allocates the memory.
  explicit LinearSystem(Eigen::Index count) : count_(count) {}

  /// An entry of the matrix.
  [[nodiscard]] double& at(Eigen::Index row, Eigen::Index column) { return matrix_[column * count_ + row]; }
  /// The right-hand side; after solve() the solution.
  [[nodiscard]] double* right() { return right_.data(); }
  /// Sets the matrix to zero; the first call allocates all memory.
  void clear() {
    matrix_.assign(count_ * count_, 0.0);
    right_.resize(count_);
    pivots_.resize(count_);
  }

  /// LU decomposition of the matrix plus the identity, in place, with row pivoting. A zero pivot gives
  /// infinities, which the step then reports.
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

  /// Replaces the right-hand side by the solution, after decompose().
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
  /// to -= factor * from, for the rows `first` to `last` - 1.
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

/// Simplified Newton iteration for the stages \f$z_i = z_0 + h \sum_j a_{ij} f(z_j)\f$. f is treated as
/// linear, with its Jacobian matrix J at the start of the step, from central differences of the gradients;
/// one LU decomposition of \f$I - h A \otimes J\f$ serves many steps. An iteration costs one evaluation of
/// the field at all stages and \f$(2 n s)^2\f$ multiplications, a decomposition a third of \f$(2 n s)^3\f$.
/// The first decomposition allocates all memory.
///
/// More exact second derivatives would not help: with differences of order 4, right to about 1e-12, stiff
/// springs (omega = 50) take 25562, 12759 and 7214 iterations at orders 4, 8 and 16, against 25547, 12759 and
/// 6936 with these.
template <int n, int w>
class NewtonIteration {
 public:
  using Step = StageValues<n, w>;  ///< The unknowns of the equations.
  /// Largest number of unknowns, twice the dimension times the number of stages.
  static constexpr Eigen::Index most = 256;

  /// For a problem with n = `size` and this number of stages.
  NewtonIteration(Eigen::Index size, int stages)
      : stages_(stages), possible_(2 * size * stages <= most), system_(possible_ ? 2 * size * stages : 0),
        units_(possible_ ? 2 * size : 0), progress_(size) {}

  [[nodiscard]] bool possible() const { return possible_; }  ///< The problem is small enough for a matrix.

  /// True where entries of q, or of p, differ in size by more than 1e4: one matrix for all stages may then
  /// not do.
  [[nodiscard]] bool wide() const {
    const auto half = units_.begin() + static_cast<std::ptrdiff_t>(units_.size() / 2);
    const auto differ = [](auto from, auto to) {
      return from != to && *std::max_element(from, to) > 1e4 * *std::min_element(from, to);
    };
    return differ(units_.begin(), half) || differ(half, units_.end());
  }

  /// Discards the decomposed matrix, because the step size or the orbit has changed.
  void forget() { known_ = false; }

  /// Solves for the stages, starting from their present values, with the Jacobian matrix at each stage; the
  /// matrix is renewed where changes do not fall. This captures what the matrix at the start misses: the
  /// gradient of a monitor is multiplied by the energy error of the stages, most of it from heavy bodies,
  /// which is large for the momentum of a light one. A matrix costs 4 n + 1 evaluations of the field at all
  /// stages and serves one step. The iteration stops after two new matrices in a row that do not halve the
  /// changes. Newton's method either converges or reaches noise: a step whose changes stop falling below
  /// `noise` counts as solved.
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

  /// Solves for the stages, starting from a constant. Changes may grow for a while, but if eight in a row
  /// exceed half of the smallest one before them, the step is too long for the motion.
  /// @param old scratch, q and p only @param cap on evaluations of the field @return ok, not_converged or
  /// non_finite
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
    report = solve(equations, step, old, cap - spent);  // with a new matrix, from this start
    report.evaluations += spent;
    return report;
  }

 private:
  /// Decomposes the matrix for steps of this size from this start. @param step used as scratch
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

  /// Decomposes the matrix with Jacobians at the present stages. @param old scratch @return evaluations of
  /// the field
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

  /// One iteration: a sweep, corrected by the matrix. @param old receives the previous q and p
  /// @return relative change
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
  /// Entry v of (q, p).
  template <class V>
  static auto& entry(V& q, V& p, Eigen::Index v) {
    return v < q.size() ? q[v] : p[v - q.size()];
  }
  static double start(const Step& step, Eigen::Index v) {
    return entry(step.start.state.q, step.start.state.p, v);
  }
  /// Units for the unknowns: for each entry a power of two of about its own size. Pivots of the matrix are
  /// then comparable, and differences have suitable lengths for light and heavy bodies alike. For a number
  /// near zero, its change in a step is included.
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
  /// Length of the differences: about the cube root of the rounding error, in the unit of the entry.
  [[nodiscard]] double reach(Eigen::Index v) const { return 6e-6 * units_[v]; }

  int stages_;
  bool possible_, known_ = false;  // the decomposed matrix serves the next step
  LinearSystem system_;
  std::vector<double> units_;
  EntryProgress<n, w> progress_;
};

}  // namespace avi
