#pragma once
#include "avi/autodiff/lanes.hpp"

#include <algorithm>
#include <type_traits>

/// @file
/// Convolutions of Taylor coefficients: most of the time of an expansion is spent here.

namespace avi {

/// Sum of products a_j b_j, for the convolutions of Taylor series: one final reduction instead of one product
/// rule per term.
template <class T>
class ProductSum {
 public:
  void add(const T& a, const T& b) { add(a * b); }                          ///< Adds a b.
  void add(double weight, const T& a, const T& b) { add(weight * a * b); }  ///< Adds weight a b.
  [[nodiscard]] T result() const { return sum_; }                           ///< The sum.

 private:
  // Where the loop is unrolled, the first product costs no addition.
  void add(const T& product) {
    sum_ = empty_ ? product : sum_ + product;
    empty_ = false;
  }
  T sum_{0.0};
  bool empty_ = true;
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

/// Convolutions of Taylor coefficients. Where the order is a compile-time constant they unroll into the
/// formula; where it is not (K = -1) they are loops, called rather than inlined, which keeps the code of long
/// formulas short.
template <class T, int K>
struct Convolution {
  /// Sum over j = from..to of a_j b_(k-j).
  static T sum(const T* a, const T* b, int k, int from, int to) {
    if constexpr (K >= 0)
      return inlined(a, b, k, from, to);
    else
      return called(a, b, k, from, to);
  }
  /// Coefficient k of a^2: each pair once, doubled.
  static T square(const T* a, int k) {
    if constexpr (K >= 0)
      return inlined_square(a, k);
    else
      return called_square(a, k);
  }
  /// Sum over j = 1..k of (slope j + shift) a_j b_(k-j) / k.
  static T weighted(const T* a, const T* b, int k, double slope, double shift) {
    if constexpr (K >= 0)
      return inlined_weighted(a, b, k, slope, shift);
    else
      return called_weighted(a, b, k, slope, shift);
  }

 private:
  /// Plain doubles use four partial sums, because each addition would otherwise wait for the one before it.
  /// Lanes have enough independent work.
  static constexpr int sums = K >= 0 && std::is_same_v<T, double> ? 4 : 1;

  /// term(j, s) adds term j of first..last to s.
  template <class Term>
  static T spread(int first, int last, Term term) {
    ProductSum<T> s[sums];
    for (int j = first; j <= last; ++j)
      term(j, s[j % sums]);
    if constexpr (sums == 4)
      return (s[0].result() + s[1].result()) + (s[2].result() + s[3].result());
    else
      return s[0].result();
  }
  static T inlined(const T* a, const T* b, int k, int from, int to) {
    if constexpr (sums == 1) {
      return spread(from, to, [=](int j, auto& s) { s.add(a[j], b[k - j]); });
    } else {
      // Coefficient k has only just been computed: what needs it comes last.
      T sum = spread(std::max(from, 1), std::min(to, k - 1), [=](int j, auto& s) { s.add(a[j], b[k - j]); });
      if (from == 0) sum += a[0] * b[k];
      if (to == k && k > 0) sum += a[k] * b[0];
      return sum;
    }
  }
  static T inlined_square(const T* a, int k) {
    if constexpr (sums == 1) {
      ProductSum<T> s;
      for (int j = 0; 2 * j < k; ++j)
        s.add(2.0, a[j], a[k - j]);
      if (k % 2 == 0) s.add(a[k / 2], a[k / 2]);
      return s.result();
    } else {
      if (k == 0) return a[0] * a[0];
      T sum = spread(1, (k - 1) / 2, [=](int j, auto& s) { s.add(a[j], a[k - j]); });
      sum += sum;
      if (k % 2 == 0) sum += a[k / 2] * a[k / 2];
      return sum + 2.0 * a[0] * a[k];
    }
  }
  static T inlined_weighted(const T* a, const T* b, int k, double slope, double shift) {
    return (1.0 / k) * spread(1, k, [=](int j, auto& s) { s.add(slope * j + shift, a[j], b[k - j]); });
  }
  [[gnu::noinline]] static T called(const T* a, const T* b, int k, int from, int to) {
    return inlined(a, b, k, from, to);
  }
  [[gnu::noinline]] static T called_square(const T* a, int k) { return inlined_square(a, k); }
  [[gnu::noinline]] static T called_weighted(const T* a, const T* b, int k, double slope, double shift) {
    return inlined_weighted(a, b, k, slope, shift);
  }
};

}  // namespace detail

}  // namespace avi
