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
  double tolerance = 8.0;  ///< Residual accepted, in units of machine epsilon times the size of the unknown.
  int max_iterations = 50;
};

/// What a step adds to the state.
template <int n>
struct StepChange {
  Vector<double, n> q, p;
  double t;
};

/// First guess of an unknown that changes smoothly from step to step: the line through its values at the last
/// two steps, where they had the same size.
template <int n>
class Predictor {
 public:
  explicit Predictor(Eigen::Index size) : size_(size) {}

  [[nodiscard]] Vector<double, n> guess(double h) const {
    if (h == last_h_ && h == last_but_one_h_) return 2.0 * last_ - last_but_one_;
    return Vector<double, n>::Zero(size_);
  }
  void remember(const Vector<double, n>& value, double h) {
    last_but_one_ = std::exchange(last_, value);
    last_but_one_h_ = std::exchange(last_h_, h);
  }

 private:
  Vector<double, n> last_, last_but_one_;
  double last_h_ = 0.0, last_but_one_h_ = 0.0;
  Eigen::Index size_;
};

}  // namespace avi
