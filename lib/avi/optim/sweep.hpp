#pragma once
#include "avi/autodiff/pack.hpp"
#include "avi/core/dot.hpp"
#include "avi/core/instructions.hpp"

#include <array>

/// @file
/// sweep(): one pass over several long vectors, which changes some and sums over others.

namespace avi {

namespace detail {
/// @cond
inline namespace AVI_INSTRUCTIONS {
/// @endcond

/// Access to eight consecutive entries of every vector of a pass.
struct EightEntries {
  Eigen::Index i;  ///< Index of the first of them.
  /// Entries i to i + 7 of a.
  [[nodiscard]] Pack<8> operator()(const double* a) const { return Pack<8>::load(a + i); }
  void set(double* a, const Pack<8>& v) const { v.store(a + i); }  ///< Stores v in entries i to i + 7.
};

/// @cond
}  // namespace AVI_INSTRUCTIONS
/// @endcond

/// Access to a single entry, at the end of vectors whose size is not a multiple of eight.
struct OneEntry {
  Eigen::Index i;                                            ///< Index of the entry.
  double operator()(const double* a) const { return a[i]; }  ///< Entry i of a.
  void set(double* a, double v) const { a[i] = v; }          ///< Stores v in entry i.
};

}  // namespace detail

/// Calls body(at, sum) for all i. In it, at(a) is entry i of the array a, at.set(a, v) sets that entry, and
/// sum[k] is to be increased by the term for the k-th sum. @return the sums
///
/// `body` must be generic: it is called for eight entries at a time, and for single ones at the end. The
/// order of addition is that of avi::dot() (core/dot.hpp), eight partial sums added as a tree, so that sums
/// are the same to the last bit on every machine. Separate operations instead of one pass would read long
/// vectors from memory several times.
template <int sums, class Body>
[[gnu::always_inline]] inline std::array<double, sums> sweep(Eigen::Index n, Body body) {
  constexpr Eigen::Index lanes = 8;
  std::array<Pack<lanes>, sums> packs;
  packs.fill(0.0);
  Eigen::Index i = 0;
  for (; i + lanes <= n; i += lanes)
    body(detail::EightEntries{i}, packs);
  if (i < n) {
    double last[sums + 1][lanes] = {};
    for (Eigen::Index lane = 0; i < n; ++i, ++lane) {
      std::array<double, sums> one{};
      body(detail::OneEntry{i}, one);
      for (int k = 0; k < sums; ++k)
        last[k][lane] = one[k];
    }
    for (int k = 0; k < sums; ++k)
      packs[k] += Pack<lanes>::load(last[k]);
  }
  std::array<double, sums> total;
  for (int k = 0; k < sums; ++k) {
    const Pack<lanes>& p = packs[k];
    total[k] = ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
  }
  return total;
}

}  // namespace avi
