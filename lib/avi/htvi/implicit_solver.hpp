#pragma once
#include "avi/htvi/discrete_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

/// @file
/// How the implicit equation of an HTVI is solved.

namespace avi {

/// How far the implicit equation of a step is solved.
struct SolverSettings {
  double tolerance = 8.0;   ///< Residual accepted, in units of machine epsilon times the size of the unknown.
  int max_iterations = 50;  ///< Expansions in one step before it ends as Outcome::not_converged.
};

/// First guess of an unknown that changes smoothly from step to step: the line through its values at the last
/// two steps.
template <int n>
class Predictor {
 public:
  /// True where the last step had this size and led to this point.
  [[nodiscard]] bool goes_on(double h, const Vector<double, n>& start) const {
    return h == last_h_ && std::equal(start.begin(), start.end(), end_.begin());
  }
  /// The guess for a step h from `start`: zero unless the last two steps had this size and led to this point.
  [[nodiscard]] Vector<double, n> guess(double h, const Vector<double, n>& start) const {
    if (!goes_on(h, start) || h != last_but_one_h_) return Vector<double, n>::Zero();
    return 2.0 * last_ - last_but_one_;
  }
  /// Stores the value that a step h found, the point where the step ended, and whether it went on from the
  /// one before.
  void remember(const Vector<double, n>& value, double h, const Vector<double, n>& end, bool went_on) {
    if (!went_on) last_h_ = 0.0;
    last_but_one_ = std::exchange(last_, value);
    last_but_one_h_ = std::exchange(last_h_, h);
    end_ = end;
  }

 private:
  Vector<double, n> last_ = Vector<double, n>::Zero(), last_but_one_, end_;
  double last_h_ = 0.0, last_but_one_h_ = 0.0;
};

/// The derivative J of the corrections w(u) by the unknown u: learnt from pairs of evaluations
/// by Broyden's update, and a good guess for the next step of the same size. It gives the shift of u for
/// \f$w(u) = u - u_0\f$ as well as the change of w that goes with it.
/// @tparam m size of w, whose first n entries ask for u - u_0
template <int n, int m>
class SecantModel {
 public:
  /// Learns from a shift of u that changed w by `change`.
  /// @param unit of the entries of u, see solver_units() @return the error that J had along that shift,
  /// relative to its size
  double learn(const Vector<double, n>& shift, const Vector<double, m>& change,
               const Vector<double, n>& unit) {
    // By a power of two, so that squares of shifts below 1e-154 are not lost.
    Vector<double, n> along = shift.cwiseProduct(unit);
    const double largest = largest_entry(along);
    if (!(largest > 0.0)) return std::numeric_limits<double>::infinity();
    const double scale = std::ldexp(1.0, std::min(-std::ilogb(largest), 1000));
    along *= scale;
    Vector<double, m> miss = scale * (change - slope_ * shift);
    const double square = along.squaredNorm();
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j)
        slope_(i, j) += miss[i] / square * along[j] * unit[j];
    miss.template head<n>() = miss.template head<n>().cwiseProduct(unit);
    return miss.norm() / along.norm();
  }
  /// The shift of u for this residual.
  [[nodiscard]] Vector<double, n> shift(const Vector<double, n>& residual) const {
    Matrix<double, n> factor;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        factor(i, j) = -slope_(i, j) + (i == j ? 1.0 : 0.0);
    return inverse<n>(factor) * residual;
  }
  /// The change of w that a shift of u brings.
  [[nodiscard]] Vector<double, m> change(const Vector<double, n>& shift) const { return slope_ * shift; }

 private:
  Matrix<double, m, n> slope_ = Matrix<double, m, n>::Zero();
};

/// For each entry of the unknown a power of two: 1, or what makes it about as large as the largest one where
/// it is less than a thousandth of that, as the momentum of a light body. So every entry is solved for.
/// @param size of each entry @param largest of them
template <int n>
Vector<double, n> solver_units(const Vector<double, n>& size, double largest) {
  Vector<double, n> unit;
  for (int i = 0; i < n; ++i) {
    const double ratio = largest / size[i];
    unit[i] =
        ratio > 1024.0 && std::isfinite(ratio) ? std::ldexp(1.0, std::min(std::ilogb(ratio), 1000)) : 1.0;
  }
  return unit;
}

/// How far a step's iteration has come.
template <int n>
struct IterationProgress {
  Vector<double, n> unit;  ///< Units of the entries, see solver_units().
  double residual;         ///< Largest entry in its unit, now.
  double previous;         ///< One evaluation before; NaN at first.
  double accepted;         ///< Bound below which the equation counts as solved.
  bool stagnates;          ///< Rounding holds the residual above that.
};

/// The iteration of a step for its unknown u, by the derivative of the corrections that a SecantModel has
/// learnt, in this step and in the last one.
template <int n>
class SecantIteration {
 public:
  /// For a new step; with what is known where it goes on from the last one.
  [[nodiscard]] SecantIteration begin(bool goes_on) const {
    SecantIteration next;
    if (goes_on) next.model_ = model_;
    return next;
  }
  /// The shift of u at these equations; true where it is exact to what is accepted.
  template <class Equations>
  bool propose(const Equations& equations, const Vector<double, n>& residual,
               const IterationProgress<n>& now) {
    const double error = first_ ? std::numeric_limits<double>::infinity()
                                : model_.learn(shift, equations.corrections - before_, now.unit);
    first_ = false;
    before_ = equations.corrections;
    shift = model_.shift(residual);
    const Vector<double, n> moved = shift.cwiseProduct(now.unit);
    const double plain = moved.norm(), size = plain > 1e-150 ? plain : moved.stableNorm();
    if (!(error * size <= 0.1 * now.accepted)) return false;
    // Where I - J is nearly singular the shift may be no solution of its own equations.
    const Vector<double, n> left = shift - model_.change(shift).template head<n>() - residual;
    return largest_entry(left.cwiseProduct(now.unit)) <= 0.1 * now.accepted;
  }
  /// The step at u + shift.
  template <class Equations>
  [[nodiscard]] StepChange<n> step(const Equations& equations, const Vector<double, n>& residual) const {
    return equations.shifted(residual, shift, model_.change(shift));
  }

  Vector<double, n> shift;  ///< Shift of u.

 private:
  SecantModel<n, 2 * n + 1> model_;
  Vector<double, 2 * n + 1> before_;
  bool first_ = true;
};

}  // namespace avi
