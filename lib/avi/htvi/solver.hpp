#pragma once
#include "avi/core/vector.hpp"

#include <utility>

/// @file
/// How the implicit equation of a generating map is solved.

namespace avi {

/// Which generating function a step comes from.
enum class Generating {
  type2,  ///< H_d^+(q_0, p_1), the discrete right Hamiltonian
  type3   ///< H_d^-(q_1, p_0), the discrete left Hamiltonian
};

/// How far the implicit equation of a step is solved.
struct SolverSettings {
  double tolerance = 8.0;   ///< Residual accepted, in units of machine epsilon times the size of the unknown.
  int max_iterations = 50;  ///< Expansions in one step before it ends as Outcome::not_converged.
  bool quasi_newton = true;  ///< Where the iteration contracts slowly, let Broyden's method take over.
};

/// What a step adds to the state.
template <int n>
struct StepChange {
  Vector<double, n> q;  ///< q_1 - q_0.
  Vector<double, n> p;  ///< p_1 - p_0.
  double t;             ///< t_1 - t_0.
};

/// First guess of an unknown that changes smoothly from step to step: the line through its values at the last
/// two steps, where they had the same size.
template <int n>
class Predictor {
 public:
  explicit Predictor(Eigen::Index size) : last_(size), last_but_one_(size) {}  ///< For `size` entries.

  /// value = the guess for a step h: zero unless the last two steps were of this size.
  void guess(double h, Vector<double, n>& value) const {
    if (h == last_h_ && h == last_but_one_h_)
      value = 2.0 * last_ - last_but_one_;
    else
      value.setZero();
  }
  /// Takes in what the step h has found.
  void remember(const Vector<double, n>& value, double h) {
    last_but_one_.swap(last_);
    last_ = value;
    last_but_one_h_ = std::exchange(last_h_, h);
  }

 private:
  Vector<double, n> last_, last_but_one_;
  double last_h_ = 0.0, last_but_one_h_ = 0.0;
};

/// Broyden's quasi-Newton method for F(u) = 0 where the plain iteration u += F(u) contracts slowly, or not at
/// all: at large h and for stiff problems. It takes over at the first residual that has not fallen to a
/// tenth of the one before, and starts from the identity, which the plain iteration stands for.
template <int n>
class Broyden {
 public:
  /// Forgets the last equation.
  void restart() { at_work_ = false; }
  /// The shift of u that a residual asks for. @param plain that of the plain iteration
  const Vector<double, n>& shift(const Vector<double, n>& residual, const Vector<double, n>& plain,
                                 bool slow) {
    if (slow && !at_work_) {
      inverse_ = Matrix<double, n>::Identity(residual.size(), residual.size());
      at_work_ = true;
    }
    if (at_work_) {
      // The inverse that maps the last fall of the residual to the last shift.
      const Vector<double, n> image = inverse_ * (last_residual_ - residual);
      const double scale = last_shift_.dot(image);
      if (scale != 0.0)
        inverse_ += ((last_shift_ - image) / scale) * (last_shift_.transpose() * inverse_).eval();
    }
    last_residual_ = residual;
    if (at_work_)
      last_shift_ = inverse_ * residual;
    else
      last_shift_ = plain;
    return last_shift_;
  }

 private:
  Matrix<double, n> inverse_;
  Vector<double, n> last_residual_, last_shift_;
  bool at_work_ = false;
};

/// Vectors of one iteration, allocated once where n is known at run time only.
template <int n>
struct IterationRoom {
  /// Vectors of `size` entries.
  explicit IterationRoom(Eigen::Index size)
      : unknown(size), correction(size), residual(size), plain(size), wanted(size) {}
  Vector<double, n> unknown;     ///< u, where the expansion begins.
  Vector<double, n> correction;  ///< u - u_0.
  Vector<double, n> residual;    ///< wanted - correction.
  Vector<double, n> plain;       ///< Shift of u by the plain iteration.
  Vector<double, n> wanted;      ///< u - u_0 that the discrete equations ask for.
};

}  // namespace avi
