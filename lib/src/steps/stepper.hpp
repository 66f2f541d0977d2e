#pragma once
#include "avi/core/step.hpp"

#include <algorithm>
#include <memory>
#include <utility>

/// @file
/// The interface of the steps of one orbit.

namespace avi::detail {

/// The steps of one orbit, by some method. Numbers are passed by address, and no type of another library is
/// passed, so that a method may be compiled for another processor than its callers.
class Stepper {
 public:
  /// The arguments of a step: see step().
  struct Due {
    double* z;
    double* t;
    double h;
  };

  virtual ~Stepper() = default;
  Stepper& operator=(const Stepper&) = delete;  ///< Steps are not assigned: see clone().

  /// Advances z = (q, p), 2n numbers, and t by the fictive step h; leaves both unchanged unless the step ends
  /// as ok.
  virtual StepReport step(double* z, double& t, double h) = 0;
  /// Returns true if two orbits of the same formulas can be stepped side by side for the price of one.
  [[nodiscard]] virtual bool can_go_beside() const { return false; }
  /// Makes a step of this orbit and one of another, with the same bits as step(). @param other one of the
  /// same kind
  virtual std::pair<StepReport, StepReport> step_beside(const Due& mine, Stepper& other, const Due& its) {
    const StepReport first = step(mine.z, *mine.t, mine.h);
    return {first, other.step(its.z, *its.t, its.h)};
  }
  /// The state at the fraction c of the last step: the collocation polynomial, where there is one.
  virtual void polynomial(double c, double* z, double& t) const = 0;
  /// The same state with the digits that a search needs, if that takes less work.
  virtual void roughly(double c, double* z, double& t) { polynomial(c, z, t); }
  /// The most that the last term of the polynomial of the last step adds to each entry of (q, p); zero if
  /// there is no polynomial.
  virtual void tail(double* z, int entries) const { std::fill_n(z, entries, 0.0); }
  /// A copy with the memory of the last step: it goes on with the same bits.
  [[nodiscard]] virtual std::unique_ptr<Stepper> clone() const = 0;

 protected:
  Stepper() = default;
  Stepper(const Stepper&) = default;
};

}  // namespace avi::detail
