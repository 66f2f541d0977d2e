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

}  // namespace avi
