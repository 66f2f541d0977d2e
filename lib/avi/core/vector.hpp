#pragma once
#include "avi/core/require.hpp"

#include <Eigen/Core>

#include <cmath>
#include <string_view>
#include <type_traits>

/// @file
/// Vectors and matrices of any scalar; the rest of the library uses no other names of linear algebra.

namespace avi {

/// Marks a dimension that is known only at run time.
inline constexpr int dynamic = Eigen::Dynamic;

namespace detail {
// A scalar made of SIMD registers has its own alignment, wider than what Eigen requests. Without matching
// vector units, the two would contradict each other.
template <class S>
inline constexpr int storage = std::is_arithmetic_v<S> ? Eigen::ColMajor : Eigen::ColMajor | Eigen::DontAlign;

}  // namespace detail

/// Column vector of n entries of scalar S (n may be avi::dynamic).
template <class S, int n>
using Vector = Eigen::Matrix<S, n, 1, detail::storage<S>>;

namespace detail {
/// A vector that checks its indices whatever the compiler options. User functions are called with it where
/// they are called only once.
template <class S, int n>
class Checked : public Vector<S, n> {
  using Base = Vector<S, n>;

 public:
  using Base::Base;
  using Base::operator=;
  Checked(const Base& entries) : Base(entries) {}  // NOLINT: implicit, like a copy

  ///@{

  /// Entry i. @throws std::invalid_argument for an index out of range.
  S& operator[](Eigen::Index i) { return checked(i), Base::operator[](i); }
  const S& operator[](Eigen::Index i) const { return checked(i), Base::operator[](i); }
  S& operator()(Eigen::Index i) { return checked(i), Base::operator()(i); }
  const S& operator()(Eigen::Index i) const { return checked(i), Base::operator()(i); }
  ///@}

  ///@{

  /// A block of entries. @throws std::invalid_argument for a block that exceeds the vector.
  auto head(Eigen::Index size) const { return checked(0, size), Base::head(size); }
  auto tail(Eigen::Index size) const { return checked(0, size), Base::tail(size); }
  auto segment(Eigen::Index first, Eigen::Index size) const {
    return checked(first, size), Base::segment(first, size);
  }
  template <int count>
  auto head() const {
    return checked(0, count), Base::template head<count>();
  }
  template <int count>
  auto tail() const {
    return checked(0, count), Base::template tail<count>();
  }
  template <int count>
  auto segment(Eigen::Index first) const {
    return checked(first, count), Base::template segment<count>(first);
  }
  ///@}

 private:
  void checked(Eigen::Index i) const {
    require(i >= 0 && i < this->size(), "Index of an entry", i, "at least 0 and below ", this->size(),
            ", the size of the vector");
  }
  void checked(Eigen::Index first, Eigen::Index count) const {
    require(first >= 0 && first <= this->size(), "First of some entries", first, "at least 0 and at most ",
            this->size(), ", the size of the vector");
    require(count >= 0 && count <= this->size() - first, "Number of entries", count,
            "at least 0 and at most ", this->size() - first, ", for the vector has not more");
  }
};

/// Returns the vector v that a user function gave for q or p.
/// @throws std::invalid_argument unless it has `size` entries.
template <class V>
const V& sized(std::string_view what, const V& v, Eigen::Index size) {
  if constexpr (V::SizeAtCompileTime == dynamic)
    require(v.size() == size, what, v.size(), "that of q and of p, ", size);
  return v;
}

/// |v|^2 for any scalar.
template <class V>
auto squared_norm(const V& v) {
  auto sum = v[0] * v[0];
  for (Eigen::Index i = 1; i < v.size(); ++i)
    sum += v[i] * v[i];
  return sum;
}
}  // namespace detail

/// Vector of numbers whose size is known only at run time.
using VectorX = Vector<double, dynamic>;

/// Matrix of m x n entries of scalar S.
template <class S, int m, int n = m>
using Matrix = Eigen::Matrix<S, m, n, detail::storage<S>>;

/// Largest absolute value of an entry; NaN where an entry is NaN.
template <class V>
double largest_entry(const V& x) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    most = std::abs(x[i]) <= most || most != most ? most : std::abs(x[i]);
  return most;
}

}  // namespace avi
