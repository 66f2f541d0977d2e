#pragma once
#include "avi/autodiff/lanes.hpp"

/// @file
/// Convolutions of Taylor coefficients: most of the time of an expansion is spent here.

namespace avi {

/// Sum of products a_j b_j, for the convolutions of Taylor series: one final reduction instead of one product
/// rule per term.
template <class T>
class ProductSum {
 public:
  void add(const T& a, const T& b) { sum_ += a * b; }                          ///< Adds a b.
  void add(double weight, const T& a, const T& b) { sum_ += weight * a * b; }  ///< Adds weight a b.
  [[nodiscard]] T result() const { return sum_; }                              ///< The sum.

 private:
  T sum_{0.0};
};

/// For Lanes, the halves a_j db_j and b_j da_j are summed apart.
template <int N>
class ProductSum<Lanes<N>> {
  using Register = typename Lanes<N>::Register;

 public:
  /// Adds a b.
  void add(const Lanes<N>& a, const Lanes<N>& b) {
    left_ += a.lanes[0] * b.lanes;
    right_ += b.lanes[0] * a.lanes;
  }
  /// Adds weight a b.
  void add(double weight, const Lanes<N>& a, const Lanes<N>& b) {
    left_ += (weight * a.lanes[0]) * b.lanes;
    right_ += (weight * b.lanes[0]) * a.lanes;
  }
  /// The sum.
  [[nodiscard]] Lanes<N> result() const {
    Lanes<N> sum(left_ + right_);
    sum.lanes[0] = left_[0];  // both halves hold the value itself
    return sum;
  }

 private:
  Register left_{}, right_{};
};

namespace detail {

// Inlined where k is known, which -O2 alone would not do: the sums become straight lines, twice as fast.

/// Sum over j = from..to of a_j b_(k-j).
template <class T>
[[gnu::always_inline]] inline T convolution(const T* a, const T* b, int k, int from, int to) {
  ProductSum<T> s;
  for (int j = from; j <= to; ++j)
    s.add(a[j], b[k - j]);
  return s.result();
}
/// Coefficient k of a^2: each pair once, doubled.
template <class T>
[[gnu::always_inline]] inline T convolution_square(const T* a, int k) {
  ProductSum<T> s;
  for (int j = 0; 2 * j < k; ++j)
    s.add(2.0, a[j], a[k - j]);
  if (k % 2 == 0) s.add(a[k / 2], a[k / 2]);
  return s.result();
}
/// Sum over j = 1..k of (slope j + shift) a_j b_(k-j) / k.
template <class T>
[[gnu::always_inline]] inline T convolution_weighted(const T* a, const T* b, int k, double slope,
                                                     double shift) {
  ProductSum<T> s;
  for (int j = 1; j <= k; ++j)
    s.add(slope * j + shift, a[j], b[k - j]);
  return (1.0 / k) * s.result();
}

}  // namespace detail

}  // namespace avi
