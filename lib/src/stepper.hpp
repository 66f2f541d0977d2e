#pragma once
#include "avi/core/step.hpp"

#include <algorithm>
#include <memory>
#include <utility>

/// @file
/// The steps of one orbit by any method.

namespace avi::detail {

/// The steps of one orbit. Numbers are passed by address and nothing of another library is, so that what is
/// behind may be compiled for another processor than what is before.
class Stepper {
 public:
  /// A step that is due: see step().
  struct Due {
    double* z;
    double* t;
    double h;
  };

  virtual ~Stepper() = default;
  Stepper& operator=(const Stepper&) = delete;  ///< See clone().

  /// Advances z = (q, p), 2n numbers, and t by the fictive step h; leaves both unchanged unless the step ends
  /// as ok.
  virtual StepReport step(double* z, double& t, double h) = 0;
  /// Two orbits of the same formulas are stepped side by side for the price of one.
  [[nodiscard]] virtual bool can_go_beside() const { return false; }
  /// A step of this orbit and one of another, with the bits of step(). @param other of the same kind
  virtual std::pair<StepReport, StepReport> step_beside(const Due& mine, Stepper& other, const Due& its) {
    const StepReport first = step(mine.z, *mine.t, mine.h);
    return {first, other.step(its.z, *its.t, its.h)};
  }
  /// The state at the fraction c of the last step: the collocation polynomial, where there is one.
  virtual void polynomial(double c, double* z, double& t) const = 0;
  /// The same to the digits that a search needs, where that takes less work.
  virtual void roughly(double c, double* z, double& t) { polynomial(c, z, t); }
  /// How much the last term of the polynomial of the last step adds to each entry of (q, p) at most; zero
  /// where there is none.
  virtual void tail(double* z, int entries) const { std::fill_n(z, entries, 0.0); }
  /// Another one with the memory of the last step: it goes on with the same bits.
  [[nodiscard]] virtual std::unique_ptr<Stepper> clone() const = 0;

 protected:
  Stepper() = default;
  Stepper(const Stepper&) = default;
};

}  // namespace avi::detail
