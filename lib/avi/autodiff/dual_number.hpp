#pragma once
#include "avi/autodiff/scalar.hpp"
#include "avi/core/instructions.hpp"

#include <bit>

/// @file
/// A number with its first-order partial derivatives, held in one SIMD register where the machine has one.

namespace avi {
/// @cond
inline namespace AVI_INSTRUCTIONS {
/// @endcond

/// Value (lane 0) and N first partials (lanes 1 to N) of a function of N variables; the chain rule is applied
/// by every operation (forward-mode automatic differentiation; Griewank and Walther 2008, chapter 3).
/// It is Partials<double, N> in one register: with that in its place HTVI takes a fifth more instructions and
/// 1.4 times the time (Kepler's problem, orders 4 and 16).
template <int N>
class DualNumber : ChainRule<DualNumber<N>> {
 public:
  /// Numbers in a register: N + 1, rounded up to a power of 2.
  static constexpr int width = static_cast<int>(std::bit_ceil(static_cast<unsigned>(N) + 1u));
  using Register = typename detail::Simd<width>::type;  ///< A vector of that width.

  Register lanes;  ///< Value, partials, padding.

  DualNumber() = default;
  // Written out so that a copy is one register move: the compiler may copy a struct in pieces, and reloading
  // them as one register stalls the processor.
  DualNumber(const DualNumber& other) : lanes(other.lanes) {}  ///< One register move.
  /// One register move.
  DualNumber& operator=(const DualNumber& other) {
    lanes = other.lanes;
    return *this;
  }
  /// A constant: all partials are zero.
  DualNumber(double value) : lanes{} { lanes[0] = value; }  // NOLINT: implicit, as formulas are written
  explicit DualNumber(const Register& r) : lanes(r) {}      ///< From its register.

  /// The variable number i (0-based) of the N, at `value`.
  static DualNumber variable(double value, int i) {
    DualNumber x(value);
    x.lanes[i + 1] = 1.0;
    return x;
  }

  [[nodiscard]] double value() const { return lanes[0]; }             ///< The number itself.
  [[nodiscard]] double partial(int i) const { return lanes[i + 1]; }  ///< By variable i (0-based).

  /// f with the derivative slope() by x.
  template <class Slope>
  [[nodiscard]] DualNumber chain(double f, Slope slope) const {
    DualNumber y(slope() * lanes);
    y.lanes[0] = f;
    return y;
  }
  friend double value_of(const DualNumber& x) { return x.value(); }  ///< The number itself.

  ///@{

  /// By the rules for sums, products and quotients.
  friend DualNumber operator-(const DualNumber& a) { return DualNumber(-a.lanes); }
  friend DualNumber operator+(const DualNumber& a, const DualNumber& b) {
    return DualNumber(a.lanes + b.lanes);
  }
  friend DualNumber operator-(const DualNumber& a, const DualNumber& b) {
    return DualNumber(a.lanes - b.lanes);
  }
  friend DualNumber operator*(double a, const DualNumber& b) { return DualNumber(a * b.lanes); }
  friend DualNumber operator*(const DualNumber& a, double b) { return DualNumber(a.lanes * b); }
  friend DualNumber operator/(const DualNumber& a, double b) { return DualNumber(a.lanes / b); }
  friend DualNumber operator*(const DualNumber& a, const DualNumber& b) {
    DualNumber c(a.lanes[0] * b.lanes + b.lanes[0] * a.lanes);
    c.lanes[0] = a.lanes[0] * b.lanes[0];
    return c;
  }
  friend DualNumber operator/(const DualNumber& a, const DualNumber& b) { return a * (1.0 / b); }
  friend DualNumber operator/(double a, const DualNumber& b) {
    const double inverse = 1.0 / b.lanes[0];
    return b.chain(a * inverse, [&] { return -a * inverse * inverse; });
  }
  ///@}
};

/// Sum of products a_j b_j, most of the time of a Taylor expansion. The halves a_j db_j and b_j da_j are
/// summed apart: one final reduction instead of one product rule for each term.
template <class T>
class ProductSum {
  using Register = typename T::Register;

 public:
  /// Adds weight a b.
  void add(const T& a, const T& b, double weight = 1.0) {
    left_ += (weight * a.lanes[0]) * b.lanes;
    right_ += (weight * b.lanes[0]) * a.lanes;
  }
  /// The sum.
  [[nodiscard]] T result() const {
    T sum(left_ + right_);
    sum.lanes[0] = left_[0];  // both halves hold the value itself
    return sum;
  }

 private:
  Register left_{}, right_{};
};

/// @cond
}  // namespace AVI_INSTRUCTIONS
/// @endcond
}  // namespace avi
