#pragma once
#include "avi/bregman/composition.hpp"
#include "avi/bregman/hamiltonian.hpp"
#include "avi/core/outcome.hpp"

/// @file
/// Phase-space cloning with both copies, as the paper prints it: 3, 7 or 19 gradients a step. Kept to test
/// bregman/cloning.hpp and to show what the clone costs.

namespace avi {

/// Strang splitting and its triple jumps of H-bar_1(q, t, r~) + H-bar_2(q~, t~, r); q is read. The last of
/// the printed equations has a sign slip: r~' = -grad_q~ H_2 is meant, and `clone_sign` = -1 is that;
/// +1 is the printed sign. The copy that is read does not feel the difference.
struct BregmanCloningPrinted {
  BregmanFamily family;
  double h = 1e-3;  ///< Fictive step, finite and positive.
  CloneComposition composition = CloneComposition::strang;
  BregmanStart from{};
  double clone_sign = -1.0;

  struct State {
    VectorX r, clone_q, clone_r, clone_gradient;
    double t = 1.0, t_clone = 1.0;
    MergedStages stages;
  };

  /// @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    family.validate();
    from.validate();
    require_positive("Step size h", h);
    const VectorX r = VectorX::Constant(first.x.size(), from.momentum);
    return {.r = r,
            .clone_q = first.x,
            .clone_r = r,
            .clone_gradient = first.gradient,
            .t = from.t,
            .t_clone = from.t,
            .stages = merged_stages(composition)};
  }

  template <class F>
  Outcome update(State& state, Iterate& now, F& f) const {
    second_flow(state, now, f, state.stages.b[0]);
    for (std::size_t i = 0; i < state.stages.a.size(); ++i) {
      first_flow(state, now, f, state.stages.a[i]);
      second_flow(state, now, f, state.stages.b[i + 1]);
    }
    now.evaluated = false;
    return Outcome::ok;
  }

 private:
  /// Flow of H-bar_1(q, t, r~): moves q~, t~ and r.
  template <class F>
  void first_flow(State& z, Iterate& now, F& f, double length) const {
    now.evaluate(f);
    z.r -= (length * h * family.potential(z.t)) * now.gradient;
    z.clone_q += (length * h * family.kinetic(z.t)) * z.clone_r;
    z.t_clone += length * h * family.monitor(z.t);
  }

  /// Flow of H-bar_2(q~, t~, r): moves q, t and r~.
  template <class F>
  void second_flow(State& z, Iterate& now, F& f, double length) const {
    f(z.clone_q, z.clone_gradient);
    z.clone_r += (clone_sign * length * h * family.potential(z.t_clone)) * z.clone_gradient;
    now.x += (length * h * family.kinetic(z.t_clone)) * z.r;
    z.t += length * h * family.monitor(z.t_clone);
  }
};

}  // namespace avi
