#pragma once
#include "avi/bregman/bregman_hamiltonian.hpp"
#include "avi/bregman/clone_composition.hpp"
#include "avi/core/outcome.hpp"

/// @file
/// Phase-space cloning with both copies, as the paper prints it: 3, 7 or 19 gradients a step. Kept to test
/// bregman/bregman_cloning.hpp and to show what the clone costs.

namespace experiment {

/// Strang splitting and its triple jumps of \f$\bar H_1(q, t, \tilde r) + \bar H_2(\tilde q, \tilde t, r)\f$
/// (equation (4.19)); q is read. The last of the printed equations (4.20) has a sign slip:
/// \f$\tilde r' = -\nabla_{\tilde q} \bar H_2\f$ is meant, and `clone_sign` = -1 is that; +1 is the printed
/// sign. The copy that is read does not feel the difference.
struct BregmanCloningPrinted {
  avi::BregmanFamily family;                                          ///< p, p_ring and C.
  double h = 1e-3;                                                    ///< Fictive step, finite and positive.
  avi::CloneComposition composition = avi::CloneComposition::strang;  ///< Of the two flows.
  avi::BregmanStart from{};  ///< Time and momentum of the first iterate.
  double clone_sign = -1.0;  ///< Of the clone's force: -1 as meant, +1 as printed.

  /// What a run carries from step to step.
  struct State {
    avi::VectorX r;               ///< Momentum of the copy that is read.
    avi::VectorX clone_q;         ///< Position of the other copy.
    avi::VectorX clone_r;         ///< Its momentum.
    avi::VectorX clone_gradient;  ///< Gradient of the objective at clone_q.
    double t = 1.0;               ///< Physical time of the copy that is read.
    double t_clone = 1.0;         ///< That of the other copy.
    avi::MergedStages stages;     ///< The composition's lengths.
  };

  /// Checks the parameters and makes the state of one run.
  /// @throws std::invalid_argument for a parameter out of range.
  State start(const avi::Iterate& first) const {
    family.validate();
    from.validate();
    avi::require_positive("Step size h", h);
    const avi::VectorX r = avi::VectorX::Constant(first.x.size(), from.momentum);
    return {.r = r,
            .clone_q = first.x,
            .clone_r = r,
            .clone_gradient = first.gradient,
            .t = from.t,
            .t_clone = from.t,
            .stages = avi::merged_stages(composition)};
  }

  /// Advances both copies by the fictive step, with 3, 7 or 19 gradients.
  template <class F>
  avi::Outcome update(State& state, avi::Iterate& now, F& f) const {
    second_flow(state, now, f, state.stages.b[0]);
    for (std::size_t i = 0; i < state.stages.a.size(); ++i) {
      first_flow(state, now, f, state.stages.a[i]);
      second_flow(state, now, f, state.stages.b[i + 1]);
    }
    now.evaluated = false;
    return avi::Outcome::ok;
  }

 private:
  /// Flow of H-bar_1(q, t, r~): moves q~, t~ and r.
  template <class F>
  void first_flow(State& z, avi::Iterate& now, F& f, double length) const {
    now.evaluate(f);
    z.r -= (length * h * family.potential(z.t)) * now.gradient;
    z.clone_q += (length * h * family.kinetic(z.t)) * z.clone_r;
    z.t_clone += length * h * family.monitor(z.t);
  }

  /// Flow of H-bar_2(q~, t~, r): moves q, t and r~.
  template <class F>
  void second_flow(State& z, avi::Iterate& now, F& f, double length) const {
    f(z.clone_q, z.clone_gradient);
    z.clone_r += (clone_sign * length * h * family.potential(z.t_clone)) * z.clone_gradient;
    now.x += (length * h * family.kinetic(z.t_clone)) * z.r;
    z.t += length * h * family.monitor(z.t_clone);
  }
};

}  // namespace experiment
