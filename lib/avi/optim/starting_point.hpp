#pragma once
#include "avi/core/require.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <concepts>
#include <initializer_list>
#include <span>
#include <type_traits>

/// @file
/// Where a minimisation begins.

namespace avi {

/// A starting point, as the argument of a call: a vector of Eigen or an expression of such, numbers in
/// braces, or an array of double that lies in one piece (std::vector, std::array). A VectorX is referred to,
/// anything else is copied. Other kinds of numbers are refused, and matrices.
class StartingPoint {
 public:
  StartingPoint(const VectorX& x) : x_(&x) {}                                     ///< Refers to x.
  StartingPoint(std::initializer_list<double> x) { copy({x.begin(), x.end()}); }  ///< The numbers in braces.
  /// From anything else. @throws std::invalid_argument for a matrix of more or less than one column.
  template <class T>
  requires(!std::same_as<T, StartingPoint>) StartingPoint(const T& x) {
    if constexpr (std::is_base_of_v<Eigen::EigenBase<T>, T>) {
      static_assert(std::same_as<typename T::Scalar, double>,
                    "x0 must hold double: the library computes in no other kind of number.");
      constexpr bool vector = T::RowsAtCompileTime == 1 || T::ColsAtCompileTime == 1;
      constexpr bool may_be_one = vector || T::ColsAtCompileTime == dynamic;
      static_assert(may_be_one, "x0 must be a vector of Eigen, numbers in braces, or an array of double.");
      if constexpr (!vector) require(x.cols() == 1, "Number of columns of x0", x.cols(), "1");
      if constexpr (may_be_one) own_ = x;
    } else {
      static_assert(std::convertible_to<const T&, std::span<const double>>,
                    "x0 must be a vector of Eigen, numbers in braces, or an array of double.");
      if constexpr (std::convertible_to<const T&, std::span<const double>>) copy(x);
    }
  }
  StartingPoint(const StartingPoint&) = delete;  // it may refer to what lives for one call
  StartingPoint& operator=(const StartingPoint&) = delete;

  [[nodiscard]] const VectorX& vector() const { return *x_; }  ///< As a vector.

 private:
  VectorX own_;
  const VectorX* x_ = &own_;

  void copy(std::span<const double> x) {
    own_.resize(static_cast<Eigen::Index>(x.size()));
    std::copy(x.begin(), x.end(), own_.data());
  }
};

}  // namespace avi
