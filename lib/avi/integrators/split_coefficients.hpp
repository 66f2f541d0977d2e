#pragma once
#include "avi/core/require.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <iterator>

/// @file
/// Coefficient lists of methods that alternate two exact flows.

namespace avi {

/// Lengths of flows, as parts of a step: a list of at most 36 numbers that a method carries in itself.
template <class Number>
class Lengths {
 public:
  static constexpr std::size_t most = 36;  ///< The drifts of the longest list, sofroniou_spaletta10.

  /// So many zeros.
  /// @throws std::invalid_argument for more than 36.
  constexpr explicit Lengths(std::size_t count = 0) : size_(count) {
    if (count > most) require(false, "Length of a list of coefficients", count, "at most 36");
  }
  /// The same numbers, rounded.
  template <class Other>
  constexpr explicit Lengths(const Lengths<Other>& other) : Lengths(other.size()) {
    std::transform(other.begin(), other.end(), values_.begin(),
                   [](Other x) { return static_cast<Number>(x); });
  }

  [[nodiscard]] constexpr std::size_t size() const { return size_; }                    ///< How many.
  constexpr Number& operator[](std::size_t i) { return values_[i]; }                    ///< The i-th.
  constexpr const Number& operator[](std::size_t i) const { return values_[i]; }        ///< The i-th.
  [[nodiscard]] constexpr const Number* begin() const { return values_.data(); }        ///< The first.
  [[nodiscard]] constexpr const Number* end() const { return values_.data() + size_; }  ///< Behind the last.
  [[nodiscard]] constexpr const Number& back() const { return values_[size_ - 1]; }     ///< The last.

  /// Whether the list is the same read backwards.
  [[nodiscard]] constexpr bool symmetric() const {
    return std::equal(begin(), end(), std::make_reverse_iterator(end()));
  }

 private:
  std::array<Number, most> values_{};
  std::size_t size_;
};

/// One step \f$A(a_0 h)\, B(b_0 h)\, A(a_1 h) \cdots B(b_{m-1} h)\, A(a_m h)\f$, applied from left to right;
/// A is the drift, B the kick. In extended precision, so that a test can tell a wrong digit from rounding.
struct SplitCoefficients {
  int order = 0;           ///< Of the method.
  Lengths<long double> a;  ///< Of the m + 1 drifts, with sum 1.
  Lengths<long double> b;  ///< Of the m kicks, with sum 1.
};

/// A symmetric composition \f$S(c_1 h)\, S(c_2 h) \cdots S(c_m h)\f$ of a symmetric step S of order 2.
struct CompositionCoefficients {
  int order = 0;           ///< Of the composition.
  Lengths<long double> c;  ///< With sum 1.
};

/// The composition of S(h) = A(h/2) B(h) A(h/2), neighbouring drifts merged.
constexpr SplitCoefficients split(const CompositionCoefficients& composition) {
  const auto& c = composition.c;
  SplitCoefficients merged{composition.order, Lengths<long double>(c.size() + 1), c};
  for (std::size_t i = 0; i < c.size(); ++i) {
    merged.a[i] += 0.5L * c[i];
    merged.a[i + 1] += 0.5L * c[i];
  }
  return merged;
}

/// Fills a palindrome from the entries before its middle one, which makes the sum 1.
constexpr CompositionCoefficients palindrome(int order, std::initializer_list<long double> outer) {
  CompositionCoefficients whole{order, Lengths<long double>(2 * outer.size() + 1)};
  long double rest = 1.0L;
  std::size_t i = 0;
  for (const long double length : outer) {
    whole.c[i] = whole.c[whole.c.size() - 1 - i] = length;
    rest -= 2.0L * length;
    ++i;
  }
  whole.c[i] = rest;
  return whole;
}

/// Fills a symmetric list A B A ... B A of an even number of kicks from its outer entries; the middle drift
/// and the two middle kicks make the sums 1.
constexpr SplitCoefficients palindrome(int order, std::initializer_list<long double> drifts,
                                       std::initializer_list<long double> kicks) {
  const CompositionCoefficients a = palindrome(order, drifts);
  SplitCoefficients whole{order, a.c, Lengths<long double>(2 * drifts.size())};
  long double rest = 0.5L;
  std::size_t i = 0;
  for (const long double length : kicks) {
    whole.b[i] = whole.b[whole.b.size() - 1 - i] = length;
    rest -= length;
    ++i;
  }
  whole.b[i] = whole.b[i + 1] = rest;
  return whole;
}

}  // namespace avi
