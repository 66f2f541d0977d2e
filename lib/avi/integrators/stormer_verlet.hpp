#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/state.hpp"
#include "avi/core/summation.hpp"

#include <limits>
#include <string_view>
#include <utility>

/// @file
/// Stormer-Verlet for H = |p|^2 / 2 + V(q).

namespace avi {

/// Kick-drift-kick leapfrog. \f[ p_{1/2} = p_0 - \tfrac{h}{2} \nabla V(q_0), \quad q_1 = q_0 + h\, p_{1/2},
/// \quad p_1 = p_{1/2} - \tfrac{h}{2} \nabla V(q_1). \f] Order 2, symmetric, symplectic: the method SV of the
/// paper's Tables 1 and 2 (drift-kick-drift does not give their errors). `gradient` is any callable q ->
/// dV/dq. The last kick's gradient is kept for the next step, so that a step costs one evaluation as long as
/// the state is not changed from outside.
template <int n, class Gradient>
class StormerVerlet {
 public:
  /// For one potential. @param gradient q -> dV/dq
  explicit StormerVerlet(Gradient gradient) : gradient_(std::move(gradient)) {
    at_.fill(std::numeric_limits<double>::quiet_NaN());  // Equal to no position: no gradient is kept yet.
  }

  static constexpr int order() { return 2; }  ///< In the step size.
  static constexpr bool symplectic = true;    ///< A product of exact flows.
  static constexpr bool symmetric = true;     ///< The same read backwards.

  /// Advances z by h. Ends as non_finite, with z as it was, where the step leads to what is no number.
  /// @throws std::invalid_argument where the gradient has not as many entries as q.
  StepReport step(State<n>& z, double h) {
    if (at_.size() != z.q.size() || z.q != at_) {
      force_ = detail::sized(entries, gradient_(z.q), z.q.size());
      at_ = z.q;  // at once, in case that the next gradient throws
    }
    State<n> moved = z;
    moved.p -= (0.5 * h) * force_;
    moved.q += h * moved.p;
    force_ = detail::sized(entries, gradient_(moved.q), z.q.size());
    at_ = moved.q;
    moved.p -= (0.5 * h) * force_;
    ClockSum clock = clock_;
    clock.add(moved.t, h);
    if (!moved.finite()) return detail::lost_at(moved);
    z = moved;
    clock_ = clock;
    return {};
  }

 private:
  static constexpr std::string_view entries = "Number of entries of the gradient";

  Gradient gradient_;
  Vector<double, n> at_;
  Vector<double, n> force_;
  ClockSum clock_;
};

/// Deduces everything but the dimension: stormer_verlet<2>(gradient).
template <int n, class Gradient>
StormerVerlet<n, Gradient> stormer_verlet(Gradient gradient) {
  return StormerVerlet<n, Gradient>(std::move(gradient));
}

}  // namespace avi
