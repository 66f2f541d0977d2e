#pragma once
#include "avi/autodiff/hamiltonian.hpp"
#include "avi/autodiff/pack.hpp"
#include "avi/autodiff/recording.hpp"
#include "avi/collocation/stage_field.hpp"

#include <algorithm>

/// @file
/// Hamilton's equations of a large transformed problem whose Hamiltonian supplies its gradient.

namespace avi {

/// The same for many degrees of freedom, known at compile time, where H supplies its gradient for packs: only
/// the monitor is recorded.
template <class Problem, int w>
requires(detail::takes_supplied<Problem, w>) class StageField<Problem, w> {
 public:
  static constexpr int n = Problem::dimension;  ///< Degrees of freedom.
  using Scalar = Pack<w>;                       ///< One number for each stage.
  using Vec = Vector<Scalar, n>;                ///< One vector for each stage.

  /// Records the monitor.
  explicit StageField(const Problem& problem) : StageField(detail::recorded_rate(problem, false)) {}

  /// force = -weight \f$\partial \bar H/\partial q\f$.
  void force(const Problem& problem, const Vec& q, const Vec& p, const Scalar& weight, Scalar& rate,
             Vec& force) {
    force = problem.hamiltonian().d_dq(q, p);
    add_monitor(problem, by_q_, room_q_, q, p, -weight, rate, force);
  }
  /// velocity = weight \f$\partial \bar H/\partial p\f$, at the positions of the last call of force().
  void velocity(const Problem& problem, const Vec& q, const Vec& p, const Scalar& weight, Scalar& rate,
                Vec& velocity) {
    velocity = problem.hamiltonian().d_dp(q, p);
    if constexpr (Problem::position_monitor)
      velocity *= Scalar(weight * rate);
    else
      add_monitor(problem, by_p_, room_p_, q, p, weight, rate, velocity);
  }
  /// g, which a sweep leaves in `rate`.
  [[nodiscard]] static const Scalar& rate(const Scalar& rate) { return rate; }

 private:
  explicit StageField(const Recording& g)
      : by_q_(g.value_and_gradient(0, n)), by_p_(g.value_and_gradient(n, n)), room_q_(by_q_), room_p_(by_p_) {
  }

  /// From the slope of H to that of g (H + p^t), times `weight`.
  static void add_monitor(const Problem& problem, const Program& g, Program::Room<Scalar>& room, const Vec& q,
                          const Vec& p, const Scalar& weight, Scalar& rate, Vec& slope) {
    if constexpr (Problem::unit) {
      slope *= weight;
    } else {
      std::copy(q.data(), q.data() + n, room.arguments());
      std::copy(p.data(), p.data() + n, room.arguments() + n);
      g.run(room);
      rate = g.value(room);
      const Scalar along = weight * rate,
                   across = weight * (problem.hamiltonian()(q, p) + Scalar(problem.energy_momentum()));
      for (int i = 0; i < n; ++i)
        slope[i] = along * slope[i] + across * g.slope(room, i);
    }
  }

  Program by_q_, by_p_;
  Program::Room<Scalar> room_q_, room_p_;
};

}  // namespace avi
