#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/core/dot.hpp"

#include <algorithm>
#include <atomic>

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
/// value, whatever the dimension. It works in memory that it owns; where several threads call one object at a
/// time, the first one does, and the others in memory of their own, which costs each of those calls an
/// allocation.
class RecordedObjective {
 public:
  /// Records f in n dimensions. @throws std::invalid_argument for n < 1.
  template <Recordable F>
  RecordedObjective(const F& f, Eigen::Index n)
      : program_(Recording(f, n).value_and_gradient()), room_(program_) {}

  /// Of a formula that is recorded already; its parameters have the values that it has.
  explicit RecordedObjective(const Formula& f)
      : program_(Recording(f.with_constants()).value_and_gradient()), room_(program_) {}

  /// Value and gradient at x, of the n entries that were recorded.
  double operator()(const VectorX& x, VectorX& gradient) const {
    if (in_use_.flag.exchange(true, std::memory_order_acquire)) {
      Program::Room<double> room(program_);
      return evaluate(room, x, gradient);
    }
    const Release at_the_end{in_use_.flag};
    return evaluate(room_, x, gradient);
  }

 private:
  /// A copy is not in use.
  struct InUse {
    std::atomic<bool> flag = false;
    InUse() = default;
    InUse(const InUse&) {}
    InUse& operator=(const InUse&) { return *this; }
  };
  struct Release {
    std::atomic<bool>& flag;
    ~Release() { flag.store(false, std::memory_order_release); }
  };

  double evaluate(Program::Room<double>& room, const VectorX& x, VectorX& gradient) const {
    std::copy_n(x.data(), x.size(), room.arguments());
    program_.run(room);
    gradient.resize(x.size());
    for (int i = 0; i < program_.slopes(); ++i)
      gradient[i] = program_.slope(room, i);
    return program_.value(room);
  }

  Program program_;
  mutable Program::Room<double> room_;
  mutable InUse in_use_;
};

}  // namespace avi
