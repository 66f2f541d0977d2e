#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/autodiff/program.hpp"
#include "avi/core/require.hpp"

#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// Gradients in any dimension: a function is called once and becomes a program with its derivatives.

namespace avi {

/// A function f of N numbers, called once with a scalar that writes down what is done to it. The straight
/// line of operations found so, with its gradient by reverse accumulation, costs a small multiple of f
/// whatever N is, at any scalar and without calling f again.
///
/// f must do the same operations wherever it is called: loops over its entries are allowed, branches on their
/// values are not; the compiler refuses `if` on comparisons of entries and their conversion to numbers. What
/// f may use are sums, products and quotients, select(a < b, x, y), min and max, and the functions of
/// autodiff/functions.hpp.
///
/// The value is that of f at doubles to the last bit (sines at packs, see Pack, to one unit of it), as long
/// as f adds in the order in which it is written (Eigen's own reductions of doubles do not); where f
/// multiplies an infinite or NaN entry by 0 it is finite. The slope of |x| at 0 is 1, that of a power other
/// than a half integer at 0 is NaN.
class Recording {
 public:
  /// Records f. @param f called as f(x) with a Vector<Recorded, dynamic> of `inputs` entries; what it
  /// returns is the value
  /// @throws std::invalid_argument for fewer than one input.
  template <class F>
  requires(!std::is_same_v<F, ExpressionGraph>) Recording(const F& f, Eigen::Index inputs)
      : Recording(Formula::of_point(f, inputs)) {}

  /// Takes a formula that is recorded already: no function is called. @param graph of N inputs @param node
  /// the value @param inner node of an h whose gradient is supplied @param supplied nodes of that; none: h is
  /// differentiated, too
  /// @throws std::invalid_argument for a graph without inputs, or a node that it has not.
  Recording(ExpressionGraph graph, int node, int inner = -1, const std::vector<int>& supplied = {});

  /// The same of a Formula. Its parameters are the last inputs, to be set in the program's room.
  explicit Recording(const Formula& f) : Recording(f.graph(), f.node()) {}

  [[nodiscard]] int inputs() const { return graph_.inputs(); }           ///< N.
  [[nodiscard]] const ExpressionGraph& graph() const { return graph_; }  ///< The graph of f and its gradient.
  [[nodiscard]] int slope(int i) const { return slopes_[i]; }            ///< The node of derivative i.

  /// The program of the derivatives along `count` entries of x from `first` on.
  /// @throws std::invalid_argument for entries that x has not.
  [[nodiscard]] Program gradient(int first, int count) const { return program(-1, first, count); }
  /// The program of the gradient.
  [[nodiscard]] Program gradient() const { return gradient(0, inputs()); }
  /// The program of f(x) and of its derivatives along `count` entries of x from `first` on.
  /// @throws std::invalid_argument for entries that x has not.
  [[nodiscard]] Program value_and_gradient(int first, int count) const {
    return program(value_, first, count);
  }
  /// The program of f(x) and its gradient.
  [[nodiscard]] Program value_and_gradient() const { return value_and_gradient(0, inputs()); }
  /// The program of f(x) alone.
  [[nodiscard]] Program value() const { return value_and_gradient(0, 0); }

 private:
  [[nodiscard]] Program program(int value, int first, int count) const;
  ExpressionGraph graph_;
  int value_, recorded_;
  std::vector<int> slopes_;
};

/// The recording of a Hamiltonian or monitor f(q, p) with vectors of n entries, whose arguments are (q, p):
/// 2n entries. @param size n, where it is avi::dynamic
/// @throws std::invalid_argument where n is less than 1, or the size another one.
template <int n = dynamic, class F>
Recording record(const F& f, Eigen::Index size = n) {
  return Recording(Formula::of_phase<n>(f, size));
}

}  // namespace avi
