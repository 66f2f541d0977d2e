#pragma once
#include "avi/htvi/discrete_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

/// @file
/// The iteration that solves the implicit equation of an HTVI.

namespace avi {

/// Settings of the iteration: how accurately the implicit equation is solved.
struct SolverSettings {
  double tolerance = 8.0;   ///< Accepted residual, in machine epsilons times the size of the unknown.
  int max_iterations = 50;  ///< Expansions in one step, after which it ends as Outcome::not_converged.
};

/// First guess of an unknown that changes smoothly from step to step: linear extrapolation from the last two
/// steps.
template <int n>
class Predictor {
 public:
  /// True where the last step had size h and ended at this point.
  [[nodiscard]] bool goes_on(double h, const Vector<double, n>& start) const {
    return h == last_h_ && std::equal(start.begin(), start.end(), end_.begin());
  }
  /// The guess for a step h from `start`; zero unless the last two steps had this size and the last one ended
  /// here.
  [[nodiscard]] Vector<double, n> guess(double h, const Vector<double, n>& start) const {
    if (!goes_on(h, start) || h != last_but_one_h_) return Vector<double, n>::Zero();
    return 2.0 * last_ - last_but_one_;
  }
  /// Stores the value found in a step h and the point where the step ended. @param went_on true if the step
  /// continued from the one before it
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

/// An estimate of the derivative J of the corrections w(u) with respect to the unknown u. It is learnt from
/// pairs of evaluations by Broyden's update, and is a good first estimate for the next step of the same size.
/// It gives the shift of u that solves \f$w(u) = u - u_0\f$, and the change of w caused by that shift.
/// @tparam m size of w, whose first n entries are to equal u - u_0
template <int n, int m>
class SecantModel {
 public:
  /// Updates J from a shift of u that changed w by `change`.
  /// @param unit units of the entries of u, see solver_units() @return the error that J had along the shift,
  /// relative to the size of the shift
  double learn(const Vector<double, n>& shift, const Vector<double, m>& change,
               const Vector<double, n>& unit) {
    // Scaled by a power of two, so that squares of shifts below 1e-154 do not underflow.
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
  /// The shift of u that removes this residual.
  [[nodiscard]] Vector<double, n> shift(const Vector<double, n>& residual) const {
    Matrix<double, n> factor;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        factor(i, j) = -slope_(i, j) + (i == j ? 1.0 : 0.0);
    return inverse<n>(factor) * residual;
  }
  /// The change of w caused by a shift of u.
  [[nodiscard]] Vector<double, m> change(const Vector<double, n>& shift) const { return slope_ * shift; }

 private:
  Matrix<double, m, n> slope_ = Matrix<double, m, n>::Zero();
};

/// A unit for each entry of the unknown, so that every entry is solved for. It is a power of two: for an
/// entry less than about a thousandth of the largest, such as the momentum of a light body, the factor that
/// makes it about as large; otherwise 1.
/// @param size sizes of the entries @param largest the largest of them
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

/// The state of the iteration in a step.
template <int n>
struct IterationProgress {
  Vector<double, n> unit;  ///< Units of the entries, see solver_units().
  double residual;         ///< Largest entry of the residual, each in its unit.
  double previous;         ///< The same one evaluation before; NaN at first.
  double accepted;         ///< Residual below which the equation counts as solved.
  bool stagnates;          ///< Rounding keeps the residual above that bound.
};

/// The quasi-Newton iteration for the unknown u of a step, with the SecantModel learnt in this step and the
/// last.
template <int n>
class SecantIteration {
 public:
  /// The iteration for a new step, with the present model if that step continues from the last one.
  [[nodiscard]] SecantIteration begin(bool goes_on) const {
    SecantIteration next;
    if (goes_on) next.model_ = model_;
    return next;
  }
  /// Computes the shift of u from the equations at u; returns true where the shift solves them to the
  /// accepted accuracy.
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
    // Where I - J is nearly singular, the computed shift may not solve the linear system.
    const Vector<double, n> left = shift - model_.change(shift).template head<n>() - residual;
    return largest_entry(left.cwiseProduct(now.unit)) <= 0.1 * now.accepted;
  }
  /// The step for u + shift.
  template <class Equations>
  [[nodiscard]] StepChange<n> step(const Equations& equations, const Vector<double, n>& residual) const {
    return equations.shifted(residual, shift, model_.change(shift));
  }

  Vector<double, n> shift;  ///< The last computed shift of u.

 private:
  SecantModel<n, 2 * n + 1> model_;
  Vector<double, 2 * n + 1> before_;
  bool first_ = true;
};

}  // namespace avi
