#pragma once
#include "avi/autodiff/scalar.hpp"
#include "avi/core/instructions.hpp"

#include <algorithm>
#include <bit>

/// @file
/// A number with its first-order partial derivatives, held in vector registers.

namespace avi {
/// @cond
inline namespace AVI_INSTRUCTIONS {
/// @endcond

/// The value (lane 0) and the N first partials (lanes 1 to N) of a function of N variables; every operation
/// applies the chain rule (forward-mode automatic differentiation; Griewank and Walther 2008, chapter 3). It
/// does the same as Partials<double, N> but is held in vector registers: with Partials instead, HTVI takes a
/// fifth more instructions and 1.4 times the time (Kepler's problem, orders 4 and 16, with AVX-512).
template <int N>
class DualNumber : ChainRule<DualNumber<N>> {
 public:
  /// Numbers in a register.
  static constexpr int lanes =
      std::min(static_cast<int>(std::bit_ceil(static_cast<unsigned>(N) + 1u)), detail::machine_lanes);
  /// Registers that hold the N + 1 numbers; the last is padded.
  static constexpr int parts = (N + lanes) / lanes;
  using Register = typename detail::Simd<lanes>::type;  ///< A vector register of `lanes` numbers.

  Register part[parts];  ///< Value, partials, padding.

  DualNumber() = default;
  // Written out so that a copy is register moves: the compiler may copy a struct in pieces, and reloading
  // them as one register stalls the processor.
  DualNumber(const DualNumber& other) { *this = other; }  ///< Register by register.
  /// Register by register.
  DualNumber& operator=(const DualNumber& other) {
#pragma GCC unroll 16
    for (int k = 0; k < parts; ++k)
      part[k] = other.part[k];
    return *this;
  }
  /// A constant: all partials are zero.
  DualNumber(double value) : part{} { part[0][0] = value; }  // NOLINT: implicit, as formulas are written
  /// The number whose register k is f(k), for every k.
  template <class F>
  [[nodiscard]] static DualNumber by_part(F f) {
    DualNumber y;
#pragma GCC unroll 16
    for (int k = 0; k < parts; ++k)
      y.part[k] = f(k);
    return y;
  }

  /// Variable number i (0-based) of the N, with this value and slope 1.
  static DualNumber variable(double value, int i) {
    DualNumber x(value);
    x.part[(i + 1) / lanes][(i + 1) % lanes] = 1.0;
    return x;
  }

  [[nodiscard]] double value() const { return part[0][0]; }  ///< The number itself.
  [[nodiscard]] double partial(int i) const {
    return part[(i + 1) / lanes][(i + 1) % lanes];
  }  ///< Derivative by variable i (0-based).

  /// The same partials with another value.
  [[nodiscard]] DualNumber with_value(double value) const {
    DualNumber y(*this);
    y.part[0][0] = value;
    return y;
  }
  /// f with the derivatives slope() times those of this number.
  template <class Slope>
  [[nodiscard]] DualNumber chain(double f, Slope slope) const {
    return (slope() * *this).with_value(f);
  }
  friend double value_of(const DualNumber& x) { return x.value(); }  ///< The number itself.

  ///@{

  /// Arithmetic by the rules for sums, products and quotients.
  friend DualNumber operator-(const DualNumber& a) {
    return by_part([&](int k) { return -a.part[k]; });
  }
  friend DualNumber operator+(const DualNumber& a, const DualNumber& b) {
    return by_part([&](int k) -> Register { return a.part[k] + b.part[k]; });
  }
  friend DualNumber operator-(const DualNumber& a, const DualNumber& b) {
    return by_part([&](int k) -> Register { return a.part[k] - b.part[k]; });
  }
  friend DualNumber operator*(double a, const DualNumber& b) {
    return by_part([&](int k) -> Register { return a * b.part[k]; });
  }
  friend DualNumber operator*(const DualNumber& a, double b) { return b * a; }
  friend DualNumber operator/(const DualNumber& a, double b) {
    return by_part([&](int k) -> Register { return a.part[k] / b; });
  }
  friend DualNumber operator*(const DualNumber& a, const DualNumber& b) {
    return (a.value() * b + b.value() * a).with_value(a.value() * b.value());
  }
  friend DualNumber operator/(const DualNumber& a, const DualNumber& b) { return a * (1.0 / b); }
  friend DualNumber operator/(double a, const DualNumber& b) {
    const double inverse = 1.0 / b.value();
    return b.chain(a * inverse, [&] { return -a * inverse * inverse; });
  }
  ///@}
};

/// Sum of weighted products a_j b_j, which takes most of the time of a Taylor expansion. The parts a_j db_j
/// and b_j da_j are summed separately and combined once at the end, which saves a product rule per term.
template <class T>
class ProductSum {
 public:
  /// Adds weight * a * b.
  [[gnu::always_inline]] void add(const T& a, const T& b, double weight = 1.0) {
    left_ += (weight * a.value()) * b;
    right_ += (weight * b.value()) * a;
  }
  /// The sum.
  [[nodiscard]] T result() const {
    return (left_ + right_).with_value(left_.value());  // both halves hold the value itself
  }

 private:
  T left_{0.0}, right_{0.0};
};

/// @cond
}  // namespace AVI_INSTRUCTIONS
/// @endcond
}  // namespace avi
