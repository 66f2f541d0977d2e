#pragma once
#include "avi/autodiff/pack.hpp"
#include "avi/core/state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// The unknowns of a collocation step, and states with more digits than their numbers hold.

namespace avi {

/// A state and the rounding error that is to be added to it.
template <int n>
struct PreciseState {
  State<n> state;  ///< As a caller sees it.
  State<n> low;    ///< The digits that rounding cut off.

  /// Zero.
  explicit PreciseState(Eigen::Index size)
      : state{.q = Vector<double, n>::Zero(size), .p = Vector<double, n>::Zero(size)}, low(state) {}
};

/// One over the size of every entry of q and p in a step, so that changes are measured in its own scale.
template <int n>
struct EntryScales {
  Vector<double, n> q;  ///< Factors of positions.
  Vector<double, n> p;  ///< Factors of momenta.

  /// Zero: no change counts.
  explicit EntryScales(Eigen::Index size)
      : q(Vector<double, n>::Zero(size)), p(Vector<double, n>::Zero(size)) {}

  /// The size of an entry is twice that of its start and of all its increments; half of it takes four sweeps
  /// in a hundred more, and long runs are not better. What is at rest at zero has the size of the largest
  /// entry of its kind: nothing is known of it yet. @return every entry has one of its own
  template <class Increments>
  bool set(const State<n>& start, const Increments& dq, const Increments& dp) {
    const bool of_q = set(q, start.q, dq), of_p = set(p, start.p, dp);
    return of_q && of_p;
  }
  /// The smallest of these numbers that is not 0: one over the largest size.
  [[nodiscard]] static double of_largest(const Vector<double, n>& each) {
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < each.size(); ++i)
      if (each[i] > 0.0 && each[i] < least) least = each[i];
    return std::isinf(least) ? 0.0 : least;
  }

 private:
  template <class Increments>
  static bool set(Vector<double, n>& each, const Vector<double, n>& start, const Increments& dx) {
    bool all = true;
    for (Eigen::Index i = 0; i < each.size(); ++i) {
      const double size = std::abs(start[i]) + sum(abs(dx[i]));
      // Also NaN; one over a smaller number might overflow in a product.
      const bool moves = size > 1e-290;
      each[i] = moves ? 0.5 / size : 0.0;
      all = all && moves;
    }
    if (!all) fill(each);
    return all;
  }
  [[gnu::noinline]] static void fill(Vector<double, n>& each) {
    const double largest = of_largest(each);
    for (Eigen::Index i = 0; i < each.size(); ++i)
      if (!(each[i] > 0.0)) each[i] = largest;
  }
};

/// The unknowns of a step, one number for each stage.
template <int n, int w>
struct StageValues {
  using Vec = Vector<Pack<w>, n>;  ///< One vector for each stage.
  alignas(64) Vec q;               ///< Positions.
  alignas(64) Vec p;               ///< Momenta.
  alignas(64) Vec dq;              ///< \f$h b_j \dot q_j\f$.
  alignas(64) Vec dp;              ///< \f$h b_j \dot p_j\f$.
  Pack<w> rate{1.0};               ///< The monitor, where StageField keeps it.
  PreciseState<n> start;           ///< Where the step begins.
  EntryScales<n> per;              ///< Factors of its changes, entry by entry.

  /// Zero, for n = `size`.
  explicit StageValues(Eigen::Index size) : q(size), p(size), dq(size), dp(size), start(size), per(size) {
    for (Vec* each : {&q, &p, &dq, &dp})
      std::fill(each->data(), each->data() + size, Pack<w>(0.0));
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
