#pragma once
#include "avi/autodiff/pack.hpp"

#include <array>
#include <utility>

/// @file
/// A small matrix times the numbers of a pack.

namespace avi {

/// A w x w matrix, stored by columns, each of which is a Pack.
template <int w>
class alignas(64) LaneMatrix {
 public:
  LaneMatrix() { columns_.fill(Pack<w>(0.0)); }                        ///< Zero.
  void set(int i, int j, double value) { columns_[j].set(i, value); }  ///< Entry in row i and column j.

  /// Matrix times vector: the sums over columns are added as a tree, in the same order on every machine.
  [[gnu::always_inline]] Pack<w> operator*(const Pack<w>& x) const { return times(x, Pack<w>(0.0)); }
  /// Matrix times vector plus another vector, which is added first: it is there before the products are.
  [[gnu::always_inline]] Pack<w> times(const Pack<w>& x, const Pack<w>& first) const {
    return times(x, first, std::make_integer_sequence<int, w>{});
  }

 private:
  template <int... j>
  [[gnu::always_inline]] Pack<w> times(const Pack<w>& x, const Pack<w>& first,
                                       std::integer_sequence<int, j...>) const {
    Pack<w> term[] = {columns_[j] * Pack<w>(x[j])...};
    term[0] += first;
    for (int half = w / 2; half > 0; half /= 2)
      for (int i = 0; i < half; ++i)
        term[i] += term[i + half];
    return term[0];
  }
  std::array<Pack<w>, w> columns_;
};

}  // namespace avi
