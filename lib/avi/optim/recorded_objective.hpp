#pragma once
#include "avi/autodiff/formula.hpp"
#include "avi/core/require.hpp"

#include <concepts>
#include <memory>
#include <type_traits>

/// @file
/// A formula as an objective: value and gradient by automatic differentiation.

namespace avi {

/// A function of a vector that is written for any scalar: f(x) is called once with a scalar that writes down
/// what is done to it (Recording, whose rules hold for f: no branches on the entries of x). What returns a
/// plain number works on numbers alone: Eigen only pretends to turn one kind of vector into another.
template <class F>
concept Recordable = requires(const F& f, const Vector<Recorded, dynamic>& x) {
  { f(x) } -> std::convertible_to<Recorded>;
  requires !std::is_arithmetic_v<std::remove_cvref_t<decltype(f(x))>>;
};

/// The objective of a Recordable function: its gradient by reverse accumulation costs a small multiple of the
/// value, whatever the dimension. It works in memory that it owns and its copies share; where several threads
/// call at a time, the first one does, and the others in memory of their own, which costs each of those calls
/// an allocation.
class RecordedObjective {
 public:
  /// Records f in n dimensions. @throws std::invalid_argument for n < 1.
  template <Recordable F>
  RecordedObjective(const F& f, Eigen::Index n) : RecordedObjective(Formula::of_point(f, n)) {}

  /// Takes a formula that is recorded already; its parameters have the values that it has.
  explicit RecordedObjective(const Formula& f);
  RecordedObjective(const RecordedObjective&) = default;             ///< Also for a move.
  RecordedObjective& operator=(const RecordedObjective&) = default;  ///< Likewise.

  /// Value and gradient at x, of the n entries that were recorded.
  /// @throws std::invalid_argument for an x of another size.
  double operator()(const VectorX& x, VectorX& gradient) const {
    require(x.size() == n_, "Size of x", x.size(), "the number of arguments of f, ", n_);
    gradient.resize(x.size());
    return evaluate(x.data(), gradient.data());
  }

 private:
  struct Work;
  // Vectors of another library are not passed on: the library may be compiled for another processor.
  double evaluate(const double* x, double* gradient) const;
  std::shared_ptr<Work> work_;
  Eigen::Index n_;
};

}  // namespace avi
