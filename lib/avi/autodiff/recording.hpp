#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/autodiff/program.hpp"
#include "avi/core/require.hpp"

#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// Recording: a function is called once and becomes a program for its value and gradient, in any dimension.

namespace avi {

/// A function f of N numbers, recorded by one call with a scalar that stores its operations. The resulting
/// program for f and its gradient, by reverse accumulation, costs a small multiple of f for any N, works for
/// any scalar, and never calls f again.
///
/// f must perform the same operations for all arguments. Loops over the entries are allowed; branches on
/// their values are not. The compiler refuses `if` on comparisons of entries and their conversion to numbers.
/// f may use sums, products and quotients, select(a < b, x, y), min and max, and the functions in
/// autodiff/functions.hpp.
///
/// The value equals that of f with doubles to the last bit (for packs the sines differ by up to one unit in
/// the last place, see Pack), provided that f adds in the order in which it is written; Eigen's own
/// reductions of doubles do not. Where f multiplies an infinite or NaN entry by 0, the recorded value is
/// finite. The slope of |x| at 0 is 1, at -0.0 it is -1; that of a power whose exponent is
/// between 0 and 1, but not 1/2, is NaN at 0.
class Recording {
 public:
  /// Records f. @param f called as f(x) with a Vector<Recorded, dynamic> of `inputs` entries; it returns the
  /// value @param inputs N
  /// @throws std::invalid_argument for fewer than one input.
  template <class F>
  requires(!std::is_same_v<F, ExpressionGraph>) Recording(const F& f, Eigen::Index inputs)
      : Recording(Formula::of_point(f, inputs)) {}

  /// Takes a formula that is already recorded, without calling any function. @param graph with N inputs
  /// @param node the node of f @param inner node of a function h within f whose gradient is supplied, or -1
  /// @param supplied nodes of that gradient; if empty, h is differentiated too
  /// @throws std::invalid_argument for a graph without inputs, or a node that is not in it.
  Recording(ExpressionGraph graph, int node, int inner = -1, const std::vector<int>& supplied = {});

  /// The same for a Formula. Its parameters become the last inputs, to be set in the room of the program.
  explicit Recording(const Formula& f) : Recording(f.graph(), f.node()) {}

  [[nodiscard]] int inputs() const { return graph_.inputs(); }           ///< N.
  [[nodiscard]] const ExpressionGraph& graph() const { return graph_; }  ///< Graph of f and its gradient.
  [[nodiscard]] int slope(int i) const { return slopes_[i]; }            ///< Node of derivative i.

  /// The program for the derivatives by `count` entries of x, starting at entry `first`.
  /// @throws std::invalid_argument for entries beyond the size of x.
  [[nodiscard]] Program gradient(int first, int count) const { return program(-1, first, count); }
  /// The program for the gradient.
  [[nodiscard]] Program gradient() const { return gradient(0, inputs()); }
  /// The program for f(x) and its derivatives by `count` entries of x, starting at entry `first`.
  /// @throws std::invalid_argument for entries beyond the size of x.
  [[nodiscard]] Program value_and_gradient(int first, int count) const {
    return program(value_, first, count);
  }
  /// The program for f(x) and its gradient.
  [[nodiscard]] Program value_and_gradient() const { return value_and_gradient(0, inputs()); }
  /// The program for f(x) alone.
  [[nodiscard]] Program value() const { return value_and_gradient(0, 0); }

 private:
  [[nodiscard]] Program program(int value, int first, int count) const;
  ExpressionGraph graph_;
  int value_, recorded_;
  std::vector<int> slopes_;
};

/// Records a Hamiltonian or monitor f(q, p) with n entries in q and in p; the 2n arguments are (q, p).
/// @param size n, where it is avi::dynamic
/// @throws std::invalid_argument for n less than 1, or a size that differs from a fixed n.
template <int n = dynamic, class F>
Recording record(const F& f, Eigen::Index size = n) {
  return Recording(Formula::of_phase<n>(f, size));
}

}  // namespace avi
