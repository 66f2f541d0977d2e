#pragma once
#include "avi/bregman/composition.hpp"
#include "avi/bregman/family.hpp"
#include "avi/core/outcome.hpp"
#include "avi/optim/objective.hpp"

/// @file
/// Phase-space cloning (Pihajoki 2015) for Bregman dynamics, reduced to what the copy that is read needs.

namespace avi {

/// Two copies (q, t, r) and (q~, t~, r~) with H-bar_1(q, t, r~) + H-bar_2(q~, t~, r), split into the two
/// terms: H_2 for half a step, H_1, H_2 for half a step, and compositions of that (Section 4.3).
///
/// As H-bar is separable in q and r once t is given, q meets r only: q' = kinetic(t~) r under H_2 and
/// r' = -potential(t) grad f(q) under H_1. The copy that is read, (q, r), never sees (q~, r~), only the other
/// clock. So q and r and two clocks are evolved here, a leapfrog with 1, 3 or 9 gradients a step, where the
/// printed form (bregman/cloning_printed.hpp) spends 3, 7 or 19 on the same iterates; the stopping test at
/// the new q costs one more.
struct BregmanCloning {
  BregmanFamily family;
  double h = 1e-3;  ///< Fictive step, finite and positive.
  CloneComposition composition = CloneComposition::strang;
  BregmanStart from{};

  struct State {
    VectorX r;
    double t = 1.0, t_clone = 1.0;
    MergedStages stages;
  };

  /// @throws std::invalid_argument for a parameter out of range.
  State start(const Iterate& first) const {
    family.validate();
    from.validate();
    require_positive("Step size h", h);
    return {.r = VectorX::Constant(first.x.size(), from.momentum),
            .t = from.t,
            .t_clone = from.t,
            .stages = merged_stages(composition)};
  }

  template <class F>
  Outcome update(State& state, Iterate& now, F& f) const {
    drift(state, now, state.stages.b[0]);
    for (std::size_t i = 0; i < state.stages.a.size(); ++i) {
      kick(state, now, f, state.stages.a[i]);
      drift(state, now, state.stages.b[i + 1]);
    }
    now.evaluated = false;
    return Outcome::ok;
  }

 private:
  /// Flow of H-bar_2(q~, t~, r), without its action on the clone's momentum.
  void drift(State& state, Iterate& now, double length) const {
    now.x += (length * h * family.kinetic(state.t_clone)) * state.r;
    state.t += length * h * family.monitor(state.t_clone);
  }

  /// Flow of H-bar_1(q, t, r~), without its action on the clone's position.
  template <class F>
  void kick(State& state, Iterate& now, F& f, double length) const {
    now.evaluate(f);
    state.r -= (length * h * family.potential(state.t)) * now.gradient;
    state.t_clone += length * h * family.monitor(state.t);
  }
};

}  // namespace avi
