#pragma once
#include "avi/autodiff/pack.hpp"
#include "avi/core/state.hpp"

/// @file
/// A state with more digits than its numbers hold, and how increments are added to it.

namespace avi {

/// A state and the rounding error that is to be added to it.
template <int n>
struct PreciseState {
  State<n> state;  ///< As a caller sees it.
  State<n> low;    ///< What rounding cut off.

  /// Zero.
  explicit PreciseState(Eigen::Index size) : state(zero(size)), low(zero(size)) {}

 private:
  static State<n> zero(Eigen::Index size) {
    return {.q = Vector<double, n>::Zero(size), .p = Vector<double, n>::Zero(size)};
  }
};

/// sum += term, whichever is larger; what rounding cuts off is added to `rest` (Knuth 1969).
template <class T>
[[gnu::always_inline]] inline void add_with_rest(T& sum, T& rest, const T& term) {
  const T next = sum + term, added = next - sum;
  rest += (sum - (next - added)) + (term - added);
  sum = next;
}

/// Adds all numbers of a pack, and of another one what rounding had cut off them, to sum + low, in about
/// twice the digits of a double. Increments of a long step are as large as the state, and then add() of a
/// number and its rounding error would lose the error: the energy of a long run moves half as much as with
/// it.
template <int w>
[[gnu::always_inline]] inline void add_all(double& sum, double& low, const Pack<w>& terms,
                                           const Pack<w>& rests = Pack<w>(0.0)) {
  if constexpr (w > 2) {
    Pack<w / 2> half = terms.half(0), rest = rests.half(0) + rests.half(1);
    add_with_rest(half, rest, terms.half(1));
    add_all(sum, low, half, rest);
  } else {
    double half = terms[0], rest = rests[0] + rests[1];
    add_with_rest(half, rest, terms[1]);
    rest += low;
    add_with_rest(sum, rest, half);
    const double next = sum + rest;
    low = rest - (next - sum);
    sum = next;
  }
}

}  // namespace avi
