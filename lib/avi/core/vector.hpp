#pragma once
#include "avi/core/require.hpp"

#include <Eigen/Core>

#include <cmath>
#include <string_view>
#include <type_traits>

/// @file
/// Vectors and matrices of any scalar: the only linear-algebra names the rest of the library uses.

namespace avi {

/// Dimension known only at run time.
inline constexpr int dynamic = Eigen::Dynamic;

namespace detail {
// A scalar that is a SIMD register brings its own alignment, wider than the one Eigen would ask for; without
// vector units to match, the two would contradict each other.
template <class S>
inline constexpr int storage = std::is_arithmetic_v<S> ? Eigen::ColMajor : Eigen::ColMajor | Eigen::DontAlign;

}  // namespace detail

/// Column vector of n entries of scalar S (n may be avi::dynamic).
template <class S, int n>
using Vector = Eigen::Matrix<S, n, 1, detail::storage<S>>;

namespace detail {
/// A vector that refuses indices beyond its size whatever the compiler's options: functions of the user are
/// called with it where that happens once.
template <class S, int n>
class Checked : public Vector<S, n> {
  using Base = Vector<S, n>;

 public:
  using Base::Base;
  using Base::operator=;
  Checked(const Base& entries) : Base(entries) {}  // NOLINT: implicit, as a copy is

  ///@{

  /// An entry. @throws std::invalid_argument where there is none.
  S& operator[](Eigen::Index i) { return checked(i), Base::operator[](i); }
  const S& operator[](Eigen::Index i) const { return checked(i), Base::operator[](i); }
  S& operator()(Eigen::Index i) { return checked(i), Base::operator()(i); }
  const S& operator()(Eigen::Index i) const { return checked(i), Base::operator()(i); }
  ///@}

  ///@{

  /// Several entries. @throws std::invalid_argument where there are not so many.
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

/// The vector v, which a function of the user gave for q or p.
/// @throws std::invalid_argument unless it has `size` entries.
template <class V>
const V& sized(std::string_view what, const V& v, Eigen::Index size) {
  if constexpr (V::SizeAtCompileTime == dynamic)
    require(v.size() == size, what, v.size(), "that of q and of p, ", size);
  return v;
}

/// |v|^2 at any scalar.
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

/// Largest magnitude of an entry; NaN where one is.
template <class V>
double largest_entry(const V& x) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    most = std::abs(x[i]) <= most || most != most ? most : std::abs(x[i]);
  return most;
}

}  // namespace avi
