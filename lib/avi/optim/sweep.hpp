#pragma once
#include "avi/core/dot.hpp"

#include <array>
#include <cstring>

/// @file
/// One pass over several long vectors that changes some of them and sums over others on the way.

namespace avi {

namespace detail {

/// Eight neighbouring numbers, in whatever registers the machine has.
typedef double Eight __attribute__((vector_size(64)));
/// The same anywhere in an array of numbers.
typedef double EightInMemory __attribute__((vector_size(64), aligned(8), may_alias));
typedef long long EightIntegers
    __attribute__((vector_size(64)));  ///< Indices of eight lanes, for comparisons.

/// Eight entries at index i of every vector of a pass.
struct EightEntries {
  Eigen::Index i;  ///< Index of the first of them.
  /// Entries i to i + 7 of a, where they are: a vector that a function returned would be a matter of the
  /// machine's calling convention, about which g++ has a warning.
  [[nodiscard]] const EightInMemory& operator()(const double* a) const {
    return *reinterpret_cast<const EightInMemory*>(a + i);
  }
  /// Stores them.
  void set(double* a, const EightInMemory& v) const { std::memcpy(a + i, &v, sizeof v); }
};

/// The same for one entry: the end of a vector whose size is no multiple of eight.
struct OneEntry {
  Eigen::Index i;                                            ///< Its index.
  double operator()(const double* a) const { return a[i]; }  ///< Entry i of a.
  void set(double* a, double v) const { a[i] = v; }          ///< Stores it.
};

}  // namespace detail

/// For every i: body(at, sum), where at(a) is entry i of the array a, at.set(a, v) stores one, and sum[k] is
/// to be increased by a term of the k-th sum. Returns the sums.
///
/// `body` is generic: it is called for eight entries at a time, and one by one at the end. The order of
/// addition is that of avi::dot() (core/dot.hpp): eight partial sums, added as a tree, so that sums are the
/// same to the last bit on every machine. A pass that did the same one operation at a time would read long
/// vectors from memory several times.
template <int sums, class Body>
[[gnu::always_inline]] inline std::array<double, sums> sweep(Eigen::Index n, Body body) {
  constexpr Eigen::Index lanes = 8;
  std::array<detail::Eight, sums> packs{};
  Eigen::Index i = 0;
  for (; i + lanes <= n; i += lanes)
    body(detail::EightEntries{i}, packs);
  for (Eigen::Index lane = 0; i < n; ++i, ++lane) {
    std::array<double, sums> one{};
    body(detail::OneEntry{i}, one);
    // the lane is chosen by a comparison: written to one by its index, the sums would pass through memory
    const detail::EightIntegers here = detail::EightIntegers{0, 1, 2, 3, 4, 5, 6, 7} == lane;
    for (int k = 0; k < sums; ++k)
      packs[k] += here ? detail::Eight{} + one[k] : detail::Eight{};
  }
  std::array<double, sums> total;
  for (int k = 0; k < sums; ++k) {
    const detail::Eight& p = packs[k];
    total[k] = ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
  }
  return total;
}

}  // namespace avi
