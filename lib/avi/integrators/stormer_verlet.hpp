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

/// The kick-drift-kick leapfrog, \f[ p_{1/2} = p_0 - \tfrac{h}{2} \nabla V(q_0), \quad q_1 = q_0 + h\,
/// p_{1/2}, \quad p_1 = p_{1/2} - \tfrac{h}{2} \nabla V(q_1). \f] It has order 2 and is symmetric and
/// symplectic. It is the method SV of the paper's Tables 1 and 2; drift-kick-drift does not give the errors
/// printed there. `gradient` is any callable q -> dV/dq. The gradient of the last kick is kept for the next
/// step, so a step costs one evaluation unless the state is changed from outside.
template <int n, class Gradient>
class StormerVerlet {
 public:
  /// The method for a potential. @param gradient q -> dV/dq
  explicit StormerVerlet(Gradient gradient) : gradient_(std::move(gradient)) {
    at_.fill(std::numeric_limits<double>::quiet_NaN());  // equal to no position: no gradient is kept yet
  }

  static constexpr int order() { return 2; }  ///< In the step size.
  static constexpr bool symplectic = true;    ///< A composition of exact flows.
  static constexpr bool symmetric = true;     ///< A step -h undoes a step h.

  /// Advances z by h. If the new state is not finite, the step ends as non_finite and z is unchanged.
  /// @throws std::invalid_argument if the gradient has another number of entries than q.
  StepReport step(State<n>& z, double h) {
    if (at_.size() != z.q.size() || z.q != at_) {
      force_ = detail::sized(entries, gradient_(z.q), z.q.size());
      at_ = z.q;  // set at once, in case the next gradient throws
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

/// Builds a StormerVerlet and deduces all types but the dimension: stormer_verlet<2>(gradient).
template <int n, class Gradient>
StormerVerlet<n, Gradient> stormer_verlet(Gradient gradient) {
  return StormerVerlet<n, Gradient>(std::move(gradient));
}

}  // namespace avi
