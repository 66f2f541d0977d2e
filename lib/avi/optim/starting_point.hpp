#pragma once
#include "avi/core/require.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <concepts>
#include <initializer_list>
#include <span>
#include <type_traits>

/// @file
/// StartingPoint: the argument x0 of a minimisation.

namespace avi {

/// A starting point given as an Eigen vector or vector expression, as numbers in braces, or as a contiguous
/// array of double (std::vector, std::array). A VectorX is stored by reference, anything else is copied.
/// Other number types and matrices are refused.
class StartingPoint {
 public:
  StartingPoint(const VectorX& x) : x_(&x) {}                                     ///< Refers to x.
  StartingPoint(std::initializer_list<double> x) { copy({x.begin(), x.end()}); }  ///< The numbers in braces.
  /// The numbers of any other type. @throws std::invalid_argument for a matrix that does not have exactly one
  /// column.
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
  StartingPoint(const StartingPoint&) = delete;  // it may refer to a temporary
  StartingPoint& operator=(const StartingPoint&) = delete;

  [[nodiscard]] const VectorX& vector() const { return *x_; }  ///< The point as a vector.

 private:
  VectorX own_;
  const VectorX* x_ = &own_;

  void copy(std::span<const double> x) {
    own_.resize(static_cast<Eigen::Index>(x.size()));
    std::copy(x.begin(), x.end(), own_.data());
  }
};

}  // namespace avi
