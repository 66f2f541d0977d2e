#pragma once
#include "avi/core/compiler.hpp"

/// @file
/// How increments are added to a state over many steps.

namespace avi {

/// How increments are added to the state.
enum class Summation {
  plain,       ///< Ordinary addition.
  compensated  ///< The rounding error is kept and included in the next addition (Kahan 1965; Moller 1965).
};

/// sum += increment. @param low the rounding error kept so far; unused with Summation::plain
template <Summation summation = Summation::compensated, class Value, class Low, class Increment>
void add(Value& sum, [[maybe_unused]] Low& low, const Increment& increment) {
  if constexpr (summation == Summation::compensated) {
    const Value corrected = increment + low;
    const Value next = sum + corrected;
    low = corrected - (next - sum);
    sum = next;
  } else {
    sum += increment;
  }
}

/// Adds step times to a clock and keeps the rounding error for the next step, so that the clock of a long run
/// is right to its last digits, like a compensated state. If the time was changed from outside, the kept
/// error is dropped.
class ClockSum {
 public:
  /// t += increment.
  void add(double& t, double increment) {
    if (t != at_) low_ = 0.0;
    avi::add(t, low_, increment);
    at_ = t;
  }

 private:
  double at_ = 0.0, low_ = 0.0;  // time after the last step, and its kept rounding error
};

}  // namespace avi
