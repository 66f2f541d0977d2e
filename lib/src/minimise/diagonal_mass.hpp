#pragma once
#include "avi/core/vector.hpp"
#include "avi/optim/sweep.hpp"

#include <cmath>

/// @file
/// A mass for every entry of x, learned from displacements and changes of the gradient.

namespace avi {

/// The diagonal of the BFGS formula for the Hessian itself: a pair s, y changes the masses M to
/// \f[ M_i^+ = c M_i \Big(1 - \frac{M_i s_i^2}{s \cdot M s}\Big) + \frac{y_i^2}{s\cdot y}, \qquad
/// c = \frac{y \cdot M^{-1} y}{s\cdot y} \f] (Gilbert and Lemarechal 1989). Wherever y = C s with C diagonal,
/// M comes near to a multiple of C.
///
/// The diagonal is used if it predicted the last pairs better than the identity: the quality of a prediction
/// is \f$(s \cdot y)^2 / (s\cdot M s \; y\cdot M^{-1} y)\f$, 1 where y is parallel to M s and smaller
/// elsewhere, and its geometric mean over the pairs has to be more than \f$\sqrt e\f$ times that of M = I.
class DiagonalMass {
 public:
  explicit DiagonalMass(Eigen::Index n) : inverse_(n) {}  ///< Makes masses for vectors of n entries.

  void forget() { known_ = false; }                                        ///< Forgets all pairs.
  [[nodiscard]] const double* inverse() const { return inverse_.data(); }  ///< 1 / M_i, between lessons.

  /// Learns `count` pairs: pair(k) is the k-th, the oldest first, with members s, y and rho = 1 / s.y; those
  /// with rho = 0 are left out. Returns true if M predicted them clearly better than I.
  template <class Pairs>
  bool learn(int count, Pairs pair) {
    double gain = 0.0;
    int learned = 0;
    if (known_) invert();
    for (int k = 0; k < count; ++k) {
      const auto& [s, y, rho] = pair(k);
      if (rho == 0.0) continue;
      if (!known_) inverse_.setConstant(rho * dot(y, y));
      known_ = true;
      const auto [sms, ywy, ss, yy] =
          sweep<4>(inverse_.size(), [m = inverse_.data(), s = s.data(), y = y.data()](auto at, auto& sum) {
            const auto si = at(s), yi = at(y), mass = at(m);
            sum[0] += mass * (si * si);
            sum[1] += yi * yi / mass;
            sum[2] += si * si;
            sum[3] += yi * yi;
          });
      gain += std::log(sms / ss * (ywy / yy));
      ++learned;
      // rounding must not make the mass negative where only one entry moved
      sweep<0>(inverse_.size(), [m = inverse_.data(), s = s.data(), y = y.data(), c = rho * ywy,
                                 share = 1.0 / sms, rho = rho](auto at, auto&) {
        const auto si = at(s), yi = at(y), mass = at(m);
        at.set(m, c * mass * ((1.0 + 1e-12) - share * (mass * (si * si))) + rho * (yi * yi));
      });
    }
    if (known_) invert();
    return gain < -0.5 * learned;
  }

 private:
  VectorX inverse_;  ///< 1 / M; M itself during a lesson.
  bool known_ = false;

  void invert() {
    sweep<0>(inverse_.size(), [m = inverse_.data()](auto at, auto&) { at.set(m, 1.0 / at(m)); });
  }
};

}  // namespace avi
