#pragma once
#include "avi/bregman/bregman_family.hpp"
#include "avi/core/outcome.hpp"
#include "avi/optim/objective.hpp"

/// @file
/// The symmetric Hamiltonian splitting of Betancourt, Jordan and Wilson (2018) for Bregman dynamics.

namespace avi {

/// The splitting integrators of Section 4.4 of the paper, Direct and Adaptive. A step consists of half a step
/// of the clock, half a kick, a drift, half a kick and half a step of the clock; t^s advances exactly. The
/// coefficients of the kicks and the drift are those at the middle time. A step takes one gradient, because
/// the closing kick and the next opening kick use the same one.
///
/// r^t is not evolved. The printed update of r^t does not belong to these steps: with it they are not
/// symplectic on extended phase space. With the flow of r^t under each of the three terms in place of that
/// update they are, and q, r and t are the same.
struct BregmanSplitting {
  BregmanFamily family;  ///< p, p_ring and C.
  double h = 1e-3;       ///< Fictive step, finite and positive.
  BregmanStart from{};   ///< Initial time and momentum.

  /// The state of a run.
  struct State {
    VectorX r;                  ///< Momentum, before the closing kick of the last step.
    double t;                   ///< Physical time.
    double closing_kick = 0.0;  ///< Coefficient of the gradient in that closing kick.
  };

  /// The state for a new run. @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    validate(family, from, h);
    return {.r = VectorX::Constant(first.x.size(), from.momentum), .t = from.t};
  }

  /// One fictive step, with the gradient already evaluated in `now`.
  template <class F>
  Outcome update(State& state, Iterate& now, F&) const {
    const double middle = family.exact_clock(state.t, 0.5 * h);
    const double kick = 0.5 * h * family.potential(middle), drift = h * family.kinetic(middle);
    for (Eigen::Index i = 0; i < now.x.size(); ++i) {
      state.r[i] -= state.closing_kick * now.gradient[i];
      state.r[i] -= kick * now.gradient[i];
      now.x[i] += drift * state.r[i];
    }
    state.closing_kick = kick;
    state.t = family.exact_clock(middle, 0.5 * h);
    now.evaluated = false;
    return Outcome::ok;
  }
};

}  // namespace avi
