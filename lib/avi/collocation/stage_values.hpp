#pragma once
#include "avi/autodiff/pack.hpp"
#include "avi/core/state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// The unknowns of a collocation step, and states with more digits than a double holds.

namespace avi {

/// A state together with its rounding error, which is still to be added.
template <int n>
struct PreciseState {
  State<n> state;  ///< The state that the caller sees.
  State<n> low;    ///< The digits that rounding cut off.

  /// The zero state.
  explicit PreciseState(Eigen::Index size)
      : state{.q = Vector<double, n>::Zero(size), .p = Vector<double, n>::Zero(size)}, low(state) {}
};

/// One over the size of every entry of q and p in a step, so that changes can be measured relative to it.
template <int n>
struct EntryScales {
  Vector<double, n> q;  ///< Factors of positions.
  Vector<double, n> p;  ///< Factors of momenta.

  /// Zero: changes then do not count.
  explicit EntryScales(Eigen::Index size)
      : q(Vector<double, n>::Zero(size)), p(Vector<double, n>::Zero(size)) {}

  /// Sets the size of each entry to twice the sum of its start and all its increments, in absolute value.
  /// Half of that takes four per cent more sweeps and does not improve long runs. An entry at rest at zero
  /// gets the size of the largest entry of q, or of p, because its own is not known yet. @return true where
  /// every entry has its own size
  template <class Increments>
  bool set(const State<n>& start, const Increments& dq, const Increments& dp) {
    const bool of_q = set(q, start.q, dq), of_p = set(p, start.p, dp);
    return of_q && of_p;
  }
  /// The smallest of these factors that is not 0: one over the largest size.
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
      // False also for NaN. For smaller sizes the inverse might overflow in a product.
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
  Pack<w> rate{1.0};               ///< The monitor, where StageField stores it.
  PreciseState<n> start;           ///< Where the step begins.
  EntryScales<n> per;              ///< Factors for the changes of each entry.

  /// Zero, for n = `size`.
  explicit StageValues(Eigen::Index size) : q(size), p(size), dq(size), dp(size), start(size), per(size) {
    for (Vec* each : {&q, &p, &dq, &dp})
      std::fill(each->data(), each->data() + size, Pack<w>(0.0));
  }
};

/// sum += term, whichever is larger. The rounding error of the sum is added to `rest` (Knuth 1969).
template <class T>
[[gnu::always_inline]] inline void add_with_rest(T& sum, T& rest, const T& term) {
  const T next = sum + term, added = next - sum;
  rest += (sum - (next - added)) + (term - added);
  sum = next;
}

/// Adds all numbers of a pack, and their rounding errors in a second pack, to sum + low, with about twice the
/// digits of a double. The increments of a long step are as large as the state, and add() would lose the
/// rounding error of such a number. Without that loss the energy of a long run moves half as much.
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
