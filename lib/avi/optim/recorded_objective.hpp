#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/core/dot.hpp"

#include <algorithm>

/// @file
/// A formula as an objective: value and gradient by automatic differentiation.

namespace avi {

/// A function of a vector that is written for any scalar: f(x) is called once with a scalar that writes down
/// what is done to it (Recording, whose rules hold for f: no branches on the entries of x).
template <class F>
concept Formula = requires(const F& f, const Vector<Recorded, dynamic>& x) {
  { f(x) } -> std::convertible_to<Recorded>;
};

/// The objective of a Formula: its gradient by reverse accumulation costs a small multiple of the value,
/// whatever the dimension. Works in memory that it owns: one object serves one thread.
class RecordedObjective {
 public:
  /// Records f in n dimensions. @throws std::invalid_argument for n < 1.
  template <Formula F>
  RecordedObjective(const F& f, Eigen::Index n)
      : program_(Recording(f, n).value_and_gradient()), room_(program_) {}

  /// Value and gradient at x, of the n entries that were recorded.
  double operator()(const VectorX& x, VectorX& gradient) const {
    std::copy(x.begin(), x.end(), room_.arguments());
    program_.run(room_);
    gradient.resize(x.size());
    for (int i = 0; i < program_.slopes(); ++i)
      gradient[i] = program_.slope(room_, i);
    return program_.value(room_);
  }

 private:
  Program program_;
  mutable Program::Room<double> room_;
};

}  // namespace avi
