#pragma once
#include "avi/core/compiler.hpp"

/// @file
/// How increments are added to a state over many steps.

namespace avi {

/// How increments are added to the state.
enum class Summation {
  plain,       ///< Ordinary addition.
  compensated  ///< The rounding error is kept and added next time (Kahan 1965; Moller 1965).
};

/// sum += increment. @param low rounding error kept so far; unused by Summation::plain
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

/// Adds the time of steps to a clock, whose rounding error is kept for the next step: the clock of a long run
/// is right to its last digits, as the state may be. A time that was set from outside begins anew.
class ClockSum {
 public:
  /// t += increment.
  void add(double& t, double increment) {
    if (t != at_) low_ = 0.0;
    avi::add(t, low_, increment);
    at_ = t;
  }

 private:
  double at_ = 0.0, low_ = 0.0;  // the time after the last step, and what rounding left of it
};

}  // namespace avi
