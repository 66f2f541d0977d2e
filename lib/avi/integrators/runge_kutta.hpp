#pragma once
#include "avi/core/dot.hpp"

#include <array>
#include <concepts>

/// @file
/// One explicit Runge-Kutta step of any tableau, for an autonomous system z' = F(z).

namespace avi {

/// A tableau of integrators/tableaus.hpp.
template <class T>
concept Tableau = requires {
  { T::stages } -> std::convertible_to<int>;
  { T::order } -> std::convertible_to<int>;
  T::a;
  T::b;
};

/// A tableau with the weights of an embedded solution of another order.
template <class T>
concept EmbeddedTableau = Tableau<T> && requires {
  { T::embedded_order } -> std::convertible_to<int>;
  T::embedded;
};

/// The stages k_1 ... k_s of one step and the point they lead to, in memory made once.
template <Tableau T>
class RungeKuttaStages {
 public:
  /// For systems of `size` equations.
  explicit RungeKuttaStages(Eigen::Index size) : end(size) {
    for (VectorX& stage : k)
      stage.resize(size);
  }

  std::array<VectorX, T::stages> k;  ///< k[0] = F(z) is the caller's to set.
  VectorX end;                       ///< \f$z + h \sum_i b_i k_i\f$.

  /// Takes a step of size h from z, where k[0] = F(z). `field(z, dz)` is called stages - 1 times.
  template <class Field>
  void advance(Field&& field, const VectorX& z, double h) {
    for (int i = 1; i < T::stages; ++i) {
      combine(z, h, T::a[static_cast<std::size_t>(i)], i);
      field(end, k[static_cast<std::size_t>(i)]);
    }
    combine(z, h, T::b, T::stages);
  }

 private:
  void combine(const VectorX& z, double h, const std::array<double, T::stages>& weights, int count) {
    end = z;
    for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j)
      if (weights[j] != 0.0) end += (h * weights[j]) * k[j];
  }
};

}  // namespace avi
