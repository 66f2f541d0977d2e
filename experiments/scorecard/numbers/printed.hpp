#pragma once
#include <string>
#include <string_view>

// Numbers as a paper prints them, with the precision that their digits claim.

namespace scorecard {

/// A printed number such as `0.0051`, `1.43E-05`, `2E05` or `>1E10`.
struct Printed {
  double value = 0.0;
  double unit = 1.0;        ///< One unit of the last printed digit.
  int decimals = 0;         ///< Digits behind the point.
  bool bound = false;       ///< Printed with `>`: only a lower bound.
  bool scientific = false;  ///< Printed with an exponent.

  /// @throws std::invalid_argument for a text that is no number.
  explicit Printed(std::string_view text);

  /// True when `ours`, rounded to the last printed digit, is the printed number (or, for a bound, exceeds
  /// it).
  [[nodiscard]] bool equals(double ours) const;

  /// |ours - printed| in units of the last printed digit.
  [[nodiscard]] double units_off(double ours) const;
};

/// `ours` with two digits more than `printed` shows, in the same notation: what a reader compares by eye.
std::string beside(std::string_view printed, double ours);

}  // namespace scorecard
