#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/core/require.hpp"

#include <concepts>
#include <memory>
#include <type_traits>

/// @file
/// RecordedObjective: a formula as an objective, with its gradient by automatic differentiation.

namespace avi {

/// A function f(x) of a vector that is generic in its scalar. It is called once with a scalar that records
/// its operations, under the rules of Recording: no branches on the entries of x. A function that returns a
/// plain number does not qualify, because it works on numbers only, although Eigen claims to convert one
/// vector type into another.
template <class F>
concept Recordable = requires(const F& f, const Vector<Recorded, dynamic>& x) {
  { f(x) } -> std::convertible_to<Recorded>;
  requires !std::is_arithmetic_v<std::remove_cvref_t<decltype(f(x))>>;
};

/// The objective of a Recordable function. Its gradient, by reverse accumulation, costs a small multiple of
/// the value in any dimension. The object owns its working memory, and copies share it. If several threads
/// call at once, the first uses that memory, and each of the others allocates its own.
class RecordedObjective {
 public:
  /// Records f with n arguments. @throws std::invalid_argument for n < 1.
  template <Recordable F>
  RecordedObjective(const F& f, Eigen::Index n) : RecordedObjective(Formula::of_point(f, n)) {}

  /// Uses a formula that is already recorded, with the present values of its parameters.
  explicit RecordedObjective(const Formula& f);
  RecordedObjective(const RecordedObjective&) = default;             ///< Also used for a move.
  RecordedObjective& operator=(const RecordedObjective&) = default;  ///< Likewise.

  /// The value and gradient at x, which must have the n entries that were recorded.
  /// @throws std::invalid_argument for an x of another size.
  double operator()(const VectorX& x, VectorX& gradient) const {
    require(x.size() == n_, "Size of x", x.size(), "the number of arguments of f, ", n_);
    gradient.resize(x.size());
    return evaluate(x.data(), gradient.data());
  }

 private:
  struct Work;
  // Pointers, not Eigen vectors, cross into the compiled library: it may be compiled for another instruction
  // set.
  double evaluate(const double* x, double* gradient) const;
  std::shared_ptr<Work> work_;
  Eigen::Index n_;
};

}  // namespace avi
