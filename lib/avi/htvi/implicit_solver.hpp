#pragma once
#include "avi/core/vector.hpp"

#include <utility>

/// @file
/// How the implicit equation of an HTVI is solved.

namespace avi {

/// How far the implicit equation of a step is solved.
struct SolverSettings {
  double tolerance = 8.0;   ///< Residual accepted, in units of machine epsilon times the size of the unknown.
  int max_iterations = 50;  ///< Expansions in one step before it ends as Outcome::not_converged.
  bool quasi_newton = true;  ///< Switch to Broyden's method where the iteration contracts slowly.
};

/// First guess of an unknown that changes smoothly from step to step: the line through its values at the last
/// two steps.
template <int n>
class Predictor {
 public:
  /// The guess for a step h from `start`: zero unless the last two steps had this size and led to this point.
  [[nodiscard]] Vector<double, n> guess(double h, const Vector<double, n>& start) const {
    if (h == last_h_ && h == last_but_one_h_ && start == end_) return 2.0 * last_ - last_but_one_;
    return Vector<double, n>::Zero();
  }
  /// Stores the value that a step h found, and the point where the step ended.
  void remember(const Vector<double, n>& value, double h, const Vector<double, n>& end) {
    last_but_one_ = std::exchange(last_, value);
    last_but_one_h_ = std::exchange(last_h_, h);
    end_ = end;
  }

 private:
  Vector<double, n> last_, last_but_one_, end_;
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
      inverse_ = Matrix<double, n>::Identity();
      at_work_ = true;
    }
    if (at_work_) {
      // The update makes the inverse map the last decrease of the residual to the last shift.
      const Vector<double, n> image = inverse_ * (last_residual_ - residual);
      const double scale = last_shift_.dot(image);
      if (scale != 0.0)
        inverse_ += ((last_shift_ - image) / scale) * (last_shift_.transpose() * inverse_).eval();
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

}  // namespace avi
