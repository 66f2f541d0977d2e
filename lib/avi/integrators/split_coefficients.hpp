#pragma once
#include <array>
#include <cstddef>

/// @file
/// Coefficient lists of methods that alternate two exact flows.

namespace avi {

/// One step \f$A(a_0 h)\, B(b_0 h)\, A(a_1 h) \cdots B(b_{m-1} h)\, A(a_m h)\f$, applied from left to right;
/// A is the drift, B the kick, `m` the number of kicks. In extended precision, so that a test can tell a
/// wrong digit from rounding.
template <int m>
struct SplitCoefficients {
  static constexpr int stages = m;                               ///< Kicks in a step.
  int order = 0;                                                 ///< Of the method.
  std::array<long double, static_cast<std::size_t>(m) + 1> a{};  ///< Lengths of the drifts, with sum 1.
  std::array<long double, static_cast<std::size_t>(m)> b{};      ///< Lengths of the kicks, with sum 1.
};

/// A symmetric composition \f$S(c_1 h)\, S(c_2 h) \cdots S(c_m h)\f$ of a symmetric step S of order 2.
template <int m>
struct CompositionCoefficients {
  static constexpr int stages = m;                           ///< Steps of S in one of the composition.
  int order = 0;                                             ///< Of the composition.
  std::array<long double, static_cast<std::size_t>(m)> c{};  ///< Lengths, with sum 1.
};

/// The composition of S(h) = A(h/2) B(h) A(h/2), neighbouring drifts merged.
template <int m>
constexpr SplitCoefficients<m> split(const CompositionCoefficients<m>& composition) {
  SplitCoefficients<m> merged{.order = composition.order};
  for (std::size_t i = 0; i < static_cast<std::size_t>(m); ++i) {
    merged.b[i] = composition.c[i];
    merged.a[i] += 0.5L * composition.c[i];
    merged.a[i + 1] += 0.5L * composition.c[i];
  }
  return merged;
}

/// Fills a palindrome of m entries from its outer ones; the entry in the middle makes the sum 1.
template <int m, std::size_t given>
constexpr CompositionCoefficients<m> palindrome(int order, const std::array<long double, given>& outer) {
  static_assert(m % 2 == 1 && 2 * given + 1 == static_cast<std::size_t>(m),
                "A symmetric composition of m steps is given by its first (m - 1) / 2 coefficients.");
  CompositionCoefficients<m> whole{.order = order};
  long double rest = 1.0L;
  for (std::size_t i = 0; i < given; ++i) {
    whole.c[i] = whole.c[static_cast<std::size_t>(m) - 1 - i] = outer[i];
    rest -= 2.0L * outer[i];
  }
  whole.c[given] = rest;
  return whole;
}

/// Fills a symmetric list A B A ... B A of m (even) kicks from its outer entries; the middle drift and the
/// two middle kicks make the sums 1.
template <int m>
constexpr SplitCoefficients<m> palindrome(int order, const std::array<long double, m / 2>& drifts,
                                          const std::array<long double, m / 2 - 1>& kicks) {
  static_assert(m % 2 == 0, "This list has an even number of kicks.");
  constexpr std::size_t half = m / 2;
  SplitCoefficients<m> whole{.order = order};
  long double drift = 1.0L, kick = 0.5L;
  for (std::size_t i = 0; i < half; ++i) {
    whole.a[i] = whole.a[2 * half - i] = drifts[i];
    drift -= 2.0L * drifts[i];
  }
  for (std::size_t i = 0; i + 1 < half; ++i) {
    whole.b[i] = whole.b[2 * half - 1 - i] = kicks[i];
    kick -= kicks[i];
  }
  whole.a[half] = drift;
  whole.b[half - 1] = whole.b[half] = kick;
  return whole;
}

}  // namespace avi
