#pragma once
#include "avi/core/inverse.hpp"

#include <algorithm>
#include <utility>

/// @file
/// How the implicit equation of an HTVI is solved.

namespace avi {

/// How far the implicit equation of a step is solved.
struct SolverSettings {
  double tolerance = 8.0;   ///< Residual accepted, in units of machine epsilon times the size of the unknown.
  int max_iterations = 50;  ///< Expansions in one step before it ends as Outcome::not_converged.
  bool quasi_newton = true;  ///< Learn from earlier evaluations by Broyden's method; for the paper's
                             ///< constructions, where the iteration contracts slowly.
};

/// First guess of an unknown that changes smoothly from step to step: the line through its values at the last
/// two steps.
template <int n>
class Predictor {
 public:
  /// Whether the last step had this size and led to this point.
  [[nodiscard]] bool goes_on(double h, const Vector<double, n>& start) const {
    return h == last_h_ && std::equal(start.begin(), start.end(), end_.begin());
  }
  /// The guess for a step h from `start`: zero unless the last two steps had this size and led to this point.
  [[nodiscard]] Vector<double, n> guess(double h, const Vector<double, n>& start) const {
    if (!goes_on(h, start) || h != last_but_one_h_) return Vector<double, n>::Zero();
    return 2.0 * last_ - last_but_one_;
  }
  /// Stores the value that a step h found, and the point where the step ended.
  void remember(const Vector<double, n>& value, double h, const Vector<double, n>& end) {
    last_but_one_ = std::exchange(last_, value);
    last_but_one_h_ = std::exchange(last_h_, h);
    end_ = end;
  }

 private:
  Vector<double, n> last_ = Vector<double, n>::Zero(), last_but_one_, end_;
  double last_h_ = 0.0, last_but_one_h_ = 0.0;
};

/// Broyden's quasi-Newton method for F(u) = 0 where the plain iteration u += F(u) contracts slowly, or not at
/// all: at large h and for stiff problems. It takes over at the first residual that has not fallen to a
/// tenth of the one before, and starts from the identity, i.e. from the plain iteration.
template <int n>
class Broyden {
 public:
  /// The shift of u for this residual. @param plain that of the plain iteration
  Vector<double, n> shift(const Vector<double, n>& residual, const Vector<double, n>& plain, bool slow) {
    if (slow && !at_work_) {
      inverse_.setIdentity();
      at_work_ = true;
    }
    if (at_work_) {
      // The update makes the inverse map the last decrease of the residual to the last shift.
      const Vector<double, n> image = inverse_ * (last_residual_ - residual);
      const double scale = last_shift_.dot(image);
      if (scale != 0.0) {
        const auto row = (last_shift_.transpose() * inverse_).eval();
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            inverse_(i, j) += (last_shift_[i] - image[i]) / scale * row[j];
      }
    }
    last_residual_ = residual;
    last_shift_ = plain;
    if (at_work_) last_shift_ = inverse_ * residual;
    return last_shift_;
  }

 private:
  Matrix<double, n> inverse_;
  Vector<double, n> last_residual_, last_shift_;
  bool at_work_ = false;
};

/// The derivative J of what the equations ask for, w(u), by the unknown u: learnt from pairs of evaluations
/// by Broyden's update, and a good guess for the next step of the same size. It gives the shift of u for
/// \f$w(u) = u - u_0\f$ as well as the change of w that goes with it.
/// @tparam m size of w, whose first n entries ask for u - u_0
template <int n, int m>
class SecantModel {
 public:
  /// Learns from a shift of u that changed w by `change`, unless J is to stay as it is.
  /// @return the error that J had along that shift, relative to its size
  double learn(const Vector<double, n>& shift, const Vector<double, m>& change, bool update) {
    const Vector<double, m> miss = change - slope_ * shift;
    const double square = shift.squaredNorm();
    for (int i = 0; update && i < m; ++i)
      for (int j = 0; j < n; ++j)
        slope_(i, j) += miss[i] / square * shift[j];
    return miss.norm() / shift.norm();
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

}  // namespace avi
