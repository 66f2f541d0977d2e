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
inline void add_with_rest(double& sum, double& rest, double term) {
  const double next = sum + term, added = next - sum;
  rest += (sum - (next - added)) + (term - added);
  sum = next;
}

/// Adds all numbers of a pack to sum + low, in about twice the digits of a double. Increments of a long step
/// are as large as the state, and then add() of a number and its rounding error would lose the error: the
/// energy of a long run moves half as much as with it.
template <int w>
void add_all(double& sum, double& low, const Pack<w>& terms) {
  double half[w], rest[w] = {};
  for (int i = 0; i < w; ++i)
    half[i] = terms[i];
  for (int step = w / 2; step > 0; step /= 2)
    for (int i = 0; i < step; ++i) {
      rest[i] += rest[i + step];
      add_with_rest(half[i], rest[i], half[i + step]);
    }
  rest[0] += low;
  add_with_rest(sum, rest[0], half[0]);
  const double next = sum + rest[0];
  low = rest[0] - (next - sum);
  sum = next;
}

}  // namespace avi
